// SPDX-License-Identifier: Apache-2.0
// Every method in every arithmetic: what is called solved is a solution, whatever the scales of the problem.

#include <catch2/catch.hpp>

#include "certify/exact/answer_json.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/request.h"
#include "corpus/rounded.h"
#include "search/generators/choices.h"
#include "tests/judge.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

Rational PowerOfTen(int exponent) { return *ParseRational("1e" + std::to_string(exponent)); }

// One dial away from an ordinary problem.
struct Dial {
  int A = 0, b = 0, mu = 0;  // powers of ten
};

ExactProblem Turned(ExactProblem problem, const Dial& dial) {
  problem.A *= PowerOfTen(dial.A);
  problem.b *= PowerOfTen(dial.b);
  for (auto& contact : problem.contacts) contact.mu *= PowerOfTen(dial.mu);
  return problem;
}

ExactProblem InSpace(const ExactProblem& planar, std::uint64_t seed) {
  Choices choices(seed);
  const int contacts = static_cast<int>(planar.contacts.size()), rows = 3 * contacts;
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = planar.contacts;
  ExactMatrix J(rows, rows);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    problem.b[i] = choices.Integer(-9, 9);
    for (int j = 0; j < rows; ++j) J(i, j) = choices.Integer(-3, 3);
  }
  problem.A = J * J.transpose();
  for (int i = 0; i < rows; ++i) problem.A(i, i) += 1;
  return problem;
}

// Its normal rows.
ExactProblem Frictionless(const ExactProblem& planar) {
  ExactProblem problem;
  problem.contacts.assign(planar.contacts.size(), {ContactKind::kFrictionless, 0, {}});
  const auto normals = Eigen::seq(0, Eigen::last, 2);
  problem.A = planar.A(normals, normals);
  problem.b = planar.b(normals);
  return problem;
}

}  // namespace

TEST_CASE("solve: a number that an arithmetic does not hold is refused by its place") {
  ExactProblem problem = MakeProblem({1}, {{2, 0}, {0, 3}}, {-1, 1});
  const auto message = [&problem](Arithmetic arithmetic) -> std::string {
    try {
      SolveIn(problem, {.method = "complete", .arithmetic = arithmetic});
      return "";
    } catch (const RangeError& error) {
      return error.what();
    }
  };
  problem.A(1, 1) = PowerOfTen(309);
  CHECK(message(Arithmetic::kDouble).find("A[1][1]") == 0);
  CHECK(message(Arithmetic::kExact).empty());
  problem.A(1, 1) = PowerOfTen(39);
  CHECK(message(Arithmetic::kFloat).find("A[1][1]") == 0);
  CHECK(message(Arithmetic::kDouble).empty());
  problem.A(1, 1) = 3;
  problem.b[0] = -PowerOfTen(-100);
  CHECK(message(Arithmetic::kFloat).find("b[0]") == 0);  // would be zero, and f = 0 a solution
  problem.b[0] = PowerOfTen(-320);                       // not a double
  CHECK(message(Arithmetic::kDouble).find("b[0]") == 0);
  problem.b[0] = -1;
  problem.contacts[0].mu = PowerOfTen(400);
  CHECK(message(Arithmetic::kDouble).find("contacts[0].mu") == 0);
  CHECK(message(Arithmetic::kDouble).find("expected a number in the range of double") != std::string::npos);
  problem.contacts[0].mu = PowerOfTen(-400);
  CHECK(message(Arithmetic::kDouble).find("that double holds with all its digits") != std::string::npos);
}

TEST_CASE("solve: forces at the end of the range of doubles do not stop the fast method over rationals") {
  for (const int exponent : {-300, -303, -306}) {
    const ExactProblem problem = MakeProblem({-1, -1}, {{1, 0}, {0, PowerOfTen(exponent)}}, {-1, -1});
    const Request request{.method = "fast"};
    const Solution solution = SolveIn(problem, request);
    CHECK(solution.outcome() == Outcome::kSolved);
    CHECK(FaultOf(problem, request, solution) == "");
  }
}

