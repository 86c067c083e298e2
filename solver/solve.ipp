// SPDX-License-Identifier: Apache-2.0
// Definitions for solve.h, and the rows of the table. A new method is a row and its run.

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "solver/complete/complete.h"
#include "solver/lemke/lemke.h"
#include "solver/numeric/refine.h"
#include "solver/problem/ball.h"
#include "solver/problem/gate.h"
#include "solver/problem/pressing.h"
#include "solver/problem/remainder.h"
#include "solver/problem/row_scale.h"
#include "solver/published/published.h"
#include "solver/solve.h"

namespace stiction {

// ---- Runs of path methods in the plane, over any scalar ------------------------------------------

// What run() returns; undecided where an enclosure does not tell a sign.
template <class Scalar, class Run>
Answer<Scalar> UnlessUnsure(Run run) {
  try {
    return run();
  } catch (const UnsureSign&) {
    Answer<Scalar> answer;
    answer.reason = kUnsureSign;
    return answer;
  }
}

// The trace of a run is kept where it is asked for.
template <class Scalar>
Trace<Scalar>* Kept(const Request& request, Trace<Scalar>& trace) {
  return request.trace ? &trace : nullptr;
}

template <class Scalar>
Answer<Scalar> RunBaraff(const ContactProblem<Scalar>& problem, const Request& request) {
  PublishedAlgorithm<Scalar> algorithm(request);
  algorithm.KnowDependentRows(request.dependent);
  Trace<Scalar> trace;
  auto answer =
      UnlessUnsure<Scalar>([&] { return AnswerOf<Scalar>(algorithm.Run(problem, Kept(request, trace))); });
  answer.f = algorithm.state().f;
  if constexpr (kEncloses<Scalar>) answer.a = algorithm.state().a;
  if (answer.outcome == Outcome::kRay) answer.ray = algorithm.direction().df();
  answer.pivots = std::move(trace.pivots);
  return answer;
}

template <class Scalar>
Answer<Scalar> RunCompleteDriving(const ContactProblem<Scalar>& problem, const Request& request) {
  CompleteDriving<Scalar> driving(request);
  driving.KnowDependentRows(request.dependent);
  Trace<Scalar> trace;
  auto answer = UnlessUnsure<Scalar>([&] {
    auto end = AnswerOf<Scalar>(driving.Run(problem, Kept(request, trace)));
    end.word = driving.Word();
    return end;
  });
  answer.f = driving.f();
  if constexpr (kEncloses<Scalar>) answer.a = driving.a();
  if (answer.outcome == Outcome::kRay) answer.ray = driving.ray();
  const bool unsure = answer.reason == kUnsureSign;  // within a step, which is not told
  if (unsure && !trace.pivots.empty() && trace.pivots.back().limiting < 0) trace.pivots.pop_back();
  answer.pivots = std::move(trace.pivots);
  return answer;
}

// Units of the problem at hand steady the ratio tests of rounded numbers; ones are the classical cover.
template <class Scalar>
inline constexpr Cover kUsualCover = kIsExact<Scalar> ? Cover::kOnes : Cover::kUnits;

template <class Scalar>
Answer<Scalar> RunLemkeMethod(const ContactProblem<Scalar>& problem, const Request& request) {
  LemkeAlgorithm<Scalar> algorithm(request, kUsualCover<Scalar>);
  return UnlessUnsure<Scalar>([&] {
    Trace<Scalar> trace;
    auto answer = AnswerOf<Scalar>(algorithm.Run(problem, Kept(request, trace)));
    answer.pivots = std::move(trace.pivots);
    if (answer.Solved() || answer.reason == kImprecise) {
      answer.f = algorithm.f();
      if constexpr (kEncloses<Scalar>) answer.a = algorithm.a();
    }
    if (answer.outcome == Outcome::kRay) answer.ray = algorithm.ray();
    return answer;
  });
}

// The rows that every scalar has; `space` by the caller.
template <class Scalar>
Method<Scalar> BaraffRow(MethodIn<Scalar> space, MethodIn<Scalar> plane = {&RunBaraff<Scalar>}) {
  return {.name = "baraff",
          .title = "the published pivoting algorithm, under a policy",
          .source = "[Baraff94] 4.3, 5.2-5.6",
          .ends = "nothing: it can cycle, and in space take an infinite step",
          .path = Path::kDrives,
          .heading = "The published algorithm",
          .plane = plane,
          .space = space};
}

template <class Scalar>
Method<Scalar> CompleteRow(MethodIn<Scalar> space) {
  return {.name = "complete",
          .title = "complete driving: Baraff's path followed through folds and descents",
          .source = "solver/complete/complete_driving.md",
          .ends = "a solution wherever A is symmetric positive semidefinite and b in its range",
          .automatic = true,
          .path = Path::kPieces,
          .heading = "Complete driving",
          .plane = {&RunCompleteDriving<Scalar>},
          .space = space};
}

template <class Scalar>
Method<Scalar> LemkeRow(MethodIn<Scalar> space) {
  return {.name = "lemke",
          .title = "Lemke's complementary pivoting, lexicographic",
          .source = "Cottle, Pang and Stone 1992, 4.4",
          .ends = "a solution wherever A is symmetric positive semidefinite and b in its range",
          .automatic = kIsExact<Scalar>,
          .path = Path::kPivots,
          .heading = "Lemke's method",
          .plane = {&RunLemkeMethod<Scalar>},
          .space = space};
}

// ---- The call --------------------------------------------------------------------------------

// The unit of a step: of the driven force, or of the variable that enters in Lemke's method.
template <class Scalar>
int UnitOfStep(const Pivot<Scalar>& pivot, const RowScale& scale) {
  if (pivot.entering.empty()) return scale.f[pivot.driven];
  if (pivot.driven < 0) return scale.b;
  const char kind = pivot.entering.front();  // lemke.h: fN1, m1; aN1, l1
  return kind == 'f' || kind == 'm' ? scale.f[pivot.driven] : scale.a[pivot.driven];
}

template <class Scalar>
void Unscale(Answer<Scalar>& answer, const RowScale& scale) {
  ScaleBy(answer.f, scale.f);
  ScaleBy(answer.first_f, scale.f);
  ScaleBy(answer.ray, scale.f, -scale.b);  // any length will do
  using std::ldexp;
  for (Pivot<Scalar>& pivot : answer.pivots) {
    const int unit = UnitOfStep(pivot, scale);
    ScaleBy(pivot.f, scale.f);
    ScaleBy(pivot.a, scale.a);
    ScaleBy(pivot.df, scale.f, -unit);
    ScaleBy(pivot.da, scale.a, -unit);
    pivot.s = ldexp(pivot.s, unit);
    pivot.cover = ldexp(pivot.cover, scale.b);
  }
}

// Whether all numbers of a problem are finite.
template <class Scalar>
bool IsFinite(const ContactProblem<Scalar>& problem) {
  return problem.A.allFinite() && problem.b.allFinite() &&
         std::all_of(problem.contacts.begin(), problem.contacts.end(), [](const auto& contact) {
           using std::isfinite;
           return isfinite(contact.mu);
         });
}

template <class Scalar>
Answer<Scalar> Unstarted(const ContactProblem<Scalar>& problem, Outcome outcome, std::string_view reason) {
  Answer<Scalar> answer;
  answer.outcome = outcome;
  answer.reason = reason;
  answer.first_f = ContactProblem<Scalar>::Vector::Constant(problem.rows(), Scalar(0));
  return answer;
}

// Reduces, runs, restores.
template <class Scalar>
Answer<Scalar> RunOnRemainder(const Method<Scalar>& method, const ContactProblem<Scalar>& problem,
                              const Request& request) {
  using Vector = typename ContactProblem<Scalar>::Vector;
  // A path is told as it is, and the published one knows no exchanges.
  const bool may_exchange = !request.trace && method.path != Path::kDrives;
  const Remainder<Scalar> remainder(problem, request.tolerances, may_exchange);
  if (!remainder.Obstacle().empty()) return Unstarted(problem, Outcome::kSingular, remainder.Obstacle());
  Answer<Scalar> answer = method.In(problem.dimension).run(remainder.problem(), request);
  const auto rows = remainder.problem().rows();
  if (answer.f.size() == rows) answer.f = remainder.Forces(answer.f);
  if (rows > 0 && answer.ray.size() == rows) answer.ray = remainder.Direction(answer.ray);
  answer.first_f = remainder.Forces(Vector::Constant(rows, Scalar(0)));
  answer.word = remainder.Word(answer.word);
  for (Pivot<Scalar>& pivot : answer.pivots) pivot = remainder.Restored(std::move(pivot));
  return answer;
}

template <class Scalar>
Answer<Scalar> RunAsIs(const Method<Scalar>& method, const ContactProblem<Scalar>& problem,
                       const Request& request) {
  if (!method.In(problem.dimension).takes_all_kinds) return RunOnRemainder(method, problem, request);
  Answer<Scalar> answer = method.In(problem.dimension).run(problem, request);
  if (answer.first_f.size() == 0)
    answer.first_f = ContactProblem<Scalar>::Vector::Constant(problem.rows(), Scalar(0));
  return answer;
}

// Forces are refined over doubles where the gate asks for it; what passes in wider numbers keeps its digits.
template <class Scalar>
Errors<double> JudgeForces(const ContactProblem<Scalar>& problem, FrictionLaw law, const Gate& gate,
                           typename ContactProblem<Scalar>::Vector& f) {
  if constexpr (std::is_same_v<Scalar, double>) {
    Refined refined = Refine(problem, law, gate, f);
    f = std::move(refined.f);
    return refined.errors;
  } else {
    constexpr bool narrow = std::is_same_v<Scalar, float>;  // whose products are exact over doubles
    const auto doubles = Converted<double>(problem, [](const Scalar& x) { return static_cast<double>(x); });
    const auto errors_of = [&](const auto& forces) {
      if constexpr (narrow) return BoundErrors(doubles, law, forces.template cast<double>().eval(), gate);
      if constexpr (!narrow) return BoundErrors(problem, law, forces, gate);
    };
    const Errors<double> given = errors_of(f);
    if (!narrow && (!given.is_finite || given.Largest() <= gate.eps)) return given;
    const Eigen::VectorXd first = f.template cast<double>();
    const Refined refined = Refine(doubles, law, gate, first);
    if (refined.f == first) return given;
    const typename ContactProblem<Scalar>::Vector told = refined.f.template cast<Scalar>();
    const Errors<double> errors = errors_of(told);
    if (!(errors.Largest() < given.Largest() || errors.Largest() <= gate.eps)) return given;
    f = told;
    return errors;
  }
}

// HidesWhatActs (problem/pressing.h), whose accelerations are not rounded to float.
template <class Scalar>
bool HidesWhatActsIn(const ContactProblem<Scalar>& problem, const Answer<Scalar>& answer, const Gate& gate) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return HidesWhatActs(problem, answer.f, answer.a, gate.tau);
  } else {
    const Eigen::VectorXd f = answer.f.template cast<double>();
    Eigen::VectorXd a = answer.a.template cast<double>();
    if constexpr (std::is_same_v<Scalar, float>)
      a = problem.A.template cast<double>() * f + problem.b.template cast<double>();
    return HidesWhatActs(problem, f, a, gate.tau);
  }
}

