// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/filtered.h"

#include <array>
#include <optional>
#include <set>
#include <utility>

#include "certify/exact/dependent_rows.h"
#include "certify/exact/enclosed_remainder.h"
#include "certify/exact/inexact.h"
#include "certify/exact/long_float.h"
#include "certify/exact/nearby_words.h"
#include "certify/exact/verify_solution.h"
#include "certify/exact/wide_ball.h"
#include "solver/complete/complete.ipp"
#include "solver/in_turn.h"
#include "solver/lemke/lemke.ipp"
#include "solver/problem/check.h"
#include "solver/problem/remainder.h"
#include "solver/published/published.ipp"
#include "solver/solve.ipp"

namespace stiction {
namespace {

// The rows that may follow from others, where the rung asks for them: the first leaves that to the second.
template <class Number>
constexpr bool kAsksForDependentRows = !std::is_same_v<Number, double>;

// What rationals know, in balls.
template <class Number>
class EnclosedRows final : public ExactDirections<Ball<Number>> {
 public:
  using System = typename ExactDirections<Ball<Number>>::System;

  explicit EnclosedRows(ExactDependentRows& exact) : exact_(exact) {}

  bool Follows(const std::vector<bool>& zero, int row) override { return exact_.Follows(zero, row); }
  typename System::Status Solve(const std::vector<IndexSet>& sets, int driven, int sign,
                                typename System::Vector& df, typename System::Vector& da) override {
    const auto status = static_cast<typename System::Status>(exact_.SolveDirection(sets, driven, sign));
    if (status != System::Status::kInconsistent) {
      df = exact_.direction().df().unaryExpr(&BallAround<Number>);
      da = exact_.direction().da().unaryExpr(&BallAround<Number>);
    }
    return status;
  }

