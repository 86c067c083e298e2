// SPDX-License-Identifier: Apache-2.0
// Certificates: what is made is accepted, and what is altered is refused unless it is true all the same.
//
// Every value of a certificate of every claim is altered in several ways. Alterations of the form (keys, types,
// lengths) must be refused. An alteration of a value may be accepted only if this file finds the altered claim
// true by its defining equation, from the numbers in the JSON alone.

#include "certify/claims/certificate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <set>

#include "certify/claims/claims.h"
#include "corpus/json.h"
#include "corpus/record/digest.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/check.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Catch::Contains;

// ---- Certificates ----------------------------------------------------------------------------

Json CounterexampleOf(const ExactProblem& problem, const std::vector<Policy>& policies) {
  return CertifyClaim(problem, "p", "counterexample", {}, policies)->at("certificate");
}

// One of every claim, of problems with zeros, singular matrices and frictionless contacts.
std::vector<Json> OneOfEveryClaim() {
  const ExactProblem singular =
      MakeProblem({1, -1}, {{1, 1, 0}, {1, 1, 0}, {0, 0, 2}}, {-1, -1, Rational(-3, 2)});
  ExactProblem asymmetric = singular;
  asymmetric.A(0, 2) = 1;
  ExactProblem indefinite = ReferenceProblem();
  indefinite.A(1, 1) = 0;
  std::vector<Policy> policies;
  for (const char* name : {"paper", "ties=contacts", "resume=round", "file=yes", "scan=highest"})
    policies.push_back(ParsePolicy(name));
  return {SolutionCertificate(ThreeSolutions(), Vector({1, -1})),
          SymmetryCertificate(singular),
          SymmetryCertificate(asymmetric),
          SemidefiniteCertificate(singular),
          SemidefiniteCertificate(indefinite),
          RangeCertificate(singular),
          RangeCertificate(NoSolution()),
          DefiniteCertificate(ReferenceProblem()),
          DefiniteCertificate(singular),
          CycleCertificate(ReferenceProblem(), policies, {}),
          CounterexampleOf(ReferenceProblem(), policies)};
}

std::string ClaimOf(const Json& certificate) { return certificate["claim"].get<std::string>(); }

TEST_CASE("certificate: every maker's certificate is accepted") {
  const std::vector<std::string> claims = {"solution-exists", "symmetric", "not-symmetric", "psd",
                                           "not-psd",         "in-range",  "not-in-range",  "definite",
                                           "not-definite",    "cycle",     "counterexample"};
  const auto certificates = OneOfEveryClaim();
  REQUIRE(certificates.size() == claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const CheckReport report = CheckCertificate(ParseJson(JsonText(certificates[i]), "c.json"), "c.json");
    CAPTURE(claims[i], report.reason);
    CHECK(report.accepted);
    CHECK(report.claim == claims[i]);
  }
}

TEST_CASE("certificate: of the whole grid, each cycling policy is certified once and none else") {
  const Json certificate = CycleCertificate(ReferenceProblem(), PlanarGrid(), {});
  CHECK(CertifiedPolicies(certificate).size() == 1320);
  const CheckReport report = CheckCertificate(certificate, "c");
  CAPTURE(report.reason);
  CHECK(report.accepted);
  CHECK(report.facts->at("policies") == 1320);
}

TEST_CASE("certificate: no contacts at all can be certified") {
  CHECK(CheckCertificate(SolutionCertificate(NoContacts(), Vector({})), "c").accepted);
  CHECK(CheckCertificate(SemidefiniteCertificate(NoContacts()), "c").accepted);
  CHECK(CheckCertificate(RangeCertificate(NoContacts()), "c").accepted);
}

