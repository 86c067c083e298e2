// SPDX-License-Identifier: Apache-2.0
// Problem files: what is read, what is refused and how, and the exact round trip.

#include "corpus/record/problem_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "corpus/exact_number.h"
#include "corpus/formats/read_problem.h"
#include "corpus/json.h"
#include "corpus/record/definite_block.h"
#include "corpus/stop.h"
#include "solver/problem/check.h"
#include "solver/problem/errors.h"

namespace stiction {
namespace {

const std::string kReference = R"({
  "format": "stiction-problem", "version": 1,
  "name": "two-contact-cycle", "dimension": 2,
  "contacts": [
    {"kind": "static", "mu": "1"},
    {"kind": "static", "mu": "1"}
  ],
  "A": [
    ["7","-2","-6","0"],
    ["-2","9","-1","-7"],
    ["-6","-1","7","3"],
    ["0","-7","3","7"]
  ],
  "b": ["2","-1","-2","2"]
}
)";

// One contact of the kind given by its members, with A = 0 and b = 0.
std::string OneContact(const std::string& members, int dimension = 2, int rows = 2) {
  std::string b, A;
  for (int i = 0; i < rows; ++i) b += i == 0 ? "0" : ",0";
  for (int i = 0; i < rows; ++i) A += (i == 0 ? "[" : ",[") + b + "]";
  return R"({"format": "stiction-problem", "version": 1, "name": "one", "dimension": )" +
         std::to_string(dimension) + R"(, "contacts": [{)" + members + R"(}], "A": [)" + A + R"(], "b": [)" +
         b + "]}";
}

// A planar static contact (two rows) with this A.
std::string WithA(const std::string& A) {
  return R"({"format": "stiction-problem", "version": 1, "name": "one", "dimension": 2,
             "contacts": [{"kind": "static", "mu": 1}], "A": )" +
         A + R"(, "b": [0, 0]})";
}

// The same with this number in b[1].
std::string WithNumber(const std::string& literal) {
  return R"({"format": "stiction-problem", "version": 1, "name": "one", "dimension": 2,
             "contacts": [{"kind": "static", "mu": 1}], "A": [[0, 0], [0, 0]], "b": [0, )" +
         literal + "]}";
}

// The reference with one piece of its text replaced.
std::string Edited(const std::string& piece, const std::string& replacement) {
  std::string text = kReference;
  const std::size_t at = text.find(piece);
  REQUIRE(at != text.npos);
  return text.replace(at, piece.size(), replacement);
}

// The reference with members added at its end.
std::string WithMembers(const std::string& members) {
  return Edited(R"("b": ["2","-1","-2","2"])", R"("b": ["2","-1","-2","2"], )" + members);
}

std::string Refusal(const std::string& text) {
  try {
    (void)ParseProblem(text, "p.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// What is wrong with a file: at which place, what was found, what was expected.
struct Fault {
  std::string place, found, expected;
};

// A file, and all that is wrong with it, told in this order.
struct Refused {
  std::string text;
  std::vector<Fault> faults;

  Refused(std::string text, std::string place, std::string found, std::string expected)
      : Refused(std::move(text),
                std::vector<Fault>{{std::move(place), std::move(found), std::move(expected)}}) {}
  Refused(std::string text, std::vector<Fault> faults) : text(std::move(text)), faults(std::move(faults)) {}
};

void CheckRefusals(const std::vector<Refused>& table) {
  for (const Refused& refused : table) {
    INFO(refused.text);
    std::string told;
    for (const auto& [place, found, expected] : refused.faults)
      told += (told.empty() ? "p.json: " : "; ") + place + ": found " + found + ", expected " + expected;
    CHECK(Refusal(refused.text) == told);
  }
}

// Found.
const std::string kNothing = "nothing", kTwice = "a duplicate key", kUnknown = "an unknown key";
// Expected.
const std::string kOnce = "each key once", kObject = "an object", kText = "a string",
                  kOneOrMinusOne = R"("1" or "-1")";
const std::string kKeys =
    "only format, version, name, dimension, contacts, mu, A, b, factors, scene, origin, expect";
const std::string kKeysOfContact = "only kind, mu, slip", kKeysOfSparse = "only size, entries",
                  kKeysOfFactors = "only J, M, w, c";
const std::string kKinds = "one of bilateral, frictionless, static, sliding";
const std::string kNumber =
    R"(a number, such as "-3/4" (denominator not zero) or "2.5e-3" (exponent within 10000))";
const std::string kUnitSlip = "a unit vector of two numbers [x, y], x^2 + y^2 = 1";
const std::string kArrayOfRows = R"(an array of rows, or {"size", "entries"})",
                  kMatrix = kArrayOfRows + "; or factors for A and b";
const std::string kNumbers = "an array of numbers", kEach = ", one per row of the contacts";
const std::string kRowsOfContacts = "2, the rows of the contacts",
                  kEntries = "an array of entries [i, j, value]";
const std::string kEntry = "an entry [i, j, value]", kRowNumber = "a row number >= 0 and < 2";
const std::string kOfBlocks = "4, the columns of J", kMasses = "a positive definite block of masses";
const std::string kNotDefinite = "a block that is not positive definite";
const std::string kNoFactors = "one of the two: factors say A and b",
                  kWhole = "an integer that is a double exactly, or a string";
const std::string kOutcomes = "one of solved, cycle, stall, ray, singular, limit, undecided";

bool SameProblem(const ExactProblem& x, const ExactProblem& y) {
  if (x.dimension != y.dimension || x.contacts.size() != y.contacts.size() || x.rows() != y.rows())
    return false;
  bool same = x.A.rows() == y.A.rows() && x.A.cols() == y.A.cols();
  for (std::size_t i = 0; i < x.contacts.size(); ++i) {
    const auto& [kind, mu, slip] = x.contacts[i];
    same = same && kind == y.contacts[i].kind && mu == y.contacts[i].mu && slip == y.contacts[i].slip;
  }
  for (int i = 0; same && i < x.rows(); ++i) {
    same = x.b(i) == y.b(i);
    for (int j = 0; same && j < x.rows(); ++j) same = x.A(i, j) == y.A(i, j);
  }
  return same;
}

bool SameFile(const ProblemFile& x, const ProblemFile& y) {
  return x.name == y.name && SameProblem(x.problem, y.problem) && *x.scene == *y.scene &&
         *x.origin == *y.origin && x.expect == y.expect;
}

// ---- Reading ---------------------------------------------------------------------------------

TEST_CASE("problem file: the reference problem is read value by value") {
  const ProblemFile file = ParseProblem(kReference, "p.json");
  const ExactProblem& problem = file.problem;
  CHECK(file.name == "two-contact-cycle");
  CHECK(problem.dimension == 2);
  REQUIRE(problem.contacts.size() == 2);
  CHECK(problem.contacts[1].kind == ContactKind::kStatic);
  CHECK(problem.contacts[1].mu == 1);
  REQUIRE(problem.rows() == 4);
  CHECK(problem.A(1, 3) == -7);
  CHECK(problem.A(3, 2) == 3);
  CHECK(problem.b(2) == -2);
  CHECK_FALSE(file.scene);
  CHECK_FALSE(file.origin);
  CHECK(file.expect.empty());
}

TEST_CASE("problem file: no contacts at all is valid") {
  const std::string text =
      R"({"format": "stiction-problem", "version": 1, "name": "", "dimension": 3,
          "contacts": [], "A": [], "b": []})";
  const ProblemFile file = ParseProblem(text, "p.json");
  CHECK(file.problem.contacts().empty());
  CHECK(file.problem.rows() == 0);
  CHECK(SameFile(ParseProblem(Print(file), "printed"), file));
  const std::string sparse = R"({"format": "stiction-problem", "version": 1, "name": "", "dimension": 2,
                                 "contacts": [], "A": {"size": 0, "entries": []}, "b": []})";
  CHECK(ParseProblem(sparse, "p.json").problem.dense().A.rows() == 0);
}

