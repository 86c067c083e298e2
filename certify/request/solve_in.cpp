// SPDX-License-Identifier: Apache-2.0
#include "certify/request/solve_in.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/exact/filtered.h"
#include "certify/exact/inexact.h"
#include "certify/exact/interval.h"
#include "certify/exact/newton_bodies.h"
#include "certify/exact/published_space.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/escalate.h"
#include "certify/request/quad.h"
#include "certify/request/rest.h"
#include "certify/request/rounded_problem.h"
#include "corpus/record/sparse_problem.h"
#include "corpus/rounded.h"
#include "solver/problem/check.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

constexpr int kExactRows = 60, kExactRowsInSpace = 24;  // from which on `auto` solves over doubles

bool IsFloating(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::kFloat || arithmetic == Arithmetic::kDouble ||
         arithmetic == Arithmetic::kQuad;
}

// ---- Exact numbers -------------------------------------------------------------------------------

// `auto` prefers, of several solutions, one whose contacts rest. The word is of the one that was found first.
template <class Scalar>
bool MayPreferRest(const Answer<Scalar>& answer, const Request& request) {
  return request.method == kAutomatic && !request.trace && answer.Solved() && !request.limits.Stopped();
}

// Squares of accelerations, of contacts as if A_ii were 1: no units of theirs change it.
Rational Motion(const ExactProblem& problem, const ExactVector& a) {
  Rational sum = 0;
  for (int i = 0; i < a.size(); ++i)
    if (problem.A(i, i) > 0) sum += a[i] * a[i] / problem.A(i, i);
  return sum;
}

// In space, of solutions whose contacts slip, the one of Newton's method in the space of bodies if it moves
// less: its steps are those of the least change.
void PreferLessMotion(const ExactProblem& problem, const Request& request, const ExactFactors* factors,
                      ExactAnswer& answer) {
  if (problem.dimension != 3 || answer.law != FrictionLaw::kCoulomb || answer.a.isZero(0)) return;
  Eigen::VectorXd f;
  try {
    f = factors != nullptr ? SolveByBodies(*factors, request).f
                           : SolveBy(NewtonBodiesRow(), Rounded<double>(problem), request).f;
  } catch (const InputError&) {  // doubles do not hold the problem
    return;
  }
  ExactAnswer other = SolveNear(problem, request, f);
  if (!other.Solved()) return;
  const Rational mine = Motion(problem, answer.a), least = Motion(problem, other.a);
  constexpr double kAlike = 1e-6;  // what bounded directions of slip leave
  if (abs(least - mine) <= Rational(kAlike) * mine) return;
  answer.moves_elsewhere = true;
  if (least > mine) return;
  answer.f = std::move(other.f);
  answer.a = std::move(other.a);
  answer.bound = other.bound;
  answer.word.clear();
}

void PreferRest(const ExactProblem& problem, const Request& request, const ExactFactors* factors,
                ExactAnswer& answer) {
  if (!MayPreferRest(answer, request)) return;
  auto rest = ForcesAtRest(problem, answer.f, Accelerations(problem, answer.f));
  if (!rest) return PreferLessMotion(problem, request, factors, answer);
  answer.f = std::move(rest->f);
  answer.a = Accelerations(problem, answer.f);
  answer.word.clear();
  answer.moves_elsewhere = true;
  if (answer.bound) answer.bound = CoulombBound(problem, answer.f).value_or(0);
}

ExactAnswer SolveRestingExactly(const ExactProblem& problem, const Request& request,
                                const ExactFactors* factors) {
  ExactAnswer answer = SolveExactly(problem, request);
  PreferRest(problem, request, factors, answer);
  return answer;
}

// ---- Rest, of rounded forces ---------------------------------------------------------------------

// Accelerations that are no rounding, of contacts in their own units or by enclosures; the others are zero.
ExactVector Moving(const ContactProblem<double>& problem, const InexactAnswer& answer) {
  constexpr double kMoves = 1e-6;
  LenientUnits<double> units;
  units.Take(problem, answer.f);
  ExactVector moving = ExactVector::Zero(answer.a.size());
  for (int i = 0; i < moving.size(); ++i) {
    const bool moves = answer.a_enclosed.empty()
                           ? std::abs(answer.a[i]) > kMoves * units.acceleration(i)
                           : answer.a_enclosed[i].low > 0 || answer.a_enclosed[i].high < 0;
    if (moves) moving[i] = answer.a[i];
  }
  return moving;
}

