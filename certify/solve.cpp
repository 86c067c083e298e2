// SPDX-License-Identifier: Apache-2.0
#include "certify/solve.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/intervals.h"
#include "certify/published_space.h"
#include "certify/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr int kExactRows = 60;  // from which on `auto` solves over doubles

bool IsFloating(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::kFloat || arithmetic == Arithmetic::kDouble ||
         arithmetic == Arithmetic::kLongDouble;
}

template <class Scalar>
double BoundOf(const SolveOptions& options) {
  return options.residual > 0 ? options.residual : kSolvedResidual<Scalar>;
}

// ---- Exact -------------------------------------------------------------------------------------

// The first condition that an answer breaks which calls itself solved.
std::optional<std::string> ViolationOf(const ExactProblem& problem, const Answer<Rational>& answer) {
  if (problem.dimension == 2) return FindViolation(problem, answer.f);
  if (answer.law == FrictionLaw::kBaraff) return FindWeakViolation(problem, answer.f);
  return FindCoulombViolation(problem, answer.f, *ParseRational(answer.bound));
}

template <class Scalar>
TracedAnswer<Scalar> Traced(Answer<Scalar> answer, Trace<Scalar> trace) {
  TracedAnswer<Scalar> traced;
  static_cast<Answer<Scalar>&>(traced) = std::move(answer);
  traced.pivots = std::move(trace.pivots);
  return traced;
}

template <class Scalar>
TracedAnswer<Scalar> SolveTraced(const ContactProblem<Scalar>& problem, const SolveRequest& request) {
  Trace<Scalar> trace;
  const bool keep = request.trace == KeepTrace::kYes;
  Answer<Scalar> answer = Solve(problem, request.method, request.options, keep ? &trace : nullptr);
  return Traced(std::move(answer), std::move(trace));
}

ExactAnswer SolveExactly(const ExactProblem& problem, const SolveRequest& request) {
  ExactAnswer answer = SolveTraced(problem, request);
  if (!answer.Solved()) return answer;
  const auto violation = ViolationOf(problem, answer);
  STICTION_CHECK(!violation, fmt::format("{} calls solved what is not: {}", answer.method, *violation));
  answer.residual = 0;
  return answer;
}

// ---- Floating point ------------------------------------------------------------------------------

template <class Vector>
Eigen::VectorXd InDoubles(const Vector& values) {
  return values.template cast<double>();
}

template <class Scalar>
Pivot<double> InDoubles(const Pivot<Scalar>& pivot) {
  return Converted<double>(pivot, [](const Scalar& x) { return static_cast<double>(x); });
}

// Forces of long double are rounded to what is told of them before they are judged.
template <class Scalar>
InexactAnswer InDoubles(const TracedAnswer<Scalar>& answer, const ContactProblem<Scalar>& problem,
                        double bound) {
  InexactAnswer result;
  result.outcome = answer.outcome;
  result.reason = answer.reason;
  result.start = answer.start;
  result.period = answer.period;
  result.method = answer.method;
  result.arithmetic = answer.arithmetic;
  result.law = answer.law;
  result.f = InDoubles(answer.f);
  result.a = InDoubles(answer.a);
  result.ray = InDoubles(answer.ray);
  result.first_f = InDoubles(answer.first_f);
  result.residual = answer.residual;
  result.word = answer.word;
  result.counters = answer.counters;
  for (const Pivot<Scalar>& pivot : answer.pivots) result.pivots.push_back(InDoubles(pivot));
  if (sizeof(Scalar) > sizeof(double)) {
    const auto doubles = Converted<double>(problem, [](const Scalar& x) { return static_cast<double>(x); });
    JudgeAnswer(doubles, bound, result);
  }
  return result;
}

// The published algorithm in space again: over long double, loop_grain 1e-12, tolerances of at most 1e-14.
InexactAnswer RunFinely(const ContactProblem<double>& problem, SolveRequest request) {
  Tolerances& t = request.options.tolerances;
  for (double* tolerance : {&t.acceleration, &t.force, &t.pivot}) *tolerance = std::min(*tolerance, 1e-14);
  t.loop_grain = std::min(t.loop_grain, 1e-12);
  request.trace = KeepTrace::kNo;
  const auto wide = Converted<long double>(problem, [](double x) { return static_cast<long double>(x); });
  return InDoubles(SolveTraced(wide, request), wide, BoundOf<double>(request.options));
}