// With budgets so small that no forces are found.
TEST_CASE("certificate: where no forces are found, the theorem says that there are some") {
  const Request few = {.limits = {.pivots = 1, .programs = 1}};
  const ExactProblem problem = ReferenceProblem(), none = NoSolution();  // of which (H) fails
  CHECK(ClaimOf(CertifyClaim(problem, "p", "existence", {})->at("certificate")) == "solution-exists");
  const Json exists = CertifyClaim(problem, "p", "existence", few)->at("certificate");
  REQUIRE(ClaimOf(exists) == "exists");
  CHECK(CheckCertificate(exists, "c.json").accepted);
  // In place of a certificate which budgets are spent.
  for (const auto& [asked, claim] : {std::pair(&problem, "solution-exists"), std::pair(&none, "existence")}) {
    const Json open = CertifyClaim(*asked, "p", claim, few);
    CHECK(open["state"] == "not decided");
    CHECK(open["certificate"].is_null());
    CHECK_THAT(open["reason"].get<std::string>(), Catch::Contains("out of linear programs"));
  }
}

TEST_CASE("certificate: what is not so is not certified") {
  CHECK(CycleCertificate(ThreeSolutions(), PlanarGrid(), {})->is_null());
  CHECK_THROWS_AS(SolutionCertificate(ThreeSolutions(), Vector({1, 0})), InternalError);
  ExactProblem skew = ThreeSolutions();
  skew.A = Matrix({{1, 5}, {-5, 1}});
  CHECK_THROWS_AS(SemidefiniteCertificate(skew), InputError);
}

TEST_CASE("certificate: definite or not, and the direction that shows it") {
  const auto claim = [](const ExactProblem& problem) {
    const Json certificate = DefiniteCertificate(problem);
    CHECK(CheckCertificate(certificate, "c").accepted);
    return ClaimOf(certificate);
  };
  CHECK(claim(ReferenceProblem()) == "definite");
  CHECK(claim(NoContacts()) == "definite");
  const ExactProblem singular = MakeProblem({1}, {{1, 1}, {1, 1}}, {0, 0});
  CHECK(claim(singular) == "not-definite");
  CHECK(DefiniteCertificate(singular)["witness"]["value"] == "0");
  CHECK(claim(MakeProblem({1}, {{1, 2}, {2, 1}}, {0, 0})) == "not-definite");
  CHECK_THROWS_AS(DefiniteCertificate(MakeProblem({1}, {{1, 5}, {-5, 1}}, {0, 0})), InputError);
  for (int index = 0; index < 100; ++index) {
    const ExactProblem problem = Random<Rational>(GeneratorId::kDuplicates, 1 + index % 3, index);
    const Json D = SemidefiniteCertificate(problem)["witness"]["D"];
    CHECK((claim(problem) == "definite") == (std::ranges::find(D, Json("0")) == D.end()));
  }
}

TEST_CASE("certificate: a counterexample is a cycle, a definite A and a solution, of one problem") {
  const Json certificate = CounterexampleOf(ReferenceProblem(), PlanarGrid());
  const CheckReport report = CheckCertificate(certificate, "c", ProblemDigest(ReferenceProblem()));
  CAPTURE(report.reason);
  REQUIRE(report.accepted);
  CHECK(report.facts->at("policies") == 1320);
  CHECK(certificate["witness"]["f"] == Json({"1", "-6/7", "25/14", "-25/14"}));
  CHECK(CounterexampleOf(ThreeSolutions(), PlanarGrid()).is_null());  // no cycle
  ExactProblem bordered = ReferenceProblem();  // a contact more that nothing moves: A is semidefinite only
  bordered.contacts.push_back({ContactKind::kFrictionless});
  bordered.A = ExactMatrix::Constant(5, 5, 0);
  bordered.A.topLeftCorner(4, 4) = ReferenceProblem().A;
  bordered.b = ExactVector::Constant(5, 0);
  bordered.b.head(4) = ReferenceProblem().b;
  CHECK_FALSE(CycleCertificate(bordered, {Policy{}}, {})->is_null());
  CHECK(ClaimOf(CounterexampleOf(bordered, {Policy{}})) == "not-definite");
}