// Forces that rest are found exactly, and rounded. `rounded`: the problem that was solved; file(): that of
// which it is a rounding.
template <class File>
void PreferRestRounded(const ContactProblem<double>& rounded, File file, const Request& request,
                       InexactAnswer& answer) {
  if (!MayPreferRest(answer, request)) return;
  const ExactVector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  const auto rest = ForcesAtRest(file(), f, Moving(rounded, answer));
  if (!rest) return;
  InexactAnswer resting = answer;
  resting.f = rest->f.unaryExpr([](const Rational& x) { return ToDouble(x); });
  JudgeAnswer(rounded, ResidualOf<double>(request), resting);
  if (!resting.Solved()) return;
  if (!answer.f_enclosed.empty()) resting.a = answer.a;
  for (int i = 0; i < static_cast<int>(answer.f_enclosed.size()); ++i) {
    if (!rest->rests[i]) continue;
    const Interval around = Around(rest->f[i]);
    resting.f_enclosed[i] = {around.inf(), around.sup()};
    resting.a_enclosed[i] = {0, 0};
    resting.a[i] = 0;
  }
  resting.word.clear();
  resting.moves_elsewhere = true;
  answer = std::move(resting);
}

// ---- Floating point ------------------------------------------------------------------------------

// The published algorithm in space again: over quad, loop_grain 1e-12, tolerances of at most 1e-14.
InexactAnswer RunFinely(const ContactProblem<double>& problem, Request request) {
  Tolerances& t = request.tolerances;
  for (double* tolerance : {&t.acceleration, &t.force, &t.pivot}) *tolerance = std::min(*tolerance, 1e-14);
  t.loop_grain = std::min(t.loop_grain, 1e-12);
  request.trace = false;
  const auto wide = Converted<Quad>(problem, [](double x) { return Quad(x); });
  return InDoubles(Solve(wide, request), wide, ResidualOf<double>(request));
}

// The suspicion of a run of the published algorithm in space: the same problem, more finely.
void RunAgainInSpace(const ContactProblem<double>& ran, const Request& request, Solution& solution) {
  InexactAnswer& first = std::get<InexactAnswer>(solution.answer);
  InexactAnswer again = RunFinely(ran, request);
  again.arithmetic = first.arithmetic;
  again.pivots = std::move(first.pivots);
  solution.suspected = std::exchange(first, std::move(again));
}

// An answer that is only a suspicion: the same problem is run again where that decides more.
template <class Scalar>
void Confirm(const RoundedProblem<Scalar>& problem, const Request& request, Solution& solution) {
  const InexactAnswer first = std::get<InexactAnswer>(solution.answer);
  const MethodFacts* facts = FindMethodFacts(request.method);
  const bool is_path = facts != nullptr && facts->HasPath();
  if (first.Solved() || !is_path || !request.confirm || request.limits.Stopped()) return;
  const int dimension = problem.numbers().dimension;
  if (dimension == 3 && request.method == "baraff") {
    RunAgainInSpace(
        Converted<double>(problem.numbers(), [](const Scalar& x) { return static_cast<double>(x); }), request,
        solution);
    return;
  }
  if (dimension != 2 || !facts->IsBuilt(dimension, Arithmetic::kExact)) return;
  solution.suspected = first;
  if (problem.IsFile()) {
    solution.answer = SolveExactly(problem.File(), request);
  } else {
    solution.answer = problem.RunExactly(request, ResidualOf<Scalar>(request));
  }
}

// What decides exactly decides the problem of the file, in whatever numbers its forces are asked for: these are
// rounded, and judged on the problem that is rounded as they are.
template <class Scalar>
Solution SolveAndRound(const RoundedProblem<Scalar>& problem, const Request& request) {
  ExactAnswer exact = SolveExactly(problem.File(), request);
  if (exact.outcome == Outcome::kNoSolution) return {.answer = std::move(exact)};
  return {.answer = problem.Told(exact, request.arithmetic, ResidualOf<Scalar>(request))};
}

// The row that is built over doubles alone; null if there is none.
template <class Scalar>
const Method<Scalar>* FindOverDoubles(std::string_view name) {
  if constexpr (std::is_same_v<Scalar, double>) {
    const auto rows = MethodsOverDoubles();
    const auto row = std::find_if(rows.begin(), rows.end(), [name](auto& m) { return m.name == name; });
    if (row != rows.end()) return &*row;
  }
  return nullptr;
}

// Whether a row of the tables over the scalar has the method, or `auto` chooses from them.
template <class Scalar>
bool IsFloatingMethod(std::string_view name) {
  return name == kAutomatic || FindMethod<Scalar>(name) != nullptr || FindOverDoubles<Scalar>(name) != nullptr;
}

template <class Scalar>
Answer<Scalar> RunRounded(const ContactProblem<Scalar>& problem, const Request& request) {
  if (const Method<Scalar>* row = FindOverDoubles<Scalar>(request.method))
    return SolveBy(*row, problem, request);
  return Solve(problem, request);
}