TEST_CASE("solve: an exact answer after a suspicion has exact forces, and says what was suspected") {
  const ExactProblem problem = ReferenceProblem();
  const Solution solution = SolveIn(problem, {.method = "baraff", .arithmetic = Arithmetic::kDouble});
  REQUIRE(solution.suspected);
  CHECK(solution.suspected->outcome == Outcome::kCycle);
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  REQUIRE(exact != nullptr);
  CHECK(exact->outcome == Outcome::kCycle);
  CHECK(exact->arithmetic == Arithmetic::kExact);
  CHECK(exact->period == 4);
}

TEST_CASE("solve: the method that an answer names outlives the request") {
  const ExactProblem planar = ReferenceProblem();
  int named = 0;
  for (const ExactProblem& problem : {planar, InSpace(planar, 1), Frictionless(planar)}) {
    for (const MethodFacts& facts : AllMethods()) {
      if (facts.name == "ipopt") continue;  // a process each: tests/cli
      if (facts.name == "qp" && problem.contacts[0].kind != ContactKind::kFrictionless) continue;
      for (int a = 0; a < kArithmeticCount; ++a) {
        if (!facts.IsBuilt(problem.dimension, static_cast<Arithmetic>(a))) continue;
        std::string name(facts.name);
        const Solution solution = SolveIn(problem, {.method = name,
                                                    .arithmetic = static_cast<Arithmetic>(a),
                                                    .limits = {.drives = 200, .pivots = 400, .bits = 20000}});
        name.assign(name.size(), '?');
        INFO(facts.name << " " << kArithmeticNames[a] << " in dimension " << problem.dimension);
        std::visit([](const auto& answer) { CHECK(FindMethodFacts(answer.method) != nullptr); },
                   solution.answer);
        ++named;
      }
    }
  }
  CHECK(named > 40);
}

// Copies of a problem that know nothing of each other.
ExactProblem Copies(const ExactProblem& problem, int count) {
  const int rows = problem.rows();
  ExactProblem sum;
  sum.A = ExactMatrix::Zero(count * rows, count * rows);
  sum.b.resize(count * rows);
  for (int k = 0; k < count; ++k) {
    sum.contacts.insert(sum.contacts.end(), problem.contacts.begin(), problem.contacts.end());
    sum.A.block(k * rows, k * rows, rows, rows) = problem.A;
    sum.b.segment(k * rows, rows) = problem.b;
  }
  return sum;
}

TEST_CASE("solve: of many rows auto tries the cells of doubles first, over rationals and certified") {
  const ExactProblem few = ReferenceProblem();
  const ExactProblem many = Copies(few, (kCellsFirst + few.rows() - 1) / few.rows());
  CHECK(Solve(few).method == "complete");
  const auto exact = std::get<ExactAnswer>(SolveIn(many, {.arithmetic = Arithmetic::kExact}).answer);
  CHECK(exact.method == "fast");
  CHECK(AnsweredBy(exact.method, exact.counters) == "fast");
  CHECK_FALSE(FindViolation(many, exact.f));
  const auto enclosed = std::get<InexactAnswer>(SolveIn(many, {.arithmetic = Arithmetic::kFiltered}).answer);
  CHECK(enclosed.method == "fast");
  REQUIRE(enclosed.f_enclosed.size() == static_cast<std::size_t>(many.rows()));
  for (int i = 0; i < many.rows(); ++i) {  // around the only solution
    CHECK(Rational(enclosed.f_enclosed[i].low) <= exact.f[i]);
    CHECK(exact.f[i] <= Rational(enclosed.f_enclosed[i].high));
  }
}

TEST_CASE(
    "solve: behind the cells of doubles stand the published algorithm, and complete driving where it loops") {
  const Dial beyond_doubles = {400, 400, 0};
  const ExactProblem loops = ReferenceProblem(), ends = MakeProblem({1}, {{2, 1}, {1, 3}}, {-1, 1});
  REQUIRE(Solve(loops, {.method = "baraff"}).outcome == Outcome::kCycle);
  REQUIRE(Solve(ends, {.method = "baraff"}).Solved());
  for (const auto& [problem, by] : {std::pair{loops, "complete"}, std::pair{ends, "baraff"}}) {
    const ExactProblem turned = Turned(problem, beyond_doubles);
    const Answer<Rational> answer = Solve(turned, {.method = "fast"});
    REQUIRE(answer.Solved());
    CHECK(answer.method == "fast");
    CHECK(AnsweredBy(answer.method, answer.counters) == by);
    CHECK_FALSE(FindViolation(turned, answer.f));
  }
}