TEST_CASE("problem file: every kind of contact is read with its rows") {
  const auto first = [](const std::string& text) {
    return ParseProblem(text, "p.json").problem.contacts().at(0);
  };
  CHECK(first(OneContact(R"("kind": "bilateral")", 2, 1)).kind == ContactKind::kBilateral);
  CHECK(first(OneContact(R"("kind": "frictionless")", 3, 1)).kind == ContactKind::kFrictionless);
  CHECK(first(OneContact(R"("kind": "static", "mu": 0.5)", 3, 3)).mu == Rational(1, 2));
  CHECK(first(OneContact(R"("kind": "static", "mu": "0")")).mu == 0);
  const auto planar = first(OneContact(R"("kind": "sliding", "mu": "1/3", "slip": "-1")"));
  CHECK(planar.kind == ContactKind::kSliding);
  CHECK(planar.mu == Rational(1, 3));
  CHECK(planar.slip == std::array<Rational, 2>{-1, 0});
  const auto spatial = first(OneContact(R"("kind": "sliding", "mu": 1, "slip": ["-3/5", "0.8"])", 3, 3));
  CHECK(spatial.slip == std::array<Rational, 2>{Rational(-3, 5), Rational(4, 5)});
  CHECK(first(OneContact(R"("kind": "sliding", "mu": 1, "slip": [0, -1])", 3, 3)).slip[1] == -1);
}

TEST_CASE("problem file: numbers are taken at their exact value") {
  const std::vector<std::pair<std::string, std::string>> table = {
      {R"("-3/4")", "-3/4"},
      {R"("2.5e-3")", "1/400"},
      {R"("0.1")", "1/10"},
      {R"("18446744073709551617")", "18446744073709551617"},
      {"0.1", "3602879701896397/36028797018963968"},
      {"-0", "0"},
      {"-0.0", "0"},
      {"1.5", "3/2"},
      {"1E2", "100"},
      {"0e-400", "0"},
      {R"("1e-3")", "1/1000"},
      {"9007199254740992", "9007199254740992"},
      {"9007199254740994", "9007199254740994"},
      {"-9223372036854775808", "-9223372036854775808"},
      {"18446744073709549568", "18446744073709549568"},
      {"18446744073709551616", "18446744073709551616"},
      {"-100000000000000000000", "-100000000000000000000"},
      {"9007199254740993.0", "9007199254740992"},
  };
  for (const auto& [literal, expected] : table) {
    INFO(literal);
    CHECK(ToString(ParseProblem(WithNumber(literal), "p.json").problem.b()[1]) == expected);
  }
}

TEST_CASE("problem file: an entry of A below the diagonal stands for its mirror unless that is listed") {
  const auto A = [](const std::string& text) { return ParseProblem(WithA(text), "p.json").problem.dense().A; };
  const auto symmetric = A(R"({"size": 2, "entries": [[1, 0, "1/2"], [0, 0, 3]]})");
  CHECK(symmetric(0, 0) == 3);
  CHECK(symmetric(1, 0) == Rational(1, 2));
  CHECK(symmetric(0, 1) == Rational(1, 2));
  CHECK(symmetric(1, 1) == 0);
  for (const std::string text : {R"({"size": 2, "entries": [[1, 0, "1/2"], [0, 1, 0]]})",
                                 R"({"entries": [[0, 1, 0], [1, 0, 0.5]], "size": 2})"}) {
    CHECK(A(text)(1, 0) == Rational(1, 2));
    CHECK(A(text)(0, 1) == 0);
  }
}

TEST_CASE("problem file: scene, origin and expect are kept") {
  const ProblemFile file = ParseProblem(
      WithMembers(
          R"("scene": "stack", "origin": {"seed": 18446744073709551615, "parent": [1, null, {"x": -0.1}]},
                     "expect": {"paper": "cycle", "ties=contacts,scan=highest": "solved", "*": "undecided"})"),
      "p.json");
  CHECK(*file.scene == Json("stack"));
  REQUIRE(file.origin);
  CHECK(file.origin->at("seed").get<std::uint64_t>() == UINT64_MAX);
  CHECK(file.expect.size() == 3);
  CHECK(file.expect.at("ties=contacts,scan=highest") == "solved");
  CHECK(SameFile(ParseProblem(Print(file), "printed"), file));
}

TEST_CASE("problem file: what is left out has its default") {
  std::string text = kReference;
  for (const std::string piece : {R"("format": "stiction-problem", "version": 1,)", R"(, "dimension": 2)"})
    text.erase(text.find(piece), piece.size());
  CHECK(SameFile(ParseProblem(text, "p.json"), ParseProblem(kReference, "p.json")));
  const std::string name = R"("name": "two-contact-cycle",)";
  text = kReference;
  text.erase(text.find(name), name.size());
  CHECK(ParseProblem(text, "folder/my problem.json").name == "my problem");
}

TEST_CASE("problem file: A, b and mu alone are static contacts") {
  const auto read = [](const std::string& text) { return ParseProblem(text, "p.json").problem; };
  const ExactProblem one = read(R"({"A": [[2, 0], [0, 3]], "b": [-1, 1], "mu": "1/2"})");
  CHECK(one.dimension == 2);
  REQUIRE(one.contacts.size() == 1);
  CHECK(one.contacts[0].kind == ContactKind::kStatic);
  CHECK(one.contacts[0].mu == Rational(1, 2));
  const ExactProblem space = read(R"({"A": {"size": 6, "entries": []}, "b": [0,0,0,0,0,0], "mu": [1, 0]})");
  CHECK(space.dimension == 3);
  REQUIRE(space.contacts.size() == 2);
  CHECK(space.contacts[1].mu == 0);
  CheckRefusals({
      {R"({"A": {"size": 6, "entries": []}, "b": [0,0,0,0,0,0], "mu": 1})", "dimension", kNothing,
       "2 or 3: 6 rows fit both"},
      {R"({"A": [[1]], "b": [0], "mu": 1})", "dimension", kNothing, "2 or 3: 1 rows fit neither"},
      {WithMembers(R"("mu": 1)"), "mu", "mu beside contacts", "one of the two: each contact has its own mu"},
      // Contacts that are no list tell no dimension; mu does.
      {R"({"contacts": 5, "mu": [1, 1], "A": {"size": 6, "entries": []}, "b": [0, 0, 0, 0, 0, 0]})", "mu",
       "mu beside contacts", "one of the two: each contact has its own mu"},
  });
}

TEST_CASE("problem file: an A of entries stays so, and is printed so") {
  const ProblemFile read = ParseProblem(
      R"({"A": {"size": 4, "entries": [[0, 0, 1], [2, 0, "1/2"], [3, 1, 5], [1, 3, 0], [1, 2, 7], [2, 1, 0],
         [3, 3, 0]]}, "b": [1, 2, 3, 4], "mu": [1, 2]})",
      "p.json");
  CHECK(!read.problem.IsDense());
  const SparseMatrix expected = {
      {{0, 0}, 1}, {{0, 2}, Rational(1, 2)}, {{1, 2}, 7}, {{2, 0}, Rational(1, 2)}, {{3, 1}, 5}};
  CHECK(ByRows(read.problem.entries().A) == expected);
  CHECK(read.problem.contacts()[1].mu == 2);
  const std::string text = Print(read);
  CHECK(text.find("entries") != text.npos);
  const ProblemFile again = ParseProblem(text, "printed");
  CHECK(ByRows(again.problem.entries().A) == expected);
  CHECK(SameProblem(again.problem, read.problem));
}