 private:
  ExactDependentRows& exact_;
};

template <class Number>
std::span<const Method<Ball<Number>>> EnclosedMethods() {
  static const std::array rows = {BaraffRow<Ball<Number>>({}), CompleteRow<Ball<Number>>({}),
                                  LemkeRow<Ball<Number>>({})};
  return rows;
}

}  // namespace

template <>
std::span<const Method<Ball<double>>> Methods<Ball<double>>() {
  return EnclosedMethods<double>();
}
template <>
std::span<const Method<Ball<dd_real>>> Methods<Ball<dd_real>>() {
  return EnclosedMethods<dd_real>();
}
template <>
std::span<const Method<Ball<LongFloat>>> Methods<Ball<LongFloat>>() {
  return EnclosedMethods<LongFloat>();
}

namespace {

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
InexactAnswer RunOnRung(std::string_view method, const ExactProblem& problem, const Request& request) {
  const EnclosedRemainder<Ball<Number>> remainder(problem, &BallAround<Number>);
  InexactAnswer answer;
  answer.method = method;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  if (remainder.end() != ReductionEnd::kReduced) {
    answer.outcome = Outcome::kSingular;
    answer.reason = Reason(remainder.end());
    return answer;
  }
  ExactDependentRows rows(remainder.exact());
  EnclosedRows<Number> dependent(rows);
  Request enclosed = request;
  enclosed.dependent = kAsksForDependentRows<Number> ? &dependent : nullptr;
  const Method<Ball<Number>>* row = FindMethod<Ball<Number>>(method);
  STICTION_CHECK(row != nullptr, "a method over enclosures");
  const Answer<Ball<Number>> end = row->plane.run(remainder.problem(), enclosed);
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
  for (const Pivot<Ball<Number>>& pivot : end.pivots)
    answer.pivots.push_back(Converted<double>(remainder.Restored(pivot), &Approximation<Ball<Number>>::Of));
  return answer;
}

}  // namespace

InexactAnswer RunEnclosed(std::string_view method, const ExactProblem& problem, const Request& request,
                          Rung rung) {
  switch (rung) {
    case Rung::kDouble:
      return RunOnRung<double>(method, problem, request);
    case Rung::kDoubleDouble:
      return RunOnRung<dd_real>(method, problem, request);
    default:
      return RunOnRung<LongFloat>(method, problem, request);
  }
}

// ---- The published algorithm, rung after rung ----------------------------------------------------

namespace {

// Empty where a sign is unsure.
template <class Number>
std::optional<OnRung> TryPublished(const ExactProblem& problem, const Request& request,
                                   ExactDependentRows& rows, Rung rung) {
  thread_local PublishedAlgorithm<Ball<Number>> algorithm;
  EnclosedRows<Number> dependent(rows);
  algorithm.request() = request;
  algorithm.KnowDependentRows(kAsksForDependentRows<Number> ? &dependent : nullptr);
  Trace<Ball<Number>> trace;
  trace.keep_pivots = rung != Rung::kDouble;
  try {
    OnRung run = {algorithm.Run(Converted<Ball<Number>>(problem, &BallAround<Number>), &trace), rung, true};
    if (run.verdict.outcome != Outcome::kSolved)
      for (const Pivot<Ball<Number>>& pivot : trace.pivots)
        run.pivots.push_back(Converted<double>(pivot, &Approximation<Ball<Number>>::Of));
    return run;
  } catch (const UnsureSign&) {
    return std::nullopt;
  }
}

}  // namespace

OnRung RunPublishedFiltered(const ExactProblem& problem, const Request& request, const Rungs& rungs) {
  const Remainder<Rational> remainder(problem);
  if (!remainder.Obstacle().empty()) {
    return {{Outcome::kSingular, remainder.Obstacle()}, Rung::kExact};
  }
  const ExactProblem& remaining = remainder.problem();
  ExactDependentRows rows(remaining);
  if (rungs.first == Rung::kDouble) {
    if (auto run = TryPublished<double>(remaining, request, rows, Rung::kDouble)) return *std::move(run);
  }
  std::optional<OnRung> run;
  if (rungs.first < Rung::kExact && Rung::kDoubleDouble <= rungs.last)
    run = TryPublished<dd_real>(remaining, request, rows, Rung::kDoubleDouble);
  if (!run && rungs.first < Rung::kExact && Rung::kExact == rungs.last)
    run = TryPublished<LongFloat>(remaining, request, rows, Rung::kExact);
  if (run) {
    if (&remaining != &problem) run->pivots.clear();  // in other rows
    return *std::move(run);
  }
  if (rungs.last != Rung::kExact || !rungs.with_rationals)
    return {{Outcome::kUndecided, kUnsureSign}, rungs.last};
  PublishedAlgorithm<Rational> algorithm(request);
  return {algorithm.Run(remaining), Rung::kExact};
}

// ---- Complete driving, rung after rung -------------------------------------------------------------

namespace {

// The mode of a cell by its name (solver/complete/cells.h).
Mode ModeNamed(char cell) {
  switch (cell) {
    case 'B':
      return Mode::kBreak;
    case 'S':
      return Mode::kStick;
    case '+':
      return Mode::kSlipMinus;  // fF = mu fN
    case '-':
      return Mode::kSlipPlus;
    default:
      return Mode::kTouch;
  }
}

// The modes of the cells that complete driving names, a letter each; empty where it names none.
std::optional<ModeWord> WordNamed(const ExactProblem& problem, std::string_view cells) {
  if (cells.size() != problem.contacts.size()) return std::nullopt;
  ModeWord word;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_held = problem.contacts[i].kind == ContactKind::kBilateral;
    word.push_back(is_held ? Mode::kHold : ModeNamed(cells[i]));
  }
  return word;
}

// Empty where a sign is unsure, or the last word has no solution that is verified.
template <class Number>
std::optional<ExactAnswer> TryComplete(const ExactProblem& problem, const Limits& limits,
                                       DependentRows* dependent) {
  thread_local CompleteDriving<Ball<Number>> driving;
  driving.request().limits = limits;
  driving.KnowDependentRows(dependent);
  ExactAnswer answer;
  try {
    answer = AnswerOf<Rational>(driving.Run(Converted<Ball<Number>>(problem, &BallAround<Number>)));
  } catch (const UnsureSign&) {
    return std::nullopt;
  }
  if (!answer.Solved()) return std::nullopt;
  answer.word = driving.Word();
  ExactAnswer solution =
      SolveWord(problem, *WordNamed(problem, answer.word), std::vector<Rational>(problem.rows(), 0));
  if (!solution.Solved()) return std::nullopt;
  answer.f = std::move(solution.f);
  answer.a = std::move(solution.a);
  return answer;
}

}  // namespace