TEST_CASE("certificate: one of another problem is refused by its digest") {
  const Json certificate = SymmetryCertificate(ReferenceProblem());
  CHECK(CheckCertificate(certificate, "c", ProblemDigest(ReferenceProblem())).accepted);
  const CheckReport report = CheckCertificate(certificate, "c", ProblemDigest(ThreeSolutions()));
  CHECK_FALSE(report.accepted);
  CHECK_THAT(report.reason, Contains(ProblemDigest(ThreeSolutions())) && Contains(report.digest));
}

TEST_CASE("digest: of what a problem says, not of how it is spelled") {
  const ExactProblem problem = ThreeSolutions();
  const std::string text = Print({"a name", problem, {}, {}, {}});
  CHECK(ProblemDigest(ParseProblem(text, "p").problem) == ProblemDigest(problem));
  std::vector<ExactProblem> others(6, problem);
  others[0].A(0, 1) += Rational(1, 7);
  others[1].b[0] = 5;
  others[2].contacts[0].mu += 1;
  others[3].contacts[0].kind = ContactKind::kSliding;
  others[3].contacts[0].slip = {1, 0};
  others[4] = others[3];
  others[4].contacts[0].slip = {-1, 0};
  others[5] = NoContacts();
  std::set<std::string> digests = {ProblemDigest(problem)};
  for (const ExactProblem& other : others) CHECK(digests.insert(ProblemDigest(other)).second);
  // sha256sum of the five lines of digest.h.
  CHECK(ProblemDigest(MakeProblem({Rational(3, 4)}, {{3, -4}, {-4, Rational(7, 2)}}, {-1, 0})) ==
        "sha256:4fb571f4aa488768b8b00d2a66c43e9602392a3e0a4c2616d3287cba6fc2cf22");
}

// ---- The truth of a claim, by its equation ----------------------------------------------------

using Numbers = std::vector<Rational>;

Numbers ReadNumbers(const Json& list) {
  Numbers numbers;
  for (const Json& item : list) numbers.push_back(Number(item.get<std::string>()));
  return numbers;
}

std::vector<Numbers> ReadRows(const Json& list) {
  std::vector<Numbers> rows;
  for (const Json& row : list) rows.push_back(ReadNumbers(row));
  return rows;
}

Rational Dot(const Numbers& x, const Numbers& y) {
  Rational sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x.at(i) * y.at(i);
  return sum;
}

Numbers Column(const std::vector<Numbers>& rows, std::size_t j) {
  Numbers column;
  for (const Numbers& row : rows) column.push_back(row.at(j));
  return column;
}

bool SolutionIsTrue(const Json& contacts, const std::vector<Numbers>& A, const Numbers& b,
                    const Json& witness) {
  const Numbers f = ReadNumbers(witness["f"]), a = ReadNumbers(witness["a"]);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (a.at(i) != Dot(A[i], f) + b[i]) return false;
  }
  std::size_t row = 0;
  for (const Json& contact : contacts) {
    const Rational f_n = f.at(row), a_n = a.at(row);
    if (f_n < 0 || a_n < 0 || f_n * a_n != 0) return false;
    ++row;
    if (contact["kind"] == "frictionless") continue;
    const Rational f_f = f.at(row), a_f = a.at(row), bound = Number(contact["mu"].get<std::string>()) * f_n;
    if (f_f > bound || f_f < -bound || a_f * f_f > 0) return false;
    if (a_f != 0 && f_f != bound && f_f != -bound) return false;
    ++row;
  }
  return true;
}