// An answer that is only a suspicion: the same problem is run again where that decides more.
void Confirm(const ContactProblem<double>& ran, const SolveRequest& request, Solution& solution) {
  const InexactAnswer& first = std::get<InexactAnswer>(solution.answer);
  const MethodFacts* facts = FindMethodFacts(request.method);
  const bool is_path = facts != nullptr && facts->has_path;
  if (first.Solved() || !is_path || !request.confirm || request.options.limits.Stopped()) return;
  const Suspicion suspicion = SuspicionOf(first);
  if (facts->IsBuilt(ran.dimension, Arithmetic::kExact) && ran.dimension == 2) {
    solution.answer = SolveExactly(Unrounded(ran), request);
  } else if (ran.dimension == 3 && request.method == "baraff") {
    std::vector<Pivot<double>> pivots = first.pivots;
    InexactAnswer again = RunFinely(ran, request);
    again.pivots = std::move(pivots);
    solution.answer = std::move(again);
  } else {
    return;
  }
  solution.suspected = suspicion;
}

// What decides exactly, asked for rounded numbers: its forces are rounded, and then judged.
template <class Scalar>
TracedAnswer<Scalar> SolveAndRound(const ContactProblem<Scalar>& problem, const SolveRequest& request,
                                   double bound) {
  const ExactAnswer exact = SolveExactly(Unrounded(problem), request);
  TracedAnswer<Scalar> answer;
  answer.outcome = exact.outcome;
  answer.reason = exact.reason;
  answer.method = exact.method;
  answer.counters = exact.counters;
  answer.f = exact.f.unaryExpr([](const Rational& x) { return static_cast<Scalar>(ToDouble(x)); });
  answer.first_f = answer.f;
  answer.first_f.setZero();
  JudgeAnswer(problem, bound, answer);
  return answer;
}

// The row that runs in a process of its own; null if there is none.
template <class Scalar>
const Method<Scalar>* FindProcess(std::string_view name) {
  if constexpr (std::is_same_v<Scalar, double>) {
    const auto rows = MethodsByProcess();
    const auto row = std::find_if(rows.begin(), rows.end(), [name](auto& m) { return m.name == name; });
    if (row != rows.end()) return &*row;
  }
  return nullptr;
}

template <class Scalar>
TracedAnswer<Scalar> RunRounded(const ContactProblem<Scalar>& problem, const SolveRequest& request) {
  if (request.method == kAutomatic || FindMethod<Scalar>(request.method) != nullptr)
    return SolveTraced(problem, request);
  if (const Method<Scalar>* process = FindProcess<Scalar>(request.method))
    return Traced(SolveBy(*process, problem, request.options), Trace<Scalar>());
  return SolveAndRound(problem, request, BoundOf<Scalar>(request.options));
}

template <class Scalar>
Solution SolveRounded(const ExactProblem& problem, const SolveRequest& request) {
  const ContactProblem<Scalar> rounded = Rounded<Scalar>(problem);
  Solution solution;
  solution.answer = InDoubles(RunRounded(rounded, request), rounded, BoundOf<Scalar>(request.options));
  Confirm(Converted<double>(rounded, [](Scalar x) { return static_cast<double>(x); }), request, solution);
  return solution;
}

// ---- Intervals -----------------------------------------------------------------------------------

double Middle(const Enclosure& x) { return x.low + (x.high - x.low) / 2; }

Eigen::VectorXd MiddleOf(const std::vector<Enclosure>& values) {
  Eigen::VectorXd middles(values.size());
  std::transform(values.begin(), values.end(), middles.begin(), Middle);
  return middles;
}

IntervalRun RunBaraffInSpace(const ExactProblem& problem, const SolveOptions& options, KeepTrace) {
  const IntervalSpaceRun run =
      RunIntervalsInSpace(problem, {options.policy, options.tolerances, options.limits});
  return {run.verdict, run.f, run.a,
          run.ray,     {},    {{"redirects", run.verdict.redirects}, {"breaks", run.verdict.breaks}}};
}

IntervalRun RunBaraff(const ExactProblem& problem, const SolveOptions& options, KeepTrace keep) {
  return RunPublishedOverIntervals(problem, {options.policy, options.tolerances, options.limits}, keep);
}