// By the factors that the problem came in, where they are asked for by name or `auto` may take them; empty
// where the methods for all problems are to try, too.
std::optional<InexactAnswer> SolveByFactors(const Request& request, const ExactFactors* factors) {
  const bool is_named = request.method == kNewtonBodies, any = request.method == kAutomatic;
  if (factors == nullptr || (!is_named && !any)) return std::nullopt;
  InexactAnswer answer = SolveByBodies(*factors, request);
  if (!is_named && !answer.Solved() && !request.limits.Stopped()) return std::nullopt;
  return answer;
}

template <class Scalar>
Solution SolveRounded(const RoundedProblem<Scalar>& problem, const Request& request,
                      const ExactFactors* factors) {
  const ContactProblem<Scalar>& rounded = problem.numbers();
  const auto file = [&problem] { return problem.File(); };
  Solution solution;
  if constexpr (std::is_same_v<Scalar, double>) {
    if (auto answer = SolveByFactors(request, factors)) {
      PreferRestRounded(rounded, file, request, *answer);
      return {.answer = *std::move(answer)};
    }
    if (request.method == kAutomatic && !request.trace) {
      solution = SolveEscalating(rounded, request);
      PreferRestRounded(rounded, file, request, std::get<InexactAnswer>(solution.answer));
      return solution;
    }
  }
  if (!IsFloatingMethod<Scalar>(request.method)) return SolveAndRound(problem, request);
  solution.answer = InDoubles(RunRounded(rounded, request), rounded, ResidualOf<Scalar>(request));
  Confirm(problem, request, solution);
  const auto ran = Converted<double>(rounded, [](const Scalar& x) { return static_cast<double>(x); });
  if (auto* answer = std::get_if<InexactAnswer>(&solution.answer))
    PreferRestRounded(ran, file, request, *answer);
  return solution;
}

template <class Scalar>
Solution SolveRounded(const ExactProblem& problem, const Request& request, const ExactFactors* factors,
                      Stopwatch* watch) {
  const RoundedProblem<Scalar> rounded(problem);
  if (watch != nullptr) *watch = Stopwatch();
  return SolveRounded(rounded, request, factors);
}

// ---- Enclosures ----------------------------------------------------------------------------------

// What enclosures prove is said of the algorithm in exact arithmetic. The midpoints are judged besides.
void JudgeMiddles(const ExactProblem& problem, const Request& request, InexactAnswer& answer) {
  if (!answer.Solved()) return;
  const Eigen::VectorXd a = answer.a;
  JudgeAnswer(Rounded<double>(problem), ResidualOf<double>(request), answer);
  answer.a = a;
}

Solution SolveOverIntervals(const ExactProblem& problem, const Request& request) {
  InexactAnswer answer = problem.dimension == 2 ? RunEnclosed(FindMethodFacts(request.method)->name, problem,
                                                              request, Rung::kDouble)
                                                : RunIntervalsInSpace(problem, request);
  answer.arithmetic = Arithmetic::kInterval;
  JudgeMiddles(problem, request, answer);
  return {.answer = std::move(answer)};
}

// Empty where the rung leaves a sign open, or knows forces too badly to call them a solution.
std::optional<InexactAnswer> SolveOnRung(const ExactProblem& problem, const Request& request, Rung rung) {
  InexactAnswer answer = RunEnclosed(FindMethodFacts(request.method)->name, problem, request, rung);
  try {
    JudgeMiddles(problem, request, answer);
  } catch (const RangeError&) {
    return std::nullopt;
  }
  answer.arithmetic = Arithmetic::kFiltered;
  answer.rung = rung;
  const bool open = answer.outcome == Outcome::kUndecided && !request.limits.Stopped();
  return open ? std::nullopt : std::optional(std::move(answer));
}

// `auto` is complete driving, and what rationals try besides where that solves nothing, or of many rows.
Solution SolveFiltered(const ExactProblem& problem, const Request& request, const ExactFactors* factors) {
  if (request.method == kAutomatic) {
    Request complete = request;
    complete.method = "complete";
    Solution solution;
    if (problem.rows() < kCellsFirst) solution = SolveFiltered(problem, complete, factors);
    if (solution.outcome() != Outcome::kSolved) {
      ExactAnswer answer = SolveRestingExactly(problem, request, factors);
      answer.rung = Rung::kExact;
      return {.answer = std::move(answer)};
    }
    if (auto* exact = std::get_if<ExactAnswer>(&solution.answer)) {
      PreferRest(problem, request, factors, *exact);
    } else {
      PreferRestRounded(
          Rounded<double>(problem), [&problem] { return problem; }, request,
          std::get<InexactAnswer>(solution.answer));
    }
    return solution;
  }
  // The published algorithm, and whatever is told step by step, is run with certified signs from the start.
  if (request.method != "baraff" && !request.trace) {
    CertifiedAnswer certified = CertifyDoubles(request.method, problem, request);
    if (auto* answer = std::get_if<InexactAnswer>(&certified)) return {.answer = std::move(*answer)};
    if (auto* answer = std::get_if<ExactAnswer>(&certified)) return {.answer = std::move(*answer)};
  }
  const bool has_rungs = FindMethodFacts(request.method)->IsBuilt(problem.dimension, Arithmetic::kInterval);
  for (const Rung rung : {Rung::kDouble, Rung::kDoubleDouble}) {
    if (!has_rungs) break;
    if (auto answer = SolveOnRung(problem, request, rung)) return {.answer = *std::move(answer)};
  }
  ExactAnswer answer = SolveExactly(problem, request);
  answer.arithmetic = Arithmetic::kFiltered;
  answer.rung = Rung::kExact;
  return {.answer = std::move(answer)};
}