bool FactorsAreTrue(const std::vector<Numbers>& A, const Json& witness) {
  const auto L = ReadRows(witness["L"]);
  const Numbers D = ReadNumbers(witness["D"]);
  for (std::size_t i = 0; i < A.size(); ++i) {
    if (D.at(i) < 0) return false;
    for (std::size_t j = 0; j < A.size(); ++j) {
      if (j >= i && L[i].at(j) != (i == j ? 1 : 0)) return false;
      Numbers scaled = L[i];
      for (std::size_t k = 0; k < D.size(); ++k) scaled[k] *= D[k];
      if (Dot(scaled, L[j]) != A[i].at(j)) return false;
    }
  }
  return true;
}

// Strings that are numbers, written in one way.
Json Normalized(const Json& json) {
  if (json.is_string()) {
    const auto number = ParseRational(json.get<std::string>());
    return number ? Json(ToString(*number)) : json;
  }
  Json copy = json;
  for (Json& item : copy) {
    if (json.is_structured()) item = Normalized(item);
  }
  return copy;
}

// Each run is one of the original, of the same problem, for some of its policies.
bool IsPartOf(const Json& altered, const Json& original) {
  if (Normalized(altered["problem"]) != Normalized(original["problem"])) return false;
  for (Json run : altered["witness"]["runs"]) {
    bool known = false;
    for (Json other : original["witness"]["runs"]) {
      const Json named = std::exchange(run["policies"], Json()),
                 allowed = std::exchange(other["policies"], Json());
      bool subset = !named.empty();
      for (const Json& policy : named)
        subset &= std::find(allowed.begin(), allowed.end(), policy) != allowed.end();
      known |= subset && Normalized(run) == Normalized(other);
      run["policies"] = named;
    }
    if (!known) return false;
  }
  return !altered["witness"]["runs"].empty();
}

bool ArePositive(const Json& list) {
  return std::ranges::all_of(ReadNumbers(list), [](const Rational& x) { return x > 0; });
}

bool IsTrue(const Json& certificate, const Json& original) {
  // A witness of `definite` is one of `psd`, too.
  const bool weaker = ClaimOf(original) == "definite" && certificate["claim"] == "psd";
  const std::string claim = weaker ? "psd" : ClaimOf(original);
  if (certificate["claim"] != claim) return false;
  if (claim == "cycle") return IsPartOf(certificate, original);
  const Json &problem = certificate["problem"], &witness = certificate["witness"];
  const auto A = ReadRows(problem["A"]);
  const Numbers b = ReadNumbers(problem["b"]);
  if (claim == "solution-exists") return SolutionIsTrue(problem["contacts"], A, b, witness);
  if (claim == "psd") return FactorsAreTrue(A, witness);
  if (claim == "definite") return FactorsAreTrue(A, witness) && ArePositive(witness["D"]);
  if (claim == "counterexample") {
    return IsPartOf(certificate, original) && FactorsAreTrue(A, witness) && ArePositive(witness["D"]) &&
           SolutionIsTrue(problem["contacts"], A, b, witness);
  }
  if (claim == "symmetric") {
    for (std::size_t i = 0; i < A.size(); ++i) {
      if (A[i] != Column(A, i)) return false;
    }
    return true;
  }
  if (claim == "not-symmetric") {
    const auto i = witness["i"].get<std::size_t>(), j = witness["j"].get<std::size_t>();
    return A.at(i).at(j) != A.at(j).at(i);
  }
  if (claim == "in-range") {
    const Numbers x = ReadNumbers(witness["x"]);
    for (std::size_t i = 0; i < A.size(); ++i) {
      if (Dot(A[i], x) != b[i]) return false;
    }
    return true;
  }
  const Numbers x = ReadNumbers(witness[claim == "not-in-range" ? "y" : "x"]);
  const Rational value = Number(witness["value"].get<std::string>());
  if (claim == "not-psd" || claim == "not-definite") {
    Rational curvature = 0;
    for (std::size_t i = 0; i < A.size(); ++i) curvature += x.at(i) * Dot(A[i], x);
    return value == curvature && (claim == "not-psd" ? value < 0 : value <= 0 && Dot(x, x) > 0);
  }
  for (std::size_t j = 0; j < A.size(); ++j) {
    if (Dot(x, Column(A, j)) != 0) return false;
  }
  return value != 0 && value == Dot(x, b);
}

