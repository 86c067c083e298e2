// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/filtered.h"

#include <optional>
#include <utility>

#include "certify/exact/dependent_rows.h"
#include "certify/exact/enclosed_remainder.h"
#include "certify/exact/exact.h"
#include "certify/exact/nearby_words.h"
#include "certify/exact/wide_ball.h"
#include "solver/complete/complete.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/problem/check.h"
#include "solver/problem/remainder.h"
#include "solver/published/published.ipp"
#include "solver/solve.ipp"

namespace stiction {
namespace {

template <class Number>
using BallProblem = ContactProblem<Ball<Number>>;
template <class Number>
using BallAnswer = Answer<Ball<Number>>;
template <class Number>
using BallTrace = Trace<Ball<Number>>;

// The rows that may follow from others, where the rung asks for them: the first leaves that to the second.
template <class Number>
constexpr bool kAsksForDependentRows = !std::is_same_v<Number, double>;

// ---- One method on one rung ----------------------------------------------------------------------

template <class Algorithm, class Answer>
void SetEnd(const Algorithm& algorithm, Answer& answer) {
  answer.f = algorithm.f();
  answer.a = algorithm.a();
}

template <class Number>
BallAnswer<Number> RunPublished(const BallProblem<Number>& problem, const SolveOptions& options,
                                DependentRows* dependent, BallTrace<Number>* trace) {
  PublishedAlgorithm<Ball<Number>> algorithm({options.policy, options.tolerances, options.limits});
  algorithm.KnowDependentRows(dependent);
  BallAnswer<Number> answer;
  try {
    const Verdict verdict = algorithm.Run(problem, trace);
    answer = AnswerOf<Ball<Number>>(verdict);
    if (verdict.outcome == Outcome::kRay) answer.ray = algorithm.direction().df();
  } catch (const UnsureSign&) {
    answer.reason = kUnsureSign;
  }
  answer.f = algorithm.state().f;
  answer.a = algorithm.state().a;
  return answer;
}

template <class Number>
BallAnswer<Number> RunComplete(const BallProblem<Number>& problem, const SolveOptions& options,
                               DependentRows* dependent, BallTrace<Number>* trace) {
  CompleteDriving<Ball<Number>> driving(CompleteOptionsOf(options));
  driving.KnowDependentRows(dependent);
  BallAnswer<Number> answer;
  try {
    answer = AnswerOf<Ball<Number>>(driving.Run(problem, trace));
    if (answer.outcome == Outcome::kRay) answer.ray = driving.ray();
    answer.word = driving.Word();
  } catch (const UnsureSign&) {
    answer.reason = kUnsureSign;
    if (trace != nullptr && !trace->pivots.empty() && trace->pivots.back().limiting < 0)
      trace->pivots.pop_back();
  }
  answer.f = driving.f();
  answer.a = driving.a();
  return answer;
}

template <class Number>
BallAnswer<Number> RunLemke(const BallProblem<Number>& problem, const SolveOptions& options,
                            BallTrace<Number>* trace) {
  LemkeAlgorithm<Ball<Number>> lemke(LemkeOptionsOf<Ball<Number>>(options));
  BallAnswer<Number> answer;
  try {
    const Verdict verdict = lemke.Run(problem, trace);
    answer = AnswerOf<Ball<Number>>(verdict);
    answer.counters = {{"pivots", verdict.statistics.pivots}};
    if (answer.outcome == Outcome::kRay) answer.ray = lemke.ray();
    if (!answer.Solved()) return answer;
    answer.f = lemke.f();
    answer.a = lemke.a();
  } catch (const UnsureSign&) {
    answer.reason = kUnsureSign;
  }
  return answer;
}

// ---- In the terms of the whole problem ----------------------------------------------------------

template <class Vector>
std::vector<Enclosure> EndsOf(const Vector& values) {
  std::vector<Enclosure> ends;
  for (const auto& x : values) ends.push_back({LowEnd(x), HighEnd(x)});
  return ends;
}

template <class Vector>
Eigen::VectorXd MiddleOf(const Vector& values) {
  return values.unaryExpr(&Approximation<typename Vector::Scalar>::Of);
}

template <class Number>
InexactAnswer RunOnRung(std::string_view method, const ExactProblem& problem, const SolveOptions& options,
                        KeepTrace keep) {
  const EnclosedRemainder<Ball<Number>> remainder(problem, &BallAround<Number>);
  InexactAnswer answer;
  answer.method = method;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  if (remainder.end() != ReductionEnd::kReduced) {
    answer.outcome = Outcome::kSingular;
    answer.reason = Reason(remainder.end());
    return answer;
  }
  std::optional<ExactDependentRows> dependent;
  if (kAsksForDependentRows<Number>) dependent.emplace(remainder.exact());
  DependentRows* const rows = dependent ? &*dependent : nullptr;
  BallTrace<Number> trace;
  BallTrace<Number>* const kept = keep == KeepTrace::kYes ? &trace : nullptr;
  const BallProblem<Number>& balls = remainder.problem();
  const BallAnswer<Number> end = method == "baraff"     ? RunPublished(balls, options, rows, kept)
                                 : method == "complete" ? RunComplete(balls, options, rows, kept)
                                                        : RunLemke(balls, options, kept);
  answer.outcome = end.outcome;
  answer.reason = end.reason;
  answer.start = end.start;
  answer.period = end.period;
  answer.counters = end.counters;
  answer.word = remainder.Word(end.word);
  if (end.f.size() > 0 || problem.rows() == 0) {
    const auto f = remainder.Forces(end.f);
    const auto a = remainder.Accelerations(end.f, end.a);
    answer.f = MiddleOf(f);
    answer.a = MiddleOf(a);
    answer.f_enclosed = EndsOf(f);
    answer.a_enclosed = EndsOf(a);
  }
  if (end.outcome == Outcome::kRay) answer.ray = MiddleOf(remainder.Direction(end.ray));
  for (const Pivot<Ball<Number>>& pivot : trace.pivots)
    answer.pivots.push_back(Converted<double>(remainder.Restored(pivot), &Approximation<Ball<Number>>::Of));
  return answer;
}

}  // namespace

InexactAnswer RunEnclosed(std::string_view method, const ExactProblem& problem, const SolveOptions& options,
                          Rung rung, KeepTrace keep) {
  return rung == Rung::kDouble ? RunOnRung<double>(method, problem, options, keep)
                               : RunOnRung<dd_real>(method, problem, options, keep);
}

// ---- The published algorithm, rung after rung ----------------------------------------------------

namespace {

// Empty where a sign is unsure.
template <class Number>
std::optional<Verdict> TryPublished(const ExactProblem& problem, const PublishedOptions& options,
                                    DependentRows* dependent) {
  thread_local PublishedAlgorithm<Ball<Number>> algorithm;
  algorithm.options() = options;
  algorithm.KnowDependentRows(dependent);
  try {
    return algorithm.Run(Converted<Ball<Number>>(problem, &BallAround<Number>));
  } catch (const UnsureSign&) {
    return std::nullopt;
  }
}

}  // namespace

OnRung RunPublishedFiltered(const ExactProblem& problem, const PublishedOptions& options, const Rungs& rungs) {
  const Remainder<Rational> remainder(problem);
  if (!remainder.Obstacle().empty()) {
    return {{Outcome::kSingular, remainder.Obstacle()}, Rung::kExact};
  }
  const ExactProblem& remaining = remainder.problem();
  if (rungs.first == Rung::kDouble) {
    if (const auto verdict = TryPublished<double>(remaining, options, nullptr))
      return {*verdict, Rung::kDouble};
  }
  if (rungs.first <= Rung::kDoubleDouble && Rung::kDoubleDouble <= rungs.last) {
    ExactDependentRows dependent(remaining);
    if (const auto verdict = TryPublished<dd_real>(remaining, options, &dependent))
      return {*verdict, Rung::kDoubleDouble};
  }
  if (rungs.last != Rung::kExact) return {{Outcome::kUndecided, kUnsureSign}, rungs.last};
  PublishedAlgorithm<Rational> algorithm(options);
  return {algorithm.Run(remaining), Rung::kExact};
}

// ---- Complete driving, rung after rung -------------------------------------------------------------

namespace {

// The mode of a finished contact; contacts that are neither frictionless nor static have left.
Mode ModeOf(Cell cell) {
  switch (cell) {
    case Cell::kBreak:
      return Mode::kBreak;
    case Cell::kStick:
      return Mode::kStick;
    case Cell::kUpper:
      return Mode::kSlipMinus;  // fF = mu fN
    case Cell::kLower:
      return Mode::kSlipPlus;
    default:
      return Mode::kTouch;
  }
}

// Empty where a sign is unsure, or the last word has no solution that is verified.
template <class Number>
std::optional<ExactAnswer> TryComplete(const ExactProblem& problem, const Limits& limits,
                                       DependentRows* dependent) {
  thread_local CompleteDriving<Ball<Number>> driving;
  driving.options().limits = limits;
  driving.KnowDependentRows(dependent);
  ExactAnswer answer;
  try {
    answer = AnswerOf<Rational>(driving.Run(Converted<Ball<Number>>(problem, &BallAround<Number>)));
  } catch (const UnsureSign&) {
    return std::nullopt;
  }
  if (!answer.Solved()) return std::nullopt;
  ModeWord word;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) word.push_back(ModeOf(driving.CellOf(i)));
  auto f = SolveWord(problem, word, std::vector<Rational>(problem.rows(), 0));
  if (!f) return std::nullopt;
  answer.f = *std::move(f);
  answer.word = driving.Word();
  return answer;
}

}  // namespace

ExactAnswer RunCompleteFiltered(const ExactProblem& problem, const Limits& limits) {
  const auto exactly = [&] {
    ExactAnswer answer = Solve(problem, "complete", {.limits = limits});
    answer.rung = Rung::kExact;
    return answer;
  };
  const Remainder<Rational> remainder(problem);
  if (!remainder.Obstacle().empty()) return exactly();
  Rung rung = Rung::kDouble;
  auto answer = TryComplete<double>(remainder.problem(), limits, nullptr);
  if (!answer) {
    rung = Rung::kDoubleDouble;
    ExactDependentRows dependent(remainder.problem());
    answer = TryComplete<dd_real>(remainder.problem(), limits, &dependent);
  }
  if (!answer) return exactly();
  answer->f = remainder.Forces(answer->f);
  answer->a = remainder.Accelerations(answer->f);
  answer->word = remainder.Word(answer->word);
  answer->method = "complete";
  answer->rung = rung;
  return *std::move(answer);
}

}  // namespace stiction