TEST_CASE("problem file: more rows than a caller takes are refused") {
  constexpr const char* kFour = R"({"A": {"size": 4, "entries": []}, "b": [1, 2, 3, 4], "mu": 1})";
  CHECK_NOTHROW(ParseProblem(kFour, "p.json", 4));
  CHECK_THROWS_AS(ParseProblem(kFour, "p.json", 3), InputError);
}

// ---- Factors ---------------------------------------------------------------------------------

// Two contacts on two bodies, one of which has a block of its own; c is not zero.
const std::string kFactored = R"({
  "factors": {
    "J": {"size": [4, 4], "entries": [[0, 0, 1], [1, 1, "1/3"], [2, 2, 1], [2, 0, -1], [3, 3, 2], [3, 1, 0]]},
    "M": [2, [["1/2"]], [[2, "1/3"], ["1/3", 4]]],
    "w": ["-9.81", 0, 1, "1/7"], "c": [0, "1/5", 0, 0]
  },
  "mu": [1, "1/2"]
})";

std::string WithFactors(const std::string& from, const std::string& to) {
  std::string text = kFactored;
  return text.replace(text.find(from), from.size(), to);
}

TEST_CASE("problem file: factors J, M, w, c stand for A = J inv(M) J' and b = J w + c, exactly") {
  const ProblemFile file = ParseProblem(kFactored, "p.json");
  REQUIRE(file.problem.factors() != nullptr);
  const ExactProblem::Matrix J = file.problem.factors()->A.J().toDense(),
                             M = file.problem.factors()->M.toDense(), A = file.problem.dense().A;
  CHECK(M(2, 3) == Rational(1, 3));
  // With X = inv(M) J'.
  const ExactProblem::Matrix X = file.problem.factors()->A.W().toDense() * J.transpose();
  CHECK((M * X - J.transpose()).isZero(0));
  CHECK((J * X - A).isZero(0));
  CHECK(A(0, 2) == Rational(-1, 2));
  CHECK(A(2, 3) == Rational(-2, 3) / (Rational(8) - Rational(1, 9)));
  CHECK(file.problem.b()[1] == Rational(1, 5));
  CHECK(file.problem.b()[2] == Rational(1) + Rational(981, 100));
  const ProblemFile again = ParseProblem(Print(file), "printed");
  CHECK(SameProblem(again.problem, file.problem));
  REQUIRE(again.problem.factors() != nullptr);
  CHECK(ToJson(*again.problem.factors()) == ToJson(*file.problem.factors()));
  CHECK(ToJson(*again.problem.factors())["M"] == Json::parse(R"(["2", "1/2", [["2", "1/3"], ["1/3", "4"]]])"));
}

TEST_CASE("problem file: J may be rows of numbers, and c is zero where it is left out") {
  const ProblemFile file =
      ParseProblem(R"({"factors": {"J": [[1, 0], [0, 1]], "M": [2, 4], "w": [-1, 1]}, "mu": 1})", "p.json");
  CHECK(file.problem.dense().A(0, 0) == Rational(1, 2));
  CHECK(file.problem.dense().A(0, 1) == 0);
  CHECK(file.problem.b()[0] == -1);
  CHECK(file.problem.contacts().size() == 1);
  CHECK(!ToJson(*file.problem.factors()).contains("c"));
}

TEST_CASE("problem file: factors that tell no number of rows are refused by what they lack") {
  for (const std::string J : {"0", "null", "\"x\"", "true"}) {
    CheckRefusals({{R"({"factors": {"J": )" + J + R"(, "M": [1, 1], "w": [0, 0]}, "mu": 1})", "factors.J", J,
                    R"({"size": [rows, velocities], "entries"}, or an array of rows)"}});
  }
  CheckRefusals({
      {R"({"factors": {"J": {"size": [-1, 2], "entries": []}, "M": [1, 1], "w": [0, 0]}, "mu": 1})",
       "dimension", "nothing, and no sizes that tell it",
       "2 or 3, and b, A or factors.J with a row each for the contacts"},
      {R"({"factors": {"J": {"size": [0, 5], "entries": []}, "M": [1, 1], "w": [0, 0]}, "mu": []})",
       "factors.M", "blocks of 2 velocities", "5, the columns of J"},
  });
}

TEST_CASE("problem file: factors without rows, columns or entries are a problem") {
  const ProblemFile none =
      ParseProblem(R"({"factors": {"J": [], "M": [1, 1], "w": [0, 0]}, "mu": 1})", "p.json");
  CHECK(none.problem.contacts().empty());
  const ProblemFile still = ParseProblem(
      R"({"factors": {"J": {"size": [2, 0], "entries": []}, "M": [], "w": [], "c": [-1, 0]}, "mu": 1})",
      "p.json");
  CHECK(still.problem.dense().A.isZero(0));
  CHECK(still.problem.b()[0] == -1);
  CHECK(SameProblem(ParseProblem(Print(still), "printed").problem, still.problem));
}

// M of `size` velocities, 2 on the diagonal and fractions beside it.
std::string LargeBlock(int size, const std::string& diagonal) {
  std::string M;
  for (int i = 0; i < size; ++i) {
    M += i == 0 ? "[[" : "], [";
    for (int j = 0; j < size; ++j)
      M += std::string(j == 0 ? "" : ", ") +
           (i == j ? diagonal : "\"1/" + std::to_string(70 + std::abs(i - j)) + '"');
  }
  return M + "]]";
}

std::string WithLargeBlock(int size, const std::string& diagonal) {
  std::string w = "1";
  for (int i = 1; i < size; ++i) w += ", -1";
  return R"({"factors": {"J": {"size": [2, )" + std::to_string(size) +
         R"(], "entries": [[0, 0, 1], [0, 3, "1/3"], [1, 1, 2]]}, "M": [)" + LargeBlock(size, diagonal) +
         R"(], "w": [)" + w + R"(]}, "mu": 1})";
}

TEST_CASE("problem file: A of a large block of masses is J inv(M) J', exactly, and its inverse is not formed") {
  for (const int size : {kMostWholeInverse, kMostWholeInverse + 1, 40}) {
    CAPTURE(size);
    const ProblemFile file = ParseProblem(WithLargeBlock(size, "2"), "p.json");
    REQUIRE(file.problem.factors() != nullptr);
    const auto inverse = InverseOfDefinite(ExactProblem::Matrix(file.problem.factors()->M.toDense()));
    REQUIRE(inverse);
    const ExactProblem::Matrix J = file.problem.factors()->A.J().toDense();
    CHECK((file.problem.dense().A == J * *inverse * J.transpose()));
    const ExactProblem::Vector f = (ExactProblem::Vector(2) << Rational(3), Rational(-1, 7)).finished();
    CHECK((file.problem.factors()->Responses(f) == *inverse * J.transpose() * f));
    CHECK((file.problem.factors()->Accelerations(f) == file.problem.dense().A * f + file.problem.b()));
    CHECK(file.problem.factors()->A.W().nonZeros() == (size > kMostWholeInverse ? 0 : size * size));
    const FactoredProblem<double> rounded = InDoubles(*file.problem.factors());
    const Eigen::VectorXd moved = rounded.Responses(f.unaryExpr(&ToDouble));
    CHECK((moved - file.problem.factors()->Responses(f).unaryExpr(&ToDouble)).norm() < 1e-14);
  }
}