// ---- Altering --------------------------------------------------------------------------------

using Pointer = nlohmann::json_pointer<std::string>;

struct Altered {
  std::string how;
  Json certificate;
  bool form;  // whether keys, types or lengths changed: to be refused whatever the values
};

class Alterations {
 public:
  explicit Alterations(const Json& original) : original_(original) { Visit(Pointer()); }

  std::vector<Altered> Take() { return std::move(altered_); }

 private:
  void Add(const std::string& how, Json certificate, bool form) {
    if (certificate != original_) altered_.push_back({how, std::move(certificate), form});
  }

  void Replace(const Pointer& at, const Json& value, bool form) {
    Json copy = original_;
    copy[at] = value;
    Add(at.to_string() + " = " + value.dump(), std::move(copy), form);
  }

  // Pivots are all alike: those after the first two are altered in fewer ways.
  static bool IsLaterPivot(const Pointer& at) {
    const std::string text = at.to_string(), key = "/pivots/";
    const std::size_t found = text.find(key);
    return found != text.npos && std::stoi(text.substr(found + key.size())) > 1;
  }

  void Visit(const Pointer& at) {
    const Json& value = original_[at];
    few_ = IsLaterPivot(at);
    for (const Json& other :
         {Json(nullptr), Json::array(), Json("1"), Json(true), Json(1), Json(1.5), Json("x"), Json::object()}) {
      if (few_ && (other.is_boolean() || other.is_number() || other == "x" || other.is_object())) continue;
      if (other.type() != value.type() || value.is_structured()) Replace(at, other, true);
    }
    if (value.is_object()) return VisitObject(at);
    if (value.is_array()) return VisitArray(at);
    if (value.is_string()) return VisitText(at, value.get<std::string>());
    const auto number = value.get<std::int64_t>();
    for (const std::int64_t other : {number + 1, number - 1, -number, std::int64_t{0}})
      Replace(at, other, false);
    Replace(at, static_cast<double>(number), true);
    Replace(at, ~std::uint64_t{0}, true);
  }

  void VisitObject(const Pointer& at) {
    const Json& object = original_[at];
    Json more = original_;
    more[at]["extra"] = 1;
    Add(at.to_string() + ": an unknown key", std::move(more), true);
    for (const auto& [key, value] : object.items()) {
      Json less = original_;
      less[at].erase(key);
      Add(at.to_string() + ": without " + key, std::move(less), true);
      Visit(at / key);
    }
  }

  // Fewer policies or runs can still be true; every other list has its length.
  void VisitArray(const Pointer& at) {
    const Json& list = original_[at];
    const bool open = !at.empty() && (at.back() == "policies" || at.back() == "runs");
    for (std::size_t k = 0; k < list.size(); ++k) {
      Json less = original_, more = original_;
      less[at].erase(k);
      more[at].push_back(list[k]);
      Add(at.to_string() + ": without item", std::move(less), !open);
      Add(at.to_string() + ": an item twice", std::move(more), true);
      Visit(at / k);
    }
  }

  void VisitText(const Pointer& at, const std::string& text) {
    if (const auto x = ParseRational(text)) {
      for (const Rational& other : {Rational(*x + 1), Rational(-*x), Rational(0), Rational(*x / 2)})
        Replace(at, ToString(other), false);
      for (const char* bad : {" 1", "1 ", "+1", "1/0", "0x1", ".5", "1.", "1e10001", ""}) {
        if (!few_ || *bad == '+') Replace(at, bad, true);
      }
      return;
    }
    Replace(at, text + "x", true);
    Replace(at, "", true);
    if (few_) return Replace(at, "none", false);
    for (const char* word :
         {"C", "NC", "CF", "NC-", "NC+", "none", "suspended", "N1", "F2", "establish", "zero", "cycle", "stall",
          "psd", "symmetric", "solution-exists", "static", "frictionless", "sliding"}) {
      Replace(at, word, false);
    }
    // Policies: one that solves the reference problem, one that is not canonical, one that is not planar.
    for (const char* policy : {"file=yes,drop=variable", "ties=sets", "ties=contacts,resume=round",
                               "slip=redirect", "paper,paper", "file=yes", "resume=round"}) {
      Replace(at, policy, false);
    }
  }