template <class Scalar>
void JudgeAnswer(const ContactProblem<Scalar>& problem, double bound, Answer<Scalar>& answer) {
  if (answer.f.size() != problem.rows()) {
    if (answer.Solved()) answer.outcome = Outcome::kUndecided;
    return;
  }
  const bool claims = answer.Solved() || answer.outcome == Outcome::kUndecided;
  const Gate gate = GateOf<Scalar>(bound);
  answer.errors = claims ? JudgeForces(problem, answer.law, gate, answer.f)
                         : BoundErrors(problem, answer.law, answer.f, gate);
  answer.a = problem.A * answer.f + problem.b;
  const bool is_finite = answer.f.allFinite() && answer.a.allFinite();
  const bool is_lost = is_finite && HidesWhatActsIn(problem, answer, gate);
  const bool passes = is_finite && !is_lost && answer.errors->Largest() <= bound;
  if (passes && answer.outcome == Outcome::kUndecided) {  // the method measured with less digits
    answer.outcome = Outcome::kSolved;
    answer.reason.clear();
  }
  if (!answer.Solved() || passes) return;
  answer.outcome = Outcome::kUndecided;
  answer.reason = !is_finite ? "a number is not finite"
                  : is_lost  ? "the forces are so large that their rounding hides what acts"
                  : answer.errors->acceleration > bound ? "the error of an acceleration is above the bound"
                                                        : "the error of a force is above the bound";
}