TEST_CASE("problem file: sizes of forces in factors are told from below, where doubles hold them") {
  const ProblemFile file = ParseProblem(WithLargeBlock(kMostWholeInverse + 1, "2"), "p.json");
  const ExactFactors& factors = *file.problem.factors();
  for (const char* scale : {"1", "1e-200", "1e-260", "1e-400", "1e400"}) {
    INFO(scale);
    const ExactProblem::Vector f =
        ExactProblem::Vector((ExactProblem::Vector(2) << Rational(3), Rational(-1, 7)).finished()) *
        *ParseRational(scale);
    std::vector<Rational> below(2, Rational(1)), exact = below;
    AddSizes(factors, f, below);
    AddSizes<ExactFactors, ExactProblem::Vector, Rational>(factors, f, exact);
    const bool held = ToDouble(abs(f[0])) > 1e-250 && ToDouble(abs(f[0])) < 1e250;
    for (int i = 0; i < 2; ++i) {
      const Rational size = exact[i] - 1, told = below[i] - 1;
      CHECK((held ? told < size : told == size));
      CHECK(told > size * Rational(1 - 1e-12));
    }
  }
}

TEST_CASE("problem file: a large block of masses is definite or refused, whatever doubles say of it") {
  const auto refuse = [](const std::string& text) {
    CheckRefusals({{text, "factors.M[0]", kNotDefinite, kMasses}});
  };
  refuse(WithLargeBlock(20, "\"1/1000\""));  // indefinite
  refuse(WithLargeBlock(20, "0"));
  refuse(WithLargeBlock(20, "-2"));
  // All ones is singular; 1e-40 more on the diagonal, which doubles do not see, makes it definite.
  const int size = 14;
  const auto of_ones = [&](const std::string& diagonal) {
    std::string M, w;
    for (int i = 0; i < size; ++i) {
      M += i == 0 ? "[" : ", [";
      w += i == 0 ? "0" : ", 0";
      for (int j = 0; j < size; ++j) M += (j == 0 ? "" : ", ") + (i == j ? diagonal : std::string("1"));
      M += "]";
    }
    return R"({"factors": {"J": {"size": [2, 14], "entries": [[0, 0, 1]]}, "M": [[)" + M + R"(]], "w": [)" + w +
           R"(]}, "mu": 1})";
  };
  refuse(of_ones("1"));
  const std::string more = "\"1." + std::string(39, '0') + "1\"";
  CHECK(ParseProblem(of_ones(more), "p.json").problem.dense().A(0, 0) > 0);
}

TEST_CASE("problem file: the exact arithmetic of reading ends when somebody says so") {
  const std::atomic<bool> stopped = true, goes_on = false;
  {
    const Stop stop(&stopped);
    CHECK_THROWS_AS(ParseProblem(WithLargeBlock(20, "2"), "p.json"), Stopped);
    const Stop inner(&goes_on);
    CHECK_NOTHROW(ParseProblem(WithLargeBlock(20, "2"), "p.json"));
  }
  CHECK_NOTHROW(ParseProblem(WithLargeBlock(20, "2"), "p.json"));
}

TEST_CASE("problem file: wrong keys of all levels are told at once") {
  CheckRefusals({
      {R"({"A": {"size": 2, "entries": [], "order": 1}, "b": [0, 0], "contacts": [{"kind": "static", "mu": 1, "Mu": 2}],
           "colour": 1})",
       {{"colour", kUnknown, kKeys},
        {"contacts[0].Mu", kUnknown, kKeysOfContact},
        {"A.order", kUnknown, kKeysOfSparse}}},
      {R"({"contacts": [{"sort": "static", "mu": 1}], "A": [[0, 0], [0, 0]], "b": [0, 0]})",
       {{"contacts[0].sort", kUnknown, kKeysOfContact}, {"contacts[0].kind", kNothing, kKinds}}},
      {R"({"factors": {"J": {"size": [2, 1], "entries": [], "x": 1}, "M": [1], "w": [0], "y": 2}, "mu": 1, "z": 3})",
       {{"z", kUnknown, kKeys},
        {"factors.y", kUnknown, kKeysOfFactors},
        {"factors.J.x", kUnknown, kKeysOfSparse}}},
  });
}

TEST_CASE("problem file: of factors A is formed when asked for, all of it or its entries") {
  const AnyProblem problem = ParseProblem(kFactored, "p.json").problem;
  REQUIRE(problem.factors() != nullptr);
  const ExactProblem& dense = problem;
  const ExactEntries& entries = problem.entries();
  CHECK(&problem.dense() == &dense);
  CHECK(dense.b == problem.factors()->b);
  CHECK(entries.A.coeff(0, 2) == dense.A(0, 2));
  CHECK(entries.A.nonZeros() == (dense.A.array() != Rational(0)).count());
}

TEST_CASE("problem file: what is wrong with factors is told at once, M by its block") {
  CheckRefusals({
      {WithFactors(R"([[2, "1/3"], ["1/3", 4]])", R"([[2, "1/3"], ["1/4", 4]])"), "factors.M[2]",
       "entries (0, 1) and (1, 0) that differ", "a symmetric block"},
      {WithFactors(R"([[2, "1/3"], ["1/3", 4]])", "[[2, 3], [3, 4]]"), "factors.M[2]", kNotDefinite, kMasses},
      {WithFactors(R"("M": [2)", R"("M": [0)"), "factors.M[0]", kNotDefinite, kMasses},
      {WithFactors(R"("M": [2, )", R"("M": [)"), "factors.M", "blocks of 3 velocities", kOfBlocks},
      {WithFactors(R"("size": [4, 4])", R"("size": [5, 4])").insert(1, R"("b": [0, 0, 0, 0], )"),
       {{"b", "b beside factors", kNoFactors}, {"factors.J.size[0]", "5", "4, the rows of the contacts"}}},
      {WithFactors("[3, 3, 2]", "[3, 4, 2]"), "factors.J.entries[4][1]", "4", "a column number >= 0 and < 4"},
      {WithFactors(R"("1/7"])", R"("x"])"), "factors.w[3]", R"("x")", kNumber},
      {WithFactors(R"("mu": [1, "1/2"])", R"("mu": [1, "1/2"], "b": [0, 0, 0, 0])"), "b", "b beside factors",
       kNoFactors},
      {R"({"factors": {"J": [[1, 0], [0, "x"]], "M": [[1, 2], -1], "v": [], "c": 1}, "mu": 1})",
       {{"factors.v", kUnknown, kKeysOfFactors},
        {"factors.J[1][1]", R"("x")", kNumber},
        {"factors.M[0][0]", "1", "an array of 2 numbers, one for each row of the block"},
        {"factors.w", kNothing, kNumbers + ", one for each velocity"},
        {"factors.c", "1", "an array of 2 numbers, one for each row"}}},
  });
}

// ---- Refusals --------------------------------------------------------------------------------

TEST_CASE("problem file: a wrong format, version or dimension is refused") {
  CheckRefusals({
      {"[]", "$", "[]", kObject},
      {"null", "$", "null", kObject},
      {"{}",
       {{"contacts", kNothing, "an array of contacts, or mu of static ones"},
        {"A", kNothing, kMatrix},
        {"b", kNothing, kNumbers}}},
      {Edited("stiction-problem", "stiction-certificate"), "format", R"("stiction-certificate")",
       R"("stiction-problem" (stiction check verifies a certificate))"},
      {Edited(R"("version": 1)", R"("version": 2)"), "version", "2", "1"},
      {Edited(R"("version": 1)", R"("version": 1.0)"), "version", "1.0", "1"},
      {Edited(R"("version": 1)", R"("version": "1")"), "version", R"("1")", "1"},
      {Edited(R"("version": 1)", R"("version": 18446744073709551615)"), "version", "18446744073709551615", "1"},
      {Edited(R"("dimension": 2)", R"("dimension": 1)"), "dimension", "1", "2 or 3"},
      {Edited(R"("dimension": 2)", R"("dimension": 4)"), "dimension", "4", "2 or 3"},
      {Edited(R"("dimension": 2)", R"("dimension": true)"), "dimension", "true", "2 or 3"},
      {Edited(R"("two-contact-cycle")", "7"), "name", "7", kText},
  });
}

