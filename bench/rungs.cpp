// SPDX-License-Identifier: Apache-2.0
#include "bench/rungs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/exact/quad.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/intervals.h"
#include "corpus/rounded.h"
#include "corpus/stopwatch.h"
#include "solver/problem/gate.h"

namespace stiction {
namespace {

// What is called solved claims no less than this, whatever is asked for less.
constexpr double kMargin = 1 + 1e-9;  // rounding of the claim itself

template <class Scalar>
std::optional<ContactProblem<Scalar>> TryRounded(const ExactProblem& problem) {
  try {
    return Rounded<Scalar>(problem);
  } catch (const RangeError&) {
    return std::nullopt;
  }
}

// A number as the sum of doubles.
template <class Scalar>
Rational Exactly(Scalar x) {
  Rational sum = 0;
  for (int part = 0; part < 4 && x != 0; ++part) {
    const double high = static_cast<double>(x);
    if (!std::isfinite(high)) break;
    sum += Rational(high);
    x -= Scalar(high);
  }
  return sum;
}

template <class Scalar>
RungAnswer Told(const Answer<Scalar>& answer, double seconds, double bound) {
  RungAnswer told;
  told.outcome = answer.outcome;
  told.seconds = seconds;
  told.bound = bound;
  if (answer.Solved()) told.f = answer.f.unaryExpr([](const Scalar& x) { return Exactly(x); });
  return told;
}

template <class Scalar>
RungAnswer CallOver(const ContactProblem<Scalar>& problem, const std::string& method) {
  const Stopwatch watch;
  const Answer<Scalar> answer = Solve(problem, method);
  return Told(answer, watch.Seconds(), kSolvedResidual<Scalar>);
}

RungAnswer CallExactly(const ExactProblem& problem, const std::string& method) {
  const Stopwatch watch;
  const Answer<Rational> answer = Solve(problem, method);
  RungAnswer told;
  told.seconds = watch.Seconds();
  told.outcome = answer.outcome;
  if (answer.Solved()) told.f = answer.f;
  return told;
}

RungAnswer CallFiltered(const ExactProblem& problem, const std::string& method) {
  const Stopwatch watch;
  const Solution solution = SolveIn(problem, {.method = method, .arithmetic = Arithmetic::kFiltered});
  RungAnswer told;
  told.seconds = watch.Seconds();
  told.outcome = solution.outcome();
  told.decided_on = solution.rung;
  if (told.outcome != Outcome::kSolved) return told;
  if (const auto* exact = std::get_if<ExactAnswer>(&solution.answer)) {
    told.f = exact->f;
  } else {
    told.f = std::get<InexactAnswer>(solution.answer).f.unaryExpr([](double x) { return Rational(x); });
    told.bound = kSolvedResidual<double>;
  }
  return told;
}

// ---- Remedies ------------------------------------------------------------------------------------

// A power of two for each contact that brings its diagonal near 1; one for both rows, so that mu stays.
std::vector<double> ScalesOf(const ContactProblem<double>& problem) {
  std::vector<double> scales;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const int size = contact.HasFrictionRows() ? 2 : 1;
    const double most = problem.A.diagonal().segment(row, size).maxCoeff();
    const double scale = most > 0 ? std::ldexp(1.0, -std::ilogb(most) / 2) : 1;
    scales.insert(scales.end(), size, scale);
    row += size;
  }
  return scales;
}

// f = D f' of the problem with D A D and D b.
Answer<double> SolveScaled(const ContactProblem<double>& problem, const std::string& method) {
  const std::vector<double> scales = ScalesOf(problem);
  const Eigen::Map<const Eigen::VectorXd> D(scales.data(), static_cast<Eigen::Index>(scales.size()));
  ContactProblem<double> scaled = problem;
  scaled.A = D.asDiagonal() * problem.A * D.asDiagonal();
  scaled.b = D.asDiagonal() * problem.b;
  Answer<double> answer = Solve(scaled, method);
  answer.f = answer.f.size() == D.size() ? Eigen::VectorXd(D.asDiagonal() * answer.f) : answer.f;
  JudgeAnswer(problem, kSolvedResidual<double>, answer);
  return answer;
}

// What others add to a singular A: here 1e-10 of its largest diagonal entry.
Answer<double> SolveRegularized(const ContactProblem<double>& problem, const std::string& method) {
  ContactProblem<double> definite = problem;
  const double largest = problem.rows() > 0 ? problem.A.diagonal().maxCoeff() : 0;
  definite.A.diagonal().array() += 1e-10 * largest;
  Answer<double> answer = Solve(definite, method);
  JudgeAnswer(problem, kSolvedResidual<double>, answer);
  return answer;
}

// One step: the equations of the cells where the answer ended, for the residual in long double.
Answer<double> SolveRefined(const ContactProblem<double>& problem, const std::string& method) {
  Answer<double> answer = Solve(problem, method);
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) return answer;
  const LongVector a = Recompute(problem, answer.f.cast<long double>());
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  // Forces that press and rest are unknown, as their numbers tell.
  const Scale<double> scale = MakeScale(problem, Tolerances{});
  std::vector<IndexSet> sets(problem.rows(), IndexSet::kSeparating);
  for (int i = 0; i < layout.ContactCount(); ++i) {
    const int row = layout.NormalRowOf(i);
    if (!(answer.f[row] > scale.force)) continue;
    sets[row] = IndexSet::kClamped;
    if (!layout.HasFriction(row)) continue;
    const double bound = problem.contacts[i].mu * answer.f[row], slack = bound - std::abs(answer.f[row + 1]);
    const IndexSet limit = answer.f[row + 1] > 0 ? IndexSet::kAtUpper : IndexSet::kAtLower;
    sets[row + 1] = slack > scale.force ? IndexSet::kSticking : limit;
  }
  ContactProblem<double> rest = problem;
  rest.b = a.cast<double>();
  using System = DirectionSystem<double, Eigen::Dynamic>;
  System system;
  system.Start(rest);
  const SetUnknowns<double, Eigen::Dynamic> unknowns{rest, layout, sets};
  if (system.SolveForces(rest, unknowns, scale) != System::Status::kRegular) return answer;
  Answer<double> refined = answer;
  refined.f += system.df();
  JudgeAnswer(problem, kSolvedResidual<double>, refined);
  return refined.residual() < answer.residual() ? refined : answer;
}