IntervalRun RunLemke(const ExactProblem& problem, const SolveOptions& options, KeepTrace keep) {
  return RunLemkeOverIntervals(problem, options.limits, keep);
}

// What intervals prove is said of the algorithm in exact arithmetic. The midpoints are judged besides.
Solution SolveOverIntervals(const ExactProblem& problem, const SolveRequest& request) {
  const auto methods = IntervalMethods();
  const auto method = std::find_if(methods.begin(), methods.end(), [&](auto& m) {
    return m.name == request.method && m.dimension == problem.dimension;
  });
  IntervalRun run = method->run(problem, request.options, request.trace);
  InexactAnswer answer;
  answer.outcome = run.verdict.outcome;
  answer.reason = run.verdict.reason;
  answer.start = run.verdict.start;
  answer.period = run.verdict.period;
  answer.method = method->name;
  answer.arithmetic = Arithmetic::kInterval;
  answer.f = MiddleOf(run.f);
  answer.ray = MiddleOf(run.ray);
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  answer.counters = CountersOf(run.verdict.statistics);
  answer.counters.insert(answer.counters.end(), run.more.begin(), run.more.end());
  if (answer.Solved()) JudgeAnswer(Rounded<double>(problem), BoundOf<double>(request.options), answer);
  answer.a = MiddleOf(run.a);
  answer.pivots = std::move(run.pivots);
  answer.f_enclosed = std::move(run.f);
  answer.a_enclosed = std::move(run.a);
  return {std::move(answer), std::nullopt};
}

void RequireReading(const ExactProblem& problem, const SolveRequest& request) {
  const bool concerned = problem.dimension == 3 && request.method == "baraff";
  if (!concerned || PublishedReadsInSpace(request.options.policy)) return;
  throw InputError(
      fmt::format("--policy {}: in space expected file=no, apex=kept and slip=literal or slip=redirect, or "
                  "slip=polygon alone; no other reading of these is built",
                  PolicyName(request.options.policy)));
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

Suspicion SuspicionOf(const InexactAnswer& answer) {
  return {answer.outcome,    answer.reason,   answer.start,   answer.period,
          answer.arithmetic, answer.residual, answer.counters};
}

std::span<const IntervalMethod> IntervalMethods() {
  static constexpr std::array rows = {IntervalMethod{"baraff", 2, &RunBaraff},
                                      IntervalMethod{"lemke", 2, &RunLemke},
                                      IntervalMethod{"baraff", 3, &RunBaraffInSpace}};
  return rows;
}

std::optional<Arithmetic> FindArithmetic(std::string_view name) {
  const auto at = std::find(kArithmeticNames.begin(), kArithmeticNames.end(), name);
  if (at == kArithmeticNames.end()) return std::nullopt;
  return static_cast<Arithmetic>(at - kArithmeticNames.begin());
}

std::string Refusal(std::string_view method, int dimension, Arithmetic arithmetic) {
  const bool any = method == kAutomatic && (IsFloating(arithmetic) || arithmetic == Arithmetic::kExact);
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
  return text + "; expected one of float, double, long-double, exact";
}

Arithmetic UsualArithmetic(std::string_view method, const ExactProblem& problem) {
  const bool large = method == kAutomatic && problem.rows() > kExactRows;
  if (large || method == "fast") return Arithmetic::kDouble;
  for (const Arithmetic arithmetic : {Arithmetic::kExact, Arithmetic::kInterval}) {
    if (Refusal(method, problem.dimension, arithmetic).empty()) return arithmetic;
  }
  return Arithmetic::kDouble;
}

Solution SolveIn(const ExactProblem& problem, const SolveRequest& request) {
  RequireReading(problem, request);
  switch (request.arithmetic) {
    case Arithmetic::kFloat:
      return SolveRounded<float>(problem, request);
    case Arithmetic::kDouble:
      return SolveRounded<double>(problem, request);
    case Arithmetic::kLongDouble:
      return SolveRounded<long double>(problem, request);
    case Arithmetic::kInterval:
      return SolveOverIntervals(problem, request);
    default:
      return {SolveExactly(problem, request), std::nullopt};
  }
}

}  // namespace stiction