TEST_CASE("problem file: all that is missing or wrong is told at once") {
  CheckRefusals({
      {R"({"contacts": [{"kind": "static"}, {"kind": "sticky"}], "name": 1, "c": 1, "d": 2})",
       {{"c, d", "unknown keys", kKeys},
        {"contacts[0].mu", kNothing, "the mu of a static contact, a number >= 0"},
        {"contacts[1].kind", R"("sticky")", kKinds},
        {"A", kNothing, kMatrix},
        {"b", kNothing, kNumbers},
        {"name", "1", kText}}},
  });
}

TEST_CASE("problem file: friction without a bound is a frictionless row, and bilateral ones") {
  using enum ContactKind;
  const auto kinds = [](const std::string& text) {
    std::vector<ContactKind> result;
    const ProblemFile file = ParseProblem(text, "p.json");
    for (const Contact<Rational>& contact : file.problem.contacts()) {
      CHECK(contact.mu == (contact.kind == kStatic ? 1 : 0));
      result.push_back(contact.kind);
    }
    return result;
  };
  CHECK(kinds(OneContact(R"("kind": "static", "mu": "inf")")) == std::vector{kFrictionless, kBilateral});
  CHECK(kinds(OneContact(R"("kind": "static", "mu": "inf")", 3, 3)) ==
        std::vector{kFrictionless, kBilateral, kBilateral});
  const std::string matrix = R"("A": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "b": [0,0,0,0])";
  CHECK(kinds(R"({"mu": ["inf", 1], )" + matrix + "}") == std::vector{kFrictionless, kBilateral, kStatic});
  CHECK(kinds(R"({"mu": "inf", )" + matrix + "}") ==
        std::vector{kFrictionless, kBilateral, kFrictionless, kBilateral});
  CHECK_THAT(Refusal(OneContact(R"("kind": "sliding", "mu": "inf", "slip": "1")")),
             Catch::Contains("that of a static contact"));
}

TEST_CASE("problem file: an unknown key is refused wherever it stands") {
  CheckRefusals({
      {WithMembers(R"("c": 1)"), "c", kUnknown, kKeys},
      {WithMembers(R"("a b": 1)"), R"(["a b"])", kUnknown, kKeys},
      {OneContact(R"("kind": "static", "mu": 1, "Mu": 1)"), "contacts[0].Mu", kUnknown, kKeysOfContact},
      {WithA(R"({"size": 2, "entries": [], "order": 1})"), "A.order", kUnknown, kKeysOfSparse},
  });
}

TEST_CASE("problem file: a duplicate key is refused wherever it stands") {
  CheckRefusals({
      {Edited(R"("version": 1,)", R"("version": 1, "version": 1,)"), "version", kTwice, kOnce},
      {OneContact(R"("kind": "static", "mu": "1", "mu": "2")"), "contacts[0].mu", kTwice, kOnce},
      {OneContact(R"("kind": "static", "mu": "1", "m\u0075": "1")"), "contacts[0].mu", kTwice, kOnce},
      {WithMembers(R"("origin": {"list": [0, [1, {"a": [], "b": {}, "a": 1}]]})"), "origin.list[1][1].a",
       kTwice, kOnce},
      {WithMembers(R"("expect": {"paper": "cycle", "paper": "cycle"})"), "expect.paper", kTwice, kOnce},
  });
}

TEST_CASE("problem file: a wrong kind of contact is refused") {
  CheckRefusals({
      {OneContact(R"("kind": "sticky")"), "contacts[0].kind", R"("sticky")", kKinds},
      {OneContact(R"("kind": "Static", "mu": 1)"), "contacts[0].kind", R"("Static")", kKinds},
      {OneContact(R"("kind": 2)"), "contacts[0].kind", "2", kKinds},
      {OneContact(R"("mu": "1")"), "contacts[0].kind", kNothing, kKinds},
      {Edited(R"({"kind": "static", "mu": "1"})", R"("static")"), "contacts[0]", R"("static")", kObject},
      {Edited(R"("contacts")", R"("contacts": {}, "scene")"), "contacts", "{}", "an array of contacts"},
  });
}

TEST_CASE("problem file: a negative, missing or misplaced mu is refused") {
  CheckRefusals({
      {OneContact(R"("kind": "static", "mu": "-1/1000")"), "contacts[0].mu", R"("-1/1000")", "mu >= 0"},
      {OneContact(R"("kind": "static", "mu": -1e-300)"), "contacts[0].mu", "-1e-300", "mu >= 0"},
      {OneContact(R"("kind": "static")"), "contacts[0].mu", kNothing,
       "the mu of a static contact, a number >= 0"},
      {OneContact(R"("kind": "sliding", "slip": "1")"), "contacts[0].mu", kNothing,
       "the mu of a sliding contact, a number >= 0"},
      {OneContact(R"("kind": "frictionless", "mu": 0)", 2, 1), "contacts[0].mu", "0",
       "no mu on a frictionless contact"},
      {OneContact(R"("kind": "bilateral", "mu": "1")", 2, 1), "contacts[0].mu", R"("1")",
       "no mu on a bilateral contact"},
      {OneContact(R"("kind": "static", "mu": null)"), "contacts[0].mu", "null", kNumber},
  });
}

TEST_CASE("problem file: a wrong, missing or misplaced slip is refused") {
  const auto spatial = [](const std::string& slip) {
    return OneContact(R"("kind": "sliding", "mu": 1, "slip": )" + slip, 3, 3);
  };
  const auto planar = [](const std::string& slip) {
    return OneContact(R"("kind": "sliding", "mu": 1, "slip": )" + slip);
  };
  CheckRefusals({
      {planar(R"("2")"), "contacts[0].slip", R"("2")", kOneOrMinusOne},
      {planar(R"("0")"), "contacts[0].slip", R"("0")", kOneOrMinusOne},
      {planar("1"), "contacts[0].slip", "1", kOneOrMinusOne},
      {planar(R"(["1", "0"])"), "contacts[0].slip", R"(["1","0"])", kOneOrMinusOne},
      {spatial(R"("1")"), "contacts[0].slip", R"("1")", kUnitSlip},
      {spatial(R"(["1"])"), "contacts[0].slip", R"(["1"])", kUnitSlip},
      {spatial(R"(["1", "0", "0"])"), "contacts[0].slip", R"(["1","0","0"])", kUnitSlip},
      {spatial(R"(["1", "1"])"), "contacts[0].slip", R"(["1","1"])", kUnitSlip},
      {spatial("[0.6, 0.8]"), "contacts[0].slip", "[0.6,0.8]", kUnitSlip},
      {OneContact(R"("kind": "sliding", "mu": 1)"), "contacts[0].slip", kNothing,
       "the direction of the sliding velocity"},
      {OneContact(R"("kind": "static", "mu": 1, "slip": "1")"), "contacts[0].slip", R"("1")",
       "no slip on a static contact"},
      {OneContact(R"("kind": "bilateral", "slip": "1")", 2, 1), "contacts[0].slip", R"("1")",
       "no slip on a bilateral contact"},
      {spatial(R"(["3/5", "x"])"), "contacts[0].slip[1]", R"("x")", kNumber},
  });
}