RungAnswer CallWith(Remedy remedy, const ContactProblem<double>& problem, const std::string& method) {
  const auto solve = remedy == Remedy::kScaled    ? &SolveScaled
                     : remedy == Remedy::kRefined ? &SolveRefined
                                                  : &SolveRegularized;
  const Stopwatch watch;
  const Answer<double> answer = solve(problem, method);
  return Told(answer, watch.Seconds(), kSolvedResidual<double>);
}

constexpr std::array<const char*, 4> kRemedyNames = {"", " scaled", " refined", " regularized"};

Json QuartilesJson(const std::vector<double>& values, double unit) {
  if (values.empty()) return nullptr;
  const Quartiles q = QuartilesOf(values);
  return {q.low * unit, q.median * unit, q.high * unit};
}

}  // namespace

// ---- Problems ------------------------------------------------------------------------------------

RungProblem::RungProblem(ExactProblem problem)
    : exact_(std::move(problem)), float_(TryRounded<float>(exact_)), double_(TryRounded<double>(exact_)) {
  if (float_) given_[kFloat] = Unrounded(*float_);
  if (double_) given_[kDouble] = Unrounded(*double_);
}

RungProblem::Data RungProblem::DataOf(Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::kFloat) return kFloat;
  return arithmetic == Arithmetic::kFiltered || arithmetic == Arithmetic::kExact ? kAsItIs : kDouble;
}

const ExactProblem& RungProblem::Given(Arithmetic arithmetic) const {
  const Data data = DataOf(arithmetic);
  return data == kAsItIs ? exact_ : given_[data];
}

Outcome RungProblem::PublishedEnd(Arithmetic arithmetic) const {
  auto& end = ends_[DataOf(arithmetic)];
  if (!end) end = PublishedAlgorithm<Rational>().Run(Given(arithmetic)).outcome;
  return *end;
}

double ExactResidual(const ExactProblem& problem, const ExactProblem::Vector& f) {
  return ToDouble(MeasureErrors(problem, FrictionLaw::kCoulomb, f, Accelerations(problem, f)).Largest());
}

// ---- Rows ----------------------------------------------------------------------------------------

std::string RungRow::Name() const {
  return std::string(stiction::Name(arithmetic)) + kRemedyNames[static_cast<int>(remedy)];
}