  const Json& original_;
  std::vector<Altered> altered_;
  bool few_ = false;
};

TEST_CASE("certificate: an altered certificate is refused unless it is still true", "[slow]") {
  for (const Json& original : OneOfEveryClaim()) {
    int refused = 0, k = 0;
    for (const Altered& altered : Alterations(original).Take()) {
      if (testing::Short() && k++ % 4 != 0) continue;
      const CheckReport report = CheckCertificate(altered.certificate, "c.json");
      refused += !report.accepted;
      if (report.accepted && (altered.form || !IsTrue(altered.certificate, original))) {
        FAIL_CHECK(ClaimOf(original) << ": accepted with " << altered.how);
      }
      if (!report.accepted && report.reason.empty()) FAIL_CHECK("refused without a reason: " << altered.how);
    }
    CAPTURE(ClaimOf(original));
    CHECK(refused > (testing::Short() ? 20 : 100));
  }
}

TEST_CASE("certificate: numbers may be written in any way, and mean the same") {
  for (const Json& original : OneOfEveryClaim()) {
    Json respelled = original;
    const std::function<void(Json&)> respell = [&respell](Json& json) {
      if (json.is_structured()) {
        for (Json& item : json) respell(item);
      } else if (json.is_string()) {
        if (const auto x = ParseRational(json.get<std::string>())) {
          json = x->get_num().get_str() + "0/" + x->get_den().get_str() + "0";
        }
      }
    };
    respell(respelled);
    const CheckReport report = CheckCertificate(respelled, "c.json");
    CAPTURE(ClaimOf(original), report.reason);
    CHECK(report.accepted);
  }
}

TEST_CASE("certificate: one run in two is refused, however its numbers are written") {
  Json certificate = CycleCertificate(ReferenceProblem(), {Policy{}, ParsePolicy("ties=contacts")}, {});
  Json& runs = certificate["witness"]["runs"];
  REQUIRE(runs.size() == 1);
  REQUIRE(runs[0]["policies"].size() == 2);
  runs.push_back(runs[0]);
  runs[0]["policies"].erase(1);
  runs[1]["policies"].erase(0);
  CHECK_FALSE(CheckCertificate(certificate, "c").accepted);
  Json& step = runs[1]["pivots"][0]["step"];
  step = Number(step.get<std::string>()).get_num().get_str() + "0/" +
         Number(step.get<std::string>()).get_den().get_str() + "0";
  CHECK_FALSE(CheckCertificate(certificate, "c").accepted);
}

TEST_CASE("certificate: a policy that is not of the planar grid is refused") {
  Json certificate = CycleCertificate(ReferenceProblem(), {Policy{}}, {});
  certificate["witness"]["runs"][0]["policies"][0] = "slip=redirect";
  CHECK_FALSE(CheckCertificate(certificate, "c").accepted);
}

TEST_CASE("certificate: the reason of a refusal is text that can be written as JSON") {
  for (const char* padding : {"", "a"}) {
    Json certificate = SymmetryCertificate(ThreeSolutions());
    std::string claim = padding;
    for (int i = 0; i < 60; ++i) claim += "\u00e9";
    certificate["claim"] = claim;
    const CheckReport report = CheckCertificate(certificate, "c");
    CHECK_FALSE(report.accepted);
    CHECK_NOTHROW(JsonText(Json(report.reason)));
  }
}

}  // namespace
}  // namespace stiction