TEST_CASE("problem file: a wrong shape is refused") {
  CheckRefusals({
      {Edited(R"(,
    ["0","-7","3","7"])",
              ""),
       "A", "3 rows", "4 rows" + kEach},
      {Edited(R"(["-2","9","-1","-7"])", R"(["-2","9","-1"])"), "A[1]", "3 numbers", "4 numbers" + kEach},
      {Edited(R"(["-2","9","-1","-7"])", R"(["-2","9","-1","-7","0"])"), "A[1]", "5 numbers",
       "4 numbers" + kEach},
      {Edited(R"(["-2","9","-1","-7"])", R"("9")"), "A[1]", R"("9")", "an array of 4 numbers" + kEach},
      {Edited(R"(["2","-1","-2","2"])", R"(["2","-1","-2"])"), "b", "3 numbers", "4 numbers" + kEach},
      {Edited(R"(["2","-1","-2","2"])", "{}"), "b", "{}", "an array of 4 numbers" + kEach},
      {Edited(R"("dimension": 2)", R"("dimension": 3)"),
       {{"A", "4 rows", "6 rows" + kEach}, {"b", "4 numbers", "6 numbers" + kEach}}},
      {WithA("7"), "A", "7", kArrayOfRows},
      {Edited(R"(,
  "b": ["2","-1","-2","2"])",
              ""),
       "b", kNothing, kNumbers},
      {Edited(R"("A": [)", R"("origin": {}, "scene": [)"), "A", kNothing, kMatrix},
  });
}

TEST_CASE("problem file: wrong entries of a sparse A are refused") {
  const auto entries = [](const std::string& list) {
    return WithA(R"({"size": 2, "entries": [)" + list + "]}");
  };
  CheckRefusals({
      {WithA(R"({"size": 3, "entries": []})"), "A.size", "3", kRowsOfContacts},
      {WithA(R"({"size": 1000000000, "entries": []})"), "A.size", "1000000000", kRowsOfContacts},
      {WithA(R"({"entries": []})"), "A.size", kNothing, kRowsOfContacts},
      {WithA(R"({"size": 2})"), "A.entries", kNothing, kEntries},
      {WithA(R"({"size": 2, "entries": 1})"), "A.entries", "1", kEntries},
      {entries("[0, 0]"), "A.entries[0]", "[0,0]", kEntry},
      {entries("[0, 0, 1, 1]"), "A.entries[0]", "[0,0,1,1]", kEntry},
      {entries("[2, 0, 1]"), "A.entries[0][0]", "2", kRowNumber},
      {entries("[0, 0, 1], [1, -1, 1]"), "A.entries[1][1]", "-1", "a column number >= 0 and < 2"},
      {entries("[1.0, 0, 1]"), "A.entries[0][0]", "1.0", kRowNumber},
      {entries(R"(["1", 0, 1])"), "A.entries[0][0]", R"("1")", kRowNumber},
      {entries("[1, 0, 1], [0, 0, 1], [1, 0, 1]"), "A.entries[2]", "[1,0,1]", "each entry once"},
      {entries("[1, 1, 1], [0, 1, 5]"), "A.entries[1]", "[0,1,5]",
       "an entry above the diagonal only beside the one below"},
      {entries("[1, 0, []]"), "A.entries[0][2]", "[]", kNumber},
  });
}

TEST_CASE("problem file: a value that is not a number is refused with its place") {
  for (const std::string literal :
       {R"("x")", R"("")", R"("1,5")", R"("1/0")", R"("0/0")", R"("1e10001")", R"("1e-10001")", R"("inf")",
        R"("NaN")", R"(" 1")", R"("+1")", R"("1.")", "null", "true", "[]", "{}", R"(["1"])"}) {
    INFO(literal);
    CheckRefusals({{WithNumber(literal), "b[1]", literal, kNumber},
                   {WithA("[[0, 0], [0, " + literal + "]]"), "A[1][1]", literal, kNumber}});
  }
}

TEST_CASE("problem file: a number of a certificate has as many characters as are allowed, and no more") {
  const std::string source = "c.json";
  const Json most = std::string(kMostCharactersOfNumber, '1'), more = most.get<std::string>() + "1";
  CHECK(ToString(ExactNumber(JsonPlace(most, source, "b[1]"), true)) == most.get<std::string>());
  CHECK_THROWS_AS(ExactNumber(JsonPlace(more, source, "b[1]"), true), InputError);
}

TEST_CASE("problem file: a number beyond the doubles is refused, and told to be a string") {
  const auto in_range = [](const std::string& literal) {
    return "a number in the range of doubles; as a string, \"" + literal + "\", it is exact";
  };
  CheckRefusals({
      {WithNumber("1e400"), "b[1]", "1e400", in_range("1e400")},
      {WithNumber("-1e309"), "b[1]", "-1e309", in_range("-1e309")},
      {WithNumber("1e-400"), "b[1]", "1e-400, which is no double but 0", in_range("1e-400")},
      {WithMembers(R"("origin": {"x": [1, 1e999]})"), "origin.x[1]", "1e999", in_range("1e999")},
  });
  for (const std::string literal : {"1e-310", "-5e-324", "2.2e-308"}) {
    CAPTURE(literal);
    CHECK_THROWS_WITH(
        ParseProblem(WithNumber(literal), "p.json"),
        Catch::Contains("p.json: b[1]: found " + literal +
                        ", where doubles have fewer digits, expected "
                        "a number of magnitude 2.2250738585072014e-308 or more; as a string it is exact"));
  }
  CHECK(ParseProblem(WithNumber("2.3e-308"), "p.json").problem.b()[1] == Rational(2.3e-308));
  for (const std::string exact : {"1e-400", "-5e-324", "1e-10000", "1e400"})
    CHECK(ParseProblem(WithNumber('"' + exact + '"'), "p.json").problem.b()[1] == *ParseRational(exact));
}

TEST_CASE("problem file: an integer literal that is no exact double is refused") {
  for (const std::string literal :
       {"9007199254740993", "-9007199254740993", "9223372036854775807", "18446744073709551615",
        "18446744073709551617", "-9223372036854775809", "100000000000000000001"}) {
    INFO(literal);
    CheckRefusals({{WithNumber(literal), "b[1]", literal, kWhole}});
  }
  CheckRefusals({{WithMembers(R"("origin": {"seed": 18446744073709551617})"), "origin.seed",
                  "18446744073709551617", kWhole}});
}

TEST_CASE("problem file: a syntax error is refused with line and column") {
  const auto second_line = [](const std::string& literal) { return "{\n  \"b\": [0, " + literal + "]}"; };
  const std::vector<std::pair<std::string, std::string>> table = {
      {"", "line 1, column 1"},
      {"{\"format\":\n  oops}", "line 2, column 3"},
      {second_line("NaN"), "line 2, column 12"},
      {second_line("Infinity"), "line 2, column 12"},
      {second_line("-Infinity"), "line 2, column 13"},
      {second_line("01"), "line 2, column 13"},
      {second_line("+1"), "line 2, column 12"},
      {second_line(".5"), "line 2, column 12"},
      {second_line("1,"), "line 2, column 14"},
      {kReference + "x", "line 16, column 1"},
      {kReference + "{}", "line 16, column 1"},
      {"// note\n" + kReference, "line 1, column 1"},
      {"{'format': 1}", "line 1, column 2"},
      {"[\"\xFF\"]", "line 1, column 3"},
  };
  for (const auto& [text, message] : table) {
    INFO(text);
    CHECK_THAT(Refusal(text), Catch::StartsWith("p.json: " + message + ": found syntax error while parsing") &&
                                  Catch::EndsWith(", expected JSON text"));
  }
}

TEST_CASE("problem file: a NUL byte does not end the text") {
  const std::string nul(1, '\0');
  CheckRefusals({{kReference + nul + "x", "line 16, column 1", "a NUL byte", "JSON text"},
                 {nul, "line 1, column 1", "a NUL byte", "JSON text"}});
}