template <class Scalar>
Answer<Scalar> RunScaled(const Method<Scalar>& method, const ContactProblem<Scalar>& problem,
                         const Request& request) {
  const bool compares = method.name == "baraff" && request.policy.scan == Scan::kMostViolated;
  const RowScale scale = FindScale(problem, compares);
  Answer<Scalar> answer = RunAsIs(method, Scaled(problem, scale), request);
  Unscale(answer, scale);
  return answer;
}

template <class Scalar>
Answer<Scalar> SolveBy(const Method<Scalar>& method, const ContactProblem<Scalar>& problem,
                       const Request& request) {
  Answer<Scalar> answer;
  if constexpr (kIsExact<Scalar>) {
    answer = RunAsIs(method, problem, request);
    if (answer.f.size() == problem.rows()) answer.a = problem.A * answer.f + problem.b;
  } else {
    answer = IsFinite(problem) ? RunScaled(method, problem, request)
                               : Unstarted(problem, Outcome::kUndecided, "a number is not finite");
    JudgeAnswer(problem, ResidualOf<Scalar>(request), answer);
  }
  answer.method = method.name;
  return answer;
}

template <class Scalar>
const Method<Scalar>* FindMethod(std::string_view name) {
  const auto methods = Methods<Scalar>();
  const auto row = std::find_if(methods.begin(), methods.end(), [name](auto& m) { return m.name == name; });
  return row == methods.end() ? nullptr : &*row;
}