std::vector<std::string_view> ArithmeticsOf(const MethodFacts& facts, int dimension) {
  std::vector<std::string_view> names;
  for (int i = 0; i < kArithmeticCount; ++i) {
    if (facts.IsBuilt(dimension, static_cast<Arithmetic>(i))) names.push_back(kArithmeticNames[i]);
  }
  return names;
}

std::vector<std::string_view> MethodsOf(int dimension, Arithmetic arithmetic) {
  std::vector<std::string_view> names;
  for (const MethodFacts& facts : AllMethods()) {
    if (facts.IsBuilt(dimension, arithmetic)) names.push_back(facts.name);
  }
  return names;
}

}  // namespace

std::optional<Arithmetic> FindArithmetic(std::string_view name) {
  const auto at = std::find(kArithmeticNames.begin(), kArithmeticNames.end(), name);
  if (at == kArithmeticNames.end()) return std::nullopt;
  return static_cast<Arithmetic>(at - kArithmeticNames.begin());
}

std::string Refusal(std::string_view method, int dimension, Arithmetic arithmetic) {
  const bool filtered = arithmetic == Arithmetic::kFiltered && dimension == 2;
  const bool any =
      method == kAutomatic && (IsFloating(arithmetic) || arithmetic == Arithmetic::kExact || filtered);
  const MethodFacts* facts = FindMethodFacts(method);
  if (any || (facts != nullptr && facts->IsBuilt(dimension, arithmetic))) return "";
  const char* where = dimension == 2 ? "the plane" : "space";
  std::string text =
      fmt::format("method {} with arithmetic {} in {}: not built", method, Name(arithmetic), where);
  const auto arithmetics =
      facts == nullptr ? std::vector<std::string_view>() : ArithmeticsOf(*facts, dimension);
  if (!arithmetics.empty()) return text + fmt::format("; expected one of {}", fmt::join(arithmetics, ", "));
  const auto methods = MethodsOf(dimension, arithmetic);
  if (!methods.empty())
    return text +
           fmt::format("; methods with arithmetic {} there: {}", Name(arithmetic), fmt::join(methods, ", "));
  return text + "; expected one of float, double, quad, filtered, exact";
}

ArithmeticChoice UsualArithmetic(std::string_view method, const ExactProblem& problem) {
  using enum Arithmetic;
  const int most = problem.dimension == 2 ? kExactRows : kExactRowsInSpace;
  if (method == kAutomatic && problem.rows() > most)
    return {kDouble, fmt::format("{} rows, more than {}: rationals would take long", problem.rows(), most)};
  if (method == "fast") return {kDouble, "the method is made for doubles"};
  if (Refusal(method, problem.dimension, kExact).empty())
    return {kExact, "nothing is lost, and there are few rows"};
  if (Refusal(method, problem.dimension, kInterval).empty())
    return {kInterval, "the method takes roots: intervals prove what they decide"};
  return {kDouble, "the method is built for nothing better"};
}

Solution SolveDoubles(const ContactProblem<double>& problem, const Request& request) {
  RequireReading(ExactProblem{.dimension = problem.dimension, .contacts = {}, .A = {}, .b = {}}, request);
  return SolveRounded(RoundedProblem<double>(problem), request, nullptr);
}

Solution SolveIn(const ExactProblem& problem, const Request& request, const ExactFactors* factors,
                 Stopwatch* watch) {
  RequireReading(problem, request);
  switch (request.arithmetic) {
    case Arithmetic::kFloat:
      return SolveRounded<float>(problem, request, factors, watch);
    case Arithmetic::kDouble:
      return SolveRounded<double>(problem, request, factors, watch);
    case Arithmetic::kQuad:
      return SolveRounded<Quad>(problem, request, factors, watch);
    case Arithmetic::kInterval:
      return SolveOverIntervals(problem, request);
    case Arithmetic::kFiltered:
      return SolveFiltered(problem, request, factors);
    default:
      return {.answer = SolveRestingExactly(problem, request, factors)};
  }
}

}  // namespace stiction