RungAnswer RungRow::Run(const RungProblem& problem, int repeats) const {
  RungAnswer answer = RunOnce(problem);
  for (int k = 1; k < repeats; ++k) answer.seconds = std::min(answer.seconds, RunOnce(problem).seconds);
  return answer;
}

RungAnswer RungRow::RunOnce(const RungProblem& problem) const {
  if (arithmetic == Arithmetic::kExact) return CallExactly(problem.exact(), method);
  if (arithmetic == Arithmetic::kFiltered) return CallFiltered(problem.exact(), method);
  const bool in_range =
      arithmetic == Arithmetic::kFloat ? problem.in_float().has_value() : problem.in_double().has_value();
  if (!in_range) return {.refused = true};
  if (remedy != Remedy::kNone) return CallWith(remedy, *problem.in_double(), method);
  switch (arithmetic) {
    case Arithmetic::kFloat:
      return CallOver(*problem.in_float(), method);
    case Arithmetic::kDouble:
      return CallOver(*problem.in_double(), method);
    case Arithmetic::kLongDouble:
      return CallOver(
          Converted<long double>(*problem.in_double(), [](double x) { return static_cast<long double>(x); }),
          method);
    default:
      return CallOver(Converted<Quad>(*problem.in_double(), [](double x) { return Quad(x); }), method);
  }
}

std::vector<RungRow> RungRows(bool remedies) {
  using enum Arithmetic;
  std::vector<RungRow> rows;
  for (const char* method : {"complete", "lemke", "fast", "baraff"}) {
    for (const Arithmetic arithmetic : {kFloat, kDouble, kLongDouble, kQuad, kFiltered, kExact}) {
      if (Refusal(method, 2, arithmetic).empty()) rows.push_back({method, arithmetic});
      if (!remedies || arithmetic != kDouble) continue;
      for (const Remedy remedy : {Remedy::kScaled, Remedy::kRefined, Remedy::kRegularized})
        rows.push_back({method, arithmetic, remedy});
    }
  }
  return rows;
}

// ---- Tallies -------------------------------------------------------------------------------------

bool RungTally::Count(const RungRow& row, const RungProblem& problem, const RungAnswer& answer,
                      bool has_solution) {
  ++problems;
  refused += answer.refused;
  if (answer.refused) return false;
  seconds.push_back(answer.seconds);
  if (answer.decided_on) ++decided_on[static_cast<int>(*answer.decided_on)];
  const bool open = answer.outcome == Outcome::kUndecided || answer.outcome == Outcome::kLimit;
  undecided += open;
  other += !open && answer.outcome != Outcome::kSolved;
  bool is_silent = answer.outcome == Outcome::kNoSolution && has_solution;
  if (answer.outcome == Outcome::kSolved) {
    ++solved;
    const double residual = ExactResidual(problem.Given(row.arithmetic), *answer.f);
    residuals.push_back(residual);
    is_silent = !(residual <= answer.bound * kMargin);
  }
  silent += is_silent;
  const bool differs =
      row.method == "baraff" && !open && answer.outcome != problem.PublishedEnd(row.arithmetic);
  wrong += is_silent || differs;
  return is_silent;
}

void RungTally::Merge(const RungTally& more) {
  problems += more.problems;
  solved += more.solved;
  undecided += more.undecided;
  other += more.other;
  refused += more.refused;
  wrong += more.wrong;
  silent += more.silent;
  for (int i = 0; i < kRungCount; ++i) decided_on[i] += more.decided_on[i];
  seconds.insert(seconds.end(), more.seconds.begin(), more.seconds.end());
  residuals.insert(residuals.end(), more.residuals.begin(), more.residuals.end());
}

Json RungTally::ToJson() const {
  const Interval of_wrong = ShareInterval(wrong, problems - refused),
                 of_silent = ShareInterval(silent, problems - refused);
  Json json = {{"problems", problems},
               {"solved", solved},
               {"undecided", undecided},
               {"other", other},
               {"refused", refused},
               {"wrong", wrong},
               {"wrong_share", {of_wrong.low, of_wrong.high}},
               {"silent", silent},
               {"silent_share", {of_silent.low, of_silent.high}},
               {"microseconds", QuartilesJson(seconds, 1e6)},
               {"residual", QuartilesJson(residuals, 1)}};
  json["worst_residual"] =
      residuals.empty() ? Json(nullptr) : Json(*std::max_element(residuals.begin(), residuals.end()));
  json["decided_on"] = decided_on;
  return json;
}

}  // namespace stiction