ExactAnswer RunCompleteFiltered(const ExactProblem& problem, const Limits& limits) {
  const auto exactly = [&] {
    ExactAnswer answer = Solve(problem, {.method = "complete", .limits = limits});
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
    if (!answer) {
      rung = Rung::kExact;
      answer = TryComplete<LongFloat>(remainder.problem(), limits, &dependent);
    }
  }
  if (!answer) return exactly();
  answer->f = remainder.Forces(answer->f);
  if (answer->a.size() != problem.rows()) answer->a = Accelerations(problem, answer->f);
  answer->word = remainder.Word(answer->word);
  answer->method = "complete";
  answer->rung = rung;
  return *std::move(answer);
}

// ---- What doubles end in ---------------------------------------------------------------------------

namespace {

// The middle of what is enclosed, judged; empty where it is too far from the law to be told as a solution.
std::optional<InexactAnswer> TellEnclosed(const ContactProblem<double>& rounded,
                                          const Answer<NarrowBall>& solution, double bound,
                                          InexactAnswer answer) {
  answer.f = MiddleOf(solution.f);
  JudgeAnswer(rounded, bound, answer);
  if (!answer.Solved()) return std::nullopt;
  answer.a = MiddleOf(solution.a);
  answer.f_enclosed = EndsOf(solution.f);
  answer.a_enclosed = EndsOf(solution.a);
  answer.arithmetic = Arithmetic::kFiltered;
  answer.rung = Rung::kDouble;
  return answer;
}

ExactAnswer TellExactly(const InexactAnswer& run, ExactAnswer answer, const std::string& word) {
  answer.method = run.method;
  answer.counters = run.counters;
  answer.first_f = ExactVector::Constant(answer.f.size(), Rational(0));
  answer.word = word;
  answer.arithmetic = Arithmetic::kFiltered;
  answer.rung = Rung::kExact;
  return answer;
}

}  // namespace

CertifiedAnswer CertifyDoubles(std::string_view method, const ExactProblem& problem, const Request& request) {
  constexpr int kWords = 16;
  std::optional<ContactProblem<double>> rounded;
  try {
    rounded = Rounded<double>(problem);
  } catch (const RangeError&) {
    return {};
  }
  Request by_method = request;
  by_method.method = method;
  const InexactAnswer run = Solve(*rounded, by_method);
  if (!run.Solved()) return {};
  const double bound = ResidualOf<double>(request);
  const auto enclosed = [&](const std::optional<ModeWord>& word) -> CertifiedAnswer {
    if (!word) return {};
    const auto solution = EncloseWord(*rounded, *word);
    auto told = solution.Solved() ? TellEnclosed(*rounded, solution, bound, run) : std::nullopt;
    return told ? CertifiedAnswer(*std::move(told)) : CertifiedAnswer();
  };
  const auto exactly = [&](ExactAnswer exact, const std::string& word) -> CertifiedAnswer {
    return exact.Solved() ? CertifiedAnswer(TellExactly(run, std::move(exact), word)) : CertifiedAnswer();
  };
  const auto word = WordNamed(problem, run.word);
  const ScaledProblem scaled = MakeScaled(problem, *rounded);
  std::vector<double> point;
  for (const double x : run.f) point.push_back(x / ToDouble(scaled.force));
  std::set<ModeWord> tried;
  return InTurn<CertifiedAnswer>(
      {[&] { return enclosed(word); },
       [&] {
         return word ? exactly(SolveWord(problem, *word, std::vector<Rational>(problem.rows(), 0)), run.word)
                     : CertifiedAnswer();
       },
       [&] { return enclosed(WordsByRank(problem, scaled, point).Next()); },
       [&] { return exactly(SolveNear(problem, scaled, point, kWords, tried), ""); }},
      [](const CertifiedAnswer& answer) { return !std::holds_alternative<std::monostate>(answer); },
      [](const CertifiedAnswer&, const CertifiedAnswer&) { return false; });
}

}  // namespace stiction
