// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/degenerate.h"

#include "corpus/json.h"

namespace stiction::fuzz {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// J of A = J J', rows x columns.
Rows Jacobian(int kind, int rows) {
  const auto of = [rows](int columns, const auto& entry) {
    Rows J(rows, std::vector<std::string>(columns));
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) J[i][j] = entry(i, j);
    }
    return J;
  };
  switch (kind) {
    case 0:  // A = 0
      return of(2, [](int, int) { return "0"; });
    case 1:  // no columns
      return of(0, [](int, int) { return "0"; });
    case 2:  // the first row is zero
      return of(rows, [](int i, int j) { return i == j && i > 0 ? "2" : "0"; });
    case 3:  // a jam in fractions, of rank 1
      return of(1, [](int i, int) { return i % 2 == 0 ? "1/3" : "-2/7"; });
    case 4:  // huge beside tiny
      return of(rows, [](int i, int j) { return i == j ? (i % 2 == 0 ? "1e150" : "1e-150") : "0"; });
    default:
      return of(rows, [](int i, int j) { return i == j ? "3" : i > j ? "1/2" : "0"; });
  }
}
constexpr int kJacobians = 6;

Rational Sum(const std::vector<std::string>& x, const std::vector<std::string>& y) {
  Rational sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += *ParseRational(x[k]) * *ParseRational(y[k]);
  return sum;
}

Json Products(const Rows& J) {
  Json A = Json::array();
  for (const auto& row : J) {
    Json line = Json::array();
    for (const auto& other : J) line.push_back(ToString(Sum(row, other)));
    A.push_back(line);
  }
  return A;
}

std::vector<Json> ContactLists(int dimension) {
  const auto contact = [](const char* kind, const char* mu) {
    Json json = {{"kind", kind}};
    if (*mu != '\0') json["mu"] = mu;
    return json;
  };
  Json sliding = contact("sliding", "3");
  sliding["slip"] = dimension == 2 ? Json("1") : Json::array({"3/5", "4/5"});
  const Json bilateral = contact("bilateral", ""), frictionless = contact("frictionless", "");
  std::vector<Json> lists = {Json::array(),
                             Json::array({bilateral}),
                             Json::array({frictionless}),
                             Json::array({bilateral, frictionless}),
                             Json::array({contact("static", "1/2"), contact("static", "0")}),
                             Json::array({bilateral, contact("static", "1")}),
                             Json::array({sliding}),
                             Json::array({sliding, contact("static", "1")})};
  for (const char* mu : {"0", "1/2", "1e9", "1e-300", "inf"})
    lists.push_back(Json::array({contact("static", mu)}));
  return lists;
}

int RowsOf(const Json& contacts, int dimension) {
  int rows = 0;
  for (const Json& contact : contacts) rows += contact.contains("mu") ? dimension : 1;
  return rows;
}

Json FreeAccelerations(int kind, int rows) {
  Json b = Json::array();
  for (int i = 0; i < rows; ++i)
    b.push_back(kind == 0 ? "0" : kind == 1 ? (i == 0 ? "-1" : "1/3") : i % 2 == 0 ? "-1e200" : "1e-300");
  return b;
}
constexpr int kLoads = 3;

Json InEntries(const Json& A) {
  Json entries = Json::array();
  for (std::size_t i = 0; i < A.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j)
      if (A[i][j] != "0") entries.push_back(Json::array({i, j, A[i][j]}));
  }
  return {{"size", A.size()}, {"entries", entries}};
}

// c makes b of it.
Json InFactors(const Rows& J, const Json& b) {
  const std::size_t columns = J.empty() ? 0 : J[0].size();
  Json entries = Json::array();
  for (std::size_t i = 0; i < J.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j)
      if (J[i][j] != "0") entries.push_back(Json::array({i, j, J[i][j]}));
  }
  const Json ones(columns, "1"), zeros(columns, "0");
  return {{"J", {{"size", Json::array({J.size(), columns})}, {"entries", entries}}},
          {"M", ones},
          {"w", zeros},
          {"c", b}};
}

void AddForms(Json problem, const Rows& J, const Json& b, std::vector<std::string>& texts) {
  const Json A = Products(J);
  problem["factors"] = InFactors(J, b);
  texts.push_back(JsonText(problem));
  problem.erase("factors");
  problem["b"] = b;
  problem["A"] = InEntries(A);
  texts.push_back(JsonText(problem));
  problem["A"] = A;
  texts.push_back(JsonText(problem));
  if (A.size() < 2) return;
  problem["A"][0][0] = "-1";  // indefinite
  texts.push_back(JsonText(problem));
  problem["A"][0][1] = "5/3";  // unsymmetric
  texts.push_back(JsonText(problem));
}

}  // namespace

std::vector<std::string> DegenerateProblems() {
  std::vector<std::string> texts;
  for (const int dimension : {2, 3}) {
    for (const Json& contacts : ContactLists(dimension)) {
      const int rows = RowsOf(contacts, dimension);
      for (int kind = 0; kind < kJacobians; ++kind) {
        for (int load = 0; load < kLoads; ++load)
          AddForms({{"dimension", dimension}, {"contacts", contacts}}, Jacobian(kind, rows),
                   FreeAccelerations(load, rows), texts);
      }
    }
  }
  return texts;
}

std::vector<std::string> FilesWithoutSizes() {
  std::vector<std::string> texts;
  const std::vector<std::string> sizes = {"0",
                                          "1",
                                          "null",
                                          "true",
                                          "\"x\"",
                                          "{}",
                                          R"({"size": 2})",
                                          R"({"size": [2, 2]})",
                                          R"({"size": [-1, 2], "entries": []})",
                                          R"({"size": [1.5, 2], "entries": []})",
                                          R"({"size": [99999999999, 2], "entries": []})",
                                          R"({"size": [2, "x"], "entries": []})",
                                          R"({"size": [2, 3], "entries": []})",
                                          R"({"size": [2, 2], "entries": 0})",
                                          R"([1, 2])",
                                          R"([[1], 2])",
                                          R"([[1, 2], [3]])"};
  for (const std::string& J : sizes) {
    for (const char* rest : {"", R"(, "dimension": 2)", R"(, "dimension": 3)"}) {
      for (const char* mu :
           {R"("mu": 1)", R"("mu": [1])", R"("contacts": [{"kind": "static", "mu": 1}])", R"("mu": "inf")"})
        texts.push_back(R"({"factors": {"J": )" + J + R"(, "M": [1, 1], "w": [0, 0]}, )" + mu + rest + "}");
    }
  }
  for (const char* A : {"0", "null", "{}", R"({"size": 2})", R"("x")", "[[]]"}) {
    for (const char* b : {"", R"(, "b": 0)", R"(, "b": {})", R"(, "b": [[]])"})
      texts.push_back(std::string(R"({"mu": 1, "A": )") + A + b + "}");
  }
  texts.emplace_back(R"({"mu": 1})");
  texts.emplace_back(R"({"factors": 0, "mu": 1})");
  texts.emplace_back(R"({"factors": {}, "mu": 1})");
  texts.emplace_back(
      R"({"factors": {"J": {"size": [0, 5], "entries": []}, "M": [1, 1], "w": [0, 0]}, "mu": []})");
  return texts;
}

}  // namespace stiction::fuzz