TEST_CASE("solve: no solution is an outcome of those alone who prove it") {
  const ExactProblem problem = NoSolution();
  const Answer<Rational> modes = Solve(problem, {.method = "enumerate"});
  CHECK(modes.outcome == Outcome::kNoSolution);
  CHECK(Name(modes.outcome) == "no-solution");
  CHECK(modes.f.size() == 0);
  CHECK(!modes.reason.empty());
  for (const char* method : {"complete", "lemke"})
    CHECK(Solve(problem, {.method = method}).outcome == Outcome::kRay);
  const Answer<Rational> any = Solve(problem);
  CHECK(any.outcome == Outcome::kNoSolution);
  CHECK(any.method == "enumerate");
  CHECK(any.ray == Solve(problem, {.method = "complete"}).ray);
  CHECK(any.ray.size() == problem.rows());
}

TEST_CASE("solve: forces that are none do not pass the gate as they are") {
  const ContactProblem<double> problem = Rounded<double>(MakeProblem({1}, {{2, 0}, {0, 3}}, {-1, 1}));
  Answer<double> answer;
  answer.outcome = Outcome::kSolved;
  answer.f.resize(2);
  answer.f << 0.5, -1.0 / 3;
  JudgeAnswer(problem, 1e-8, answer);
  CHECK(answer.Solved());
  for (const double wrong :
       {0.6, 0.5 + 1e-7, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    answer.outcome = Outcome::kSolved;
    answer.f[0] = wrong;
    JudgeAnswer(problem, 1e-8, answer);
    if (std::isfinite(wrong)) {  // refined
      CHECK(answer.Solved());
      CHECK(answer.f[0] == Approx(0.5).epsilon(1e-7));
      CHECK(answer.f[0] != wrong);
      continue;
    }
    CHECK(answer.outcome == Outcome::kUndecided);
    CHECK(!answer.reason.empty());
  }
}

TEST_CASE("solve: a bound that is asked for is met or nothing is called solved") {
  const ContactProblem<double> problem = Rounded<double>(MakeProblem({1}, {{2, 1}, {1, 3}}, {-1, 1}));
  CHECK(Solve(problem, {.method = "complete", .residual = 1e-12}).residual() <= 1e-12);
  CHECK(Solve(problem, {.method = "complete", .residual = 1e-30}).outcome == Outcome::kUndecided);
}

TEST_CASE("solve: a run that is stopped is undecided and keeps its forces") {
  const std::atomic<bool> stop = true;
  const ExactProblem exact = ReferenceProblem();
  for (const char* method : {"baraff", "complete", "lemke"}) {
    const Answer<Rational> answer = Solve(exact, {.method = method, .limits = {.stop = &stop}});
    CHECK(answer.outcome == Outcome::kUndecided);
    CHECK(answer.reason == kStopped);
  }
}

TEST_CASE("solve: combinations that are not built are refused with what is") {
  for (const MethodFacts& facts : AllMethods()) {
    for (const int dimension : {2, 3}) {
      for (int a = 0; a < kArithmeticCount; ++a) {
        const auto arithmetic = static_cast<Arithmetic>(a);
        const std::string refusal = Refusal(facts.name, dimension, arithmetic);
        CHECK(refusal.empty() == facts.IsBuilt(dimension, arithmetic));
        if (!refusal.empty()) CHECK(refusal.find(facts.name) != std::string::npos);
      }
    }
  }
  CHECK(Refusal(kAutomatic, 3, Arithmetic::kExact).empty());
  CHECK(Refusal(kAutomatic, 2, Arithmetic::kQuad).empty());
  CHECK(!Refusal(kAutomatic, 3, Arithmetic::kFiltered).empty());
}

}  // namespace stiction