// The methods that the table marks, until one solves or proves that nothing does; the first answer where none
// does either. A proof keeps the ray that was met before: with sliding contacts it is the impulsive direction.
template <class Scalar>
Answer<Scalar> SolveAutomatically(const ContactProblem<Scalar>& problem, const Request& request) {
  std::optional<Answer<Scalar>> first;
  for (const bool is_first : {true, false}) {
    for (const Method<Scalar>& method : Methods<Scalar>()) {
      const bool comes_first = method.IsFirst(problem.dimension, problem.rows());
      if (comes_first != is_first || !(comes_first || method.IsAutomatic(problem.dimension))) continue;
      Answer<Scalar> answer = SolveBy(method, problem, request);
      if (answer.outcome == Outcome::kNoSolution && first) answer.ray = std::move(first->ray);
      if (answer.Solved() || answer.outcome == Outcome::kNoSolution) return answer;
      if (!first) first = std::move(answer);
    }
  }
  return first ? *std::move(first) : Unstarted(problem, Outcome::kUndecided, "no method is built for it");
}

template <class Scalar>
Answer<Scalar> Solve(const ContactProblem<Scalar>& problem, const Request& request) {
  if (request.method == kAutomatic) return SolveAutomatically(problem, request);
  const Method<Scalar>* row = FindMethod<Scalar>(request.method);
  if (row == nullptr || !row->IsBuilt(problem.dimension))
    throw std::invalid_argument("method " + std::string(request.method) + " is not built for dimension " +
                                std::to_string(problem.dimension) + " over " +
                                std::string(Name(kArithmeticOf<Scalar>)));
  return SolveBy(*row, problem, request);
}

}  // namespace stiction
