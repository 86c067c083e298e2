// SPDX-License-Identifier: Apache-2.0
// Lemke's method: the trace of its path. STICTION_SOURCES: the folder of the sources.

#include "solver/lemke/lemke.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "certify/exact/verify_solution.h"
#include "corpus/formats/read_problem.h"
#include "solver/published/published.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// f with a, and l with m.
std::string Complement(std::string name) {
  static const std::string kLetters = "falm";
  name[0] = kLetters[kLetters.find(name[0]) ^ 1];
  return name;
}

std::set<std::string> FirstBasis(const ExactProblem& problem) {
  std::set<std::string> basis;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const std::string contact = std::to_string(i + 1);
    basis.insert("aN" + contact);
    if (!problem.contacts[i].HasFrictionRows()) continue;
    for (const char* name : {"a+", "a-", "m"}) basis.insert(name + contact);
  }
  return basis;
}

// Every variable is basic or nonbasic, and of every pair one is not basic; with z0 basic, of one pair both.
void CheckBases(const ExactProblem& problem, const Trace<Rational>& trace) {
  std::set<std::string> basis = FirstBasis(problem);
  for (const Pivot<Rational>& pivot : trace.pivots) {
    if (pivot.leaving.empty()) continue;  // a ray
    CHECK(basis.erase(pivot.leaving) == 1);
    CHECK(basis.insert(pivot.entering).second);
    for (const std::string& name : basis) {
      if (name != "z0") CHECK(basis.count(Complement(name)) == 0);
    }
    CHECK((basis.count("z0") == 1) == (pivot.leaving != "z0"));
  }
}

// From f = 0 along df, every point with w = q + M z + z0 e >= 0 in the rows of the normals.
void CheckPoints(const ExactProblem& problem, const Trace<Rational>& trace) {
  ExactVector f = ExactVector::Zero(problem.rows());
  for (std::size_t k = 0; k < trace.pivots.size(); ++k) {
    const Pivot<Rational>& pivot = trace.pivots[k];
    CHECK(pivot.drive == static_cast<int>(k) + 1);
    CHECK(pivot.s >= 0);
    f += pivot.s * pivot.df;
    CHECK(pivot.f == f);
    CHECK(pivot.a == Accelerations(problem, f));
    CHECK(pivot.da == problem.A * pivot.df);
    const auto layout = LayoutOf(problem);
    for (int i = 0; i < layout.ContactCount(); ++i) {
      const int row = layout.NormalRowOf(i);
      CHECK(pivot.f[row] >= 0);
      CHECK(pivot.a[row] + pivot.cover >= 0);
    }
  }
}

void CheckTrace(const ExactProblem& problem) {
  LemkeAlgorithm<Rational> lemke;
  const RunEnd<> alone = lemke.Run(problem);
  Trace<Rational> trace;
  const RunEnd<> verdict = lemke.Run(problem, &trace);
  CHECK(verdict.outcome == alone.outcome);
  CHECK(verdict.statistics == alone.statistics);
  const bool ray = verdict.outcome == Outcome::kRay;
  REQUIRE(trace.pivots.size() == static_cast<std::size_t>(verdict.statistics[Counter::kPivots]) + ray);
  CheckBases(problem, trace);
  CheckPoints(problem, trace);
  if (trace.pivots.empty()) return;
  CHECK(trace.pivots.front().entering == "z0");
  CHECK(trace.pivots.front().driven == -1);
  for (std::size_t k = 1; k < trace.pivots.size(); ++k) {
    CHECK(trace.pivots[k].entering == Complement(trace.pivots[k - 1].leaving));
    CHECK(trace.pivots[k].driven == trace.pivots[k - 1].limiting);
    CHECK(trace.pivots[k - 1].cover >= 0);
  }
  const Pivot<Rational>& last = trace.pivots.back();
  CHECK((last.leaving == "z0") == (verdict.outcome == Outcome::kSolved));
  CHECK((last.limiting == -1) == (ray || last.leaving == "z0"));
  if (ray) CHECK(last.df == lemke.ray());
  if (verdict.outcome != Outcome::kSolved) return;
  CHECK(last.f == lemke.f());
  CHECK(last.a == lemke.a());
  CHECK(last.cover == 0);
}

TEST_CASE("lemke: the trace leads from the entry of z0 to f, complement by complement, on the corpus") {
  int checked = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(STICTION_SOURCES) + "/corpus")) {
    if (entry.path().extension() != ".json") continue;
    const ExactProblem problem = ReadProblem(entry.path()).problem;
    if (!PublishedHandles(problem)) continue;
    CAPTURE(entry.path());
    CheckTrace(problem);
    ++checked;
  }
  CHECK(checked > 20);
}

TEST_CASE("lemke: the trace of random problems, of a ray, and of nothing to do") {
  for (const GeneratorRow& generator : Generators()) {
    if (!generator.IsPlain()) continue;
    for (std::uint64_t index = 0; index < 5; ++index) CheckTrace(Random<Rational>(generator.id, 3, index));
  }
  CheckTrace(NoSolution());
  CheckTrace(NoContacts());
  CheckTrace(MakeProblem({1}, {{1, 0}, {0, 1}}, {1, 0}));
}

TEST_CASE("lemke: the variables of a trace have names and rows") {
  Trace<Rational> trace;
  LemkeAlgorithm<Rational> lemke;
  REQUIRE(lemke.Run(MakeProblem({1}, {{1, 0}, {0, 1}}, {-1, Rational(1, 2)}), &trace).outcome ==
          Outcome::kSolved);
  std::string names;
  for (const auto& pivot : trace.pivots) names += pivot.entering + ">" + pivot.leaving + " ";
  CHECK(names == "z0>aN1 fN1>a-1 f-1>z0 ");
  CHECK(trace.pivots[1].driven == 0);
  CHECK(trace.pivots[1].limiting == 1);
  CHECK(trace.pivots[0].cover == 1);
  CHECK(trace.pivots[1].cover == Rational(1, 2));
}

// The tableau of doubles is in other units than the problem.
TEST_CASE("lemke: over doubles the trace has the same names, and numbers in the problem's units") {
  LemkeAlgorithm<Rational> exact({}, Cover::kUnits);
  LemkeAlgorithm<double> rounded({}, Cover::kUnits);
  int alike = 0;
  for (std::uint64_t index = 0; index < 30; ++index) {
    const ExactProblem problem = Random<Rational>(GeneratorId::kConditioned, 3, index);
    Trace<Rational> wanted;
    Trace<double> trace;
    exact.Run(problem, &wanted);
    if (rounded.Run(As<double>(problem), &trace).outcome != Outcome::kSolved) continue;
    if (trace.pivots.size() != wanted.pivots.size()) continue;
    ++alike;
    for (std::size_t k = 0; k < trace.pivots.size(); ++k) {
      const Pivot<double>& pivot = trace.pivots[k];
      const Pivot<Rational>& other = wanted.pivots[k];
      CHECK(pivot.entering + " " + pivot.leaving == other.entering + " " + other.leaving);
      CHECK(pivot.s == Approx(ToDouble(other.s)).epsilon(1e-4).margin(1e-9));
      CHECK(pivot.cover == Approx(ToDouble(other.cover)).epsilon(1e-4).margin(1e-9));
    }
    if (!trace.pivots.empty()) CHECK(trace.pivots.back().f == rounded.f());
  }
  CHECK(alike >= 15);
}

}  // namespace
}  // namespace stiction