TEST_CASE("problem file: deep nesting is refused, not followed") {
  const auto nested = [](std::size_t levels) {
    return WithMembers(R"("scene": )" + std::string(levels, '[') + std::string(levels, ']'));
  };
  CHECK(Refusal(nested(kMaxJsonDepth - 1)) == "accepted");
  const std::string message = Refusal(nested(kMaxJsonDepth));
  CHECK_THAT(message,
             Catch::StartsWith("p.json: scene[0][0]") &&
                 Catch::EndsWith(": found deeper nesting, expected at most 100 levels of arrays and objects"));
  CHECK_THAT(Refusal(std::string(1000000, '[')), Catch::Contains("deeper nesting"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += R"({"a":)";
  CHECK_THAT(Refusal(objects), Catch::Contains("deeper nesting"));
}

TEST_CASE("problem file: a wrong origin or expect is refused") {
  CheckRefusals({
      {WithMembers(R"("origin": "seed 7")"), "origin", R"("seed 7")", kObject},
      {WithMembers(R"("expect": "cycle")"), "expect", R"("cycle")", kObject},
      {WithMembers(R"("expect": {"paper": "loop"})"), "expect.paper", R"("loop")", kOutcomes},
      {WithMembers(R"("expect": {"ties=contacts": null})"), R"(expect["ties=contacts"])", "null", kOutcomes},
      {WithMembers(R"("expect": {"paper": "cycle", "scan=lowest": "solved"})"), R"(expect["scan=lowest"])",
       kTwice, R"(each policy once (it is "paper" too))"},
      {WithMembers(R"("expect": {"ties=rows": "cycle"})"), R"(expect["ties=rows"])", R"("ties=rows")",
       R"(a policy or "*" (policy switch 'ties': found 'rows', expected one of sets, contacts))"},
  });
  CHECK(Refusal(WithMembers(R"("expect": {"": "cycle"})"))
            .starts_with(R"(p.json: expect[""]: found "", expected a)"));
  CHECK(Refusal(WithMembers(R"("expect": {"*,*": "cycle"})"))
            .starts_with(R"(p.json: expect["*,*"]: found "*,*")"));
}

TEST_CASE("problem file: what was found is shortened, between characters") {
  const std::string long_text(1000, 'x');
  CHECK(
      Refusal(Edited("\"static\"", '"' + long_text + '"'))
          .starts_with("p.json: contacts[0].kind: found \"" + std::string(59, 'x') + "... (1002 characters)"));
  CHECK(Shortened("abc\xC3\xA9", 5) == "abc\xC3\xA9");
  CHECK(Shortened("abc\xC3\xA9z", 4) == "abc... (6 characters)");
}

TEST_CASE("problem file: a file that cannot be read is refused with its name") {
  const auto refusal = [](const std::filesystem::path& file) -> std::string {
    try {
      (void)ReadProblem(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK(refusal("/nonexistent/p.json") ==
        "/nonexistent/p.json: found nothing to read (No such file or directory), expected a file");
  CHECK(refusal("/") == "/: found nothing to read (a directory), expected a file");
}

TEST_CASE("problem file: a file is read from disk, and errors name it") {
  const auto file =
      std::filesystem::temp_directory_path() / ("stiction-problem-" + std::to_string(getpid()) + ".json");
  const auto write = [&](const std::string& text) { std::ofstream(file, std::ios::binary) << text; };
  write(kReference);
  CHECK(SameFile(ReadProblem(file), ParseProblem(kReference, "p.json")));
  write("");
  CHECK_THROWS_WITH(ReadProblem(file), Catch::StartsWith(file.string() + ": line 1, column 1: "));
  std::filesystem::remove(file);
}

TEST_CASE("problem file: damaged text is refused, or read and written back to the same values") {
  std::mt19937_64 random(11);
  const std::string whole = WithMembers(R"("origin": {"seed": 1e3}, "expect": {"paper": "cycle"})");
  const std::string bytes = "{}[]\",:0123456789-+.eE/ \n\\u" + std::string(1, '\0') + "\xC3\xA9";
  int accepted = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string text = whole;
    for (int edits = 1 + static_cast<int>(random() % 2); edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      const std::size_t removed = random() % 3;
      text.replace(at, removed, random() % 3 ? std::string(1, bytes[random() % bytes.size()]) : "");
    }
    INFO(text);
    const std::string message = Refusal(text);  // any other exception fails the test
    accepted += message == "accepted";
    if (message != "accepted") {
      REQUIRE(message.starts_with("p.json: "));
      REQUIRE(message.find(": found ") != message.npos);
      REQUIRE(message.find(", expected ") != message.npos);
    } else {
      const ProblemFile file = ParseProblem(text, "p.json");
      REQUIRE(SameFile(ParseProblem(Print(file), "printed"), file));
    }
  }
  CHECK(accepted > 100);
  CHECK(accepted < 4000);
}

// ---- Certificates ----------------------------------------------------------------------------

TEST_CASE("problem of a certificate: paths start where the problem stands") {
  const Json json = ParseJson(R"({"problem": )" + Edited(R"("9")", R"("nine")") + "}", "c.json");
  CHECK_THROWS_WITH(ProblemFromJson(json.at("problem"), "c.json", "problem", false),
                    Catch::StartsWith("c.json: problem.A[1][1]: found \"nine\", expected a number"));
}

TEST_CASE("problem of a certificate: strict reading takes what ProblemToJson writes and nothing else") {
  const ExactProblem problem = ParseProblem(kReference, "p.json").problem;
  const Json json = ProblemToJson(problem);
  CHECK(SameProblem(ProblemFromJson(json, "c.json", "problem", true), problem));

  const auto refusal = [](const Json& edited) -> std::string {
    try {
      (void)ProblemFromJson(edited, "c.json", "problem", true);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  Json named = json;
  named["name"] = "x";
  CHECK(refusal(named) ==
        "c.json: problem.name: found an unknown key, expected only format, version, dimension, contacts, A, b");
  Json number = json;
  number["b"][2] = -2;
  CHECK_THAT(refusal(number),
             Catch::StartsWith("c.json: problem.b[2]: found -2, expected an exact number as a string"));
  Json mu = json;
  mu["contacts"][0]["mu"] = 1.0;
  CHECK_THAT(refusal(mu),
             Catch::StartsWith("c.json: problem.contacts[0].mu: found 1.0, expected an exact number"));
  Json missing = json;
  missing.erase("b");
  CHECK(refusal(missing) == "c.json: problem.b: found nothing, expected an array of numbers");
}

// ---- Writing ---------------------------------------------------------------------------------

TEST_CASE("problem file: the reference problem is printed as people write it") {
  CHECK(Print(ParseProblem(kReference, "p.json")) == kReference);
}

TEST_CASE("problem file: scene, origin and expect are printed after the problem") {
  ProblemFile file;
  file.name = "nothing";
  file.scene = Json("a\nb");
  file.origin = Json{{"seed", 7}};
  file.expect = {{"paper", "solved"}};
  CHECK(Print(file) == R"({
  "format": "stiction-problem", "version": 1,
  "name": "nothing", "dimension": 2,
  "contacts": [],
  "A": [],
  "b": [],
  "scene": "a\nb",
  "origin": {
    "seed": 7
  },
  "expect": {
    "paper": "solved"
  }
}
)");
}

TEST_CASE("problem file: what no reader would accept is not written") {
  const ProblemFile valid = ParseProblem(OneContact(R"("kind": "static", "mu": 1)"), "p.json");
  CHECK_NOTHROW(Print(valid));
  const auto refused = [&](auto edit) {
    ProblemFile file = valid;
    edit(file);
    CHECK_THROWS_AS(Print(file), InternalError);
  };
  const auto refused_problem = [&](auto edit) {
    ExactProblem problem = valid.problem;
    edit(problem, problem.contacts[0]);
    refused([&problem](ProblemFile& file) { file.problem = problem; });
  };
  refused_problem([](auto&, auto& contact) { contact.mu = -1; });
  refused_problem([](auto&, auto& contact) { contact.slip[0] = 1; });
  refused_problem([](auto&, auto& contact) { contact.kind = ContactKind::kSliding; });
  refused_problem([](auto&, auto& contact) { contact.kind = ContactKind::kFrictionless; });
  refused_problem([](auto& problem, auto&) { problem.dimension = 3; });
  refused_problem([](auto& problem, auto&) { problem.A.resize(2, 3); });
  refused_problem([](auto& problem, auto&) { problem.b.resize(3); });
  refused([](ProblemFile& file) { file.name = "\xFF"; });
  refused([](ProblemFile& file) { file.origin = Json{{"x", {1, std::numeric_limits<double>::infinity()}}}; });
  refused([](ProblemFile& file) { file.scene = Json(std::numeric_limits<double>::quiet_NaN()); });
}

// Random problems of all kinds, as a generator would make them and as a person would type them.
class RandomProblem {
 public:
  explicit RandomProblem(std::uint64_t seed) : random_(seed) {}

  ProblemFile File() {
    ProblemFile file;
    file.name = Pick({"", "a name", "quote \" and \\ and \xC3\xA9"});
    ExactProblem problem;
    problem.dimension = 2 + Below(2);
    for (int i = Below(5); i > 0; --i) problem.contacts.push_back(OneContact(problem.dimension));
    const int rows = RowCount(problem.contacts, problem.dimension);
    problem.A.resize(rows, rows);
    problem.b.resize(rows);
    for (int i = 0; i < rows; ++i) {
      problem.b[i] = Number();
      for (int j = 0; j < rows; ++j) problem.A(i, j) = j < i && Below(3) > 0 ? problem.A(j, i) : Number();
    }
    file.problem = std::move(problem);
    if (Below(2)) file.scene = Json{{"bodies", {1, 0.1, "x", nullptr}}};
    if (Below(2)) file.origin = Json{{"seed", random_()}, {"deep", {{"a", Json::array()}, {"b", -5e-324}}}};
    if (Below(2))
      file.expect["paper"] = Pick({"solved", "cycle", "stall", "ray", "singular", "limit", "undecided"});
    if (Below(2)) file.expect["drop=variable,scan=highest"] = "solved";
    if (Below(2)) file.expect["*"] = "cycle";
    return file;
  }

  // A as {"size", "entries"}: the lower triangle in some order, and the upper one where it differs.
  Json Entries(const ExactProblem::Matrix& A) {
    std::vector<Json> entries;
    for (int i = 0; i < A.rows(); ++i) {
      for (int j = 0; j <= i; ++j) {
        const bool symmetric = A(i, j) == A(j, i);
        if (!symmetric || A(i, j) != 0) entries.push_back({i, j, ToString(A(i, j))});
        if (!symmetric) entries.push_back({j, i, ToString(A(j, i))});
      }
    }
    for (std::size_t i = entries.size(); i > 1; --i) std::swap(entries[i - 1], entries[random_() % i]);
    return Json{{"size", A.rows()}, {"entries", entries}};
  }

 private:
  int Below(int n) { return static_cast<int>(random_() % n); }
  std::string Pick(const std::vector<std::string>& values) {
    return values[Below(static_cast<int>(values.size()))];
  }

  mpz_class Integer(int words) {
    mpz_class x = 0;
    for (int i = 0; i < words; ++i) x = (x << 32) + static_cast<unsigned long>(random_() >> 32);
    return Below(2) ? x : mpz_class(-x);
  }

  Rational Number() {
    if (Below(3) == 0) return 0;
    if (Below(2)) return Below(19) - 9;
    Rational x(Integer(1 + Below(6)), abs(Integer(1 + Below(6))) + 1);
    x.canonicalize();
    return x;
  }

  Contact<Rational> OneContact(int dimension) {
    Contact<Rational> contact;
    contact.kind = static_cast<ContactKind>(Below(4));
    if (contact.HasFrictionRows()) contact.mu = abs(Number());
    if (contact.kind != ContactKind::kSliding) return contact;
    if (dimension == 2) {
      contact.slip[0] = Below(2) ? 1 : -1;
    } else {  // a rational point of the circle
      const Rational t = Number();
      contact.slip = {Rational((1 - t * t) / (1 + t * t)), Rational(2 * t / (1 + t * t))};
    }
    return contact;
  }

  std::mt19937_64 random_;
};

TEST_CASE("problem file: writing and reading gives the same values") {
  RandomProblem random(20240607);
  int kinds_seen = 0, spatial = 0;
  for (int i = 0; i < 400; ++i) {
    const ProblemFile file = random.File();
    const std::string text = Print(file);
    INFO(text);
    REQUIRE(SameFile(ParseProblem(text, "printed"), file));
    REQUIRE(SameFile(ParseProblem(ToJson(file)->dump(), "dumped"), file));
    REQUIRE(ParseJson(text, "printed") == *ToJson(file));
    REQUIRE(Print(ParseProblem(text, "printed")) == text);
    REQUIRE(SameProblem(ProblemFromJson(ProblemToJson(file.problem), "json", "", true), file.problem));
    for (const auto& contact : file.problem.contacts()) kinds_seen |= 1 << static_cast<int>(contact.kind);
    spatial += file.problem.dimension() == 3;
  }
  CHECK(kinds_seen == 15);
  CHECK(spatial > 100);
  CHECK(spatial < 300);
}

TEST_CASE("problem file: A as entries is read to the same values as A in rows") {
  RandomProblem random(77);
  for (int i = 0; i < 400; ++i) {
    const ProblemFile file = random.File();
    Json json = ToJson(file);
    json["A"] = random.Entries(file.problem.dense().A);
    INFO(json.dump());
    REQUIRE(SameFile(ParseProblem(json.dump(), "sparse"), file));
  }
}

TEST_CASE("problem file: a large A of mostly zeros is written in entries, unless it is not symmetric") {
  ProblemFile file;
  file.name = "band";
  ExactProblem problem;
  constexpr int kArrayOfRows = 70;
  problem.contacts.resize(kArrayOfRows);
  for (auto& contact : problem.contacts) contact.kind = ContactKind::kFrictionless;
  problem.A = ExactProblem::Matrix::Constant(kArrayOfRows, kArrayOfRows, Rational(0));
  problem.b = ExactProblem::Vector::Constant(kArrayOfRows, Rational(-1));
  for (int i = 0; i < kArrayOfRows; ++i) {
    problem.A(i, i) = 2;
    if (i > 0) problem.A(i, i - 1) = problem.A(i - 1, i) = Rational(-1, 3);
  }
  file.problem = problem;
  const std::string text = Print(file);
  const Json json = ToJson(file);
  CHECK(json["A"]["size"] == kArrayOfRows);
  CHECK(json["A"]["entries"].size() == 2 * kArrayOfRows - 1);
  CHECK(json["A"]["entries"][1] == Json::array({1, 0, "-1/3"}));
  CHECK(ParseJson(text, "printed") == json);
  CHECK(SameFile(ParseProblem(text, "printed"), file));
  CHECK(SameProblem(ProblemFromJson(ProblemToJson(file.problem), "json", "", true), file.problem));
  problem.A(3, 40) = 1;
  file.problem = problem;
  CHECK(ToJson(file)->at("A").is_array());
  CHECK(SameFile(ParseProblem(Print(file), "printed"), file));
}

TEST_CASE("problem file: the writer never emits a number of the problem as anything but a string") {
  RandomProblem random(5);
  for (int i = 0; i < 100; ++i) {
    const Json json = ToJson(random.File());
    for (const Json& row : json.at("A")) {
      for (const Json& x : row) REQUIRE(x.is_string());
    }
    for (const Json& x : json.at("b")) REQUIRE(x.is_string());
    for (const Json& contact : json.at("contacts")) {
      if (contact.contains("mu")) REQUIRE(contact.at("mu").is_string());
    }
  }
}

}  // namespace
}  // namespace stiction
