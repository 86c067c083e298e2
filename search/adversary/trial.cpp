// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/trial.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace stiction {
namespace {

template <class Scalar>
double LargestOf(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& vector) {
  double largest = 0;
  for (const Scalar& x : vector) largest = std::max(largest, std::abs(AsDouble(x)));
  return largest;
}

// The last steps of all drives.
template <class Scalar>
std::vector<const Pivot<Scalar>*> EndsOfDrives(const std::vector<Pivot<Scalar>>& steps) {
  std::vector<const Pivot<Scalar>*> ends;
  for (const Pivot<Scalar>& pivot : steps) {
    if (!ends.empty() && ends.back()->drive == pivot.drive) ends.pop_back();
    ends.push_back(&pivot);
  }
  return ends;
}

template <class Scalar>
double DistanceOf(const Pivot<Scalar>& left, const Pivot<Scalar>& right) {
  int different = 0;
  for (std::size_t i = 0; i < left.sets.size(); ++i) different += left.sets[i] != right.sets[i];
  if (different > 0) return 1 + different;
  double apart = 0;
  for (Eigen::Index i = 0; i < left.f.size(); ++i)
    apart = std::max(apart, std::abs(AsDouble(Scalar(left.f[i] - right.f[i]))));
  const double largest = std::max(LargestOf<Scalar>(left.f), LargestOf<Scalar>(right.f));
  return largest == 0 ? 0 : std::min(1.0, apart / largest);
}

template <class Scalar>
std::optional<double> Distance(Trial<Scalar>& trial) {
  if (trial.Loops()) return 0;
  const auto ends = EndsOfDrives(trial.Steps());
  std::optional<double> least;
  for (std::size_t j = 1; j < ends.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const double distance = DistanceOf(*ends[i], *ends[j]);
      if (!least || distance < *least) least = distance;
    }
  }
  return least;
}

template <class Scalar>
std::optional<double> LeastPivot(Trial<Scalar>& trial) {
  std::optional<double> least;
  for (const Pivot<Scalar>& pivot : trial.Steps()) {
    const double diagonal = AsDouble(trial.problem().A(pivot.driven, pivot.driven));
    const double force = std::abs(AsDouble(pivot.df[pivot.driven]));
    const double acceleration = std::abs(AsDouble(pivot.da[pivot.driven]));
    if (diagonal == 0 || force == 0 || acceleration == 0) continue;
    const double relative = acceleration / (force * diagonal);
    if (!least || relative < *least) least = relative;
  }
  return least;
}

template <class Scalar>
std::int64_t Memory(Trial<Scalar>& trial) {
  // By row: how long a chain the force ends that rests there.
  std::vector<std::int64_t> chain(static_cast<std::size_t>(trial.problem().rows()), 0);
  std::int64_t longest = 0;
  for (const Pivot<Scalar>& pivot : trial.Steps()) {
    for (std::size_t row = 0; row < chain.size(); ++row) {
      const bool rests = pivot.sets[row] == IndexSet::kNone && pivot.f[static_cast<Eigen::Index>(row)] != 0;
      if (!rests || static_cast<int>(row) == pivot.driven) chain[row] = 0;
    }
    if (!pivot.gave_up || pivot.f[pivot.limiting] == 0) continue;
    std::int64_t& ended = chain[static_cast<std::size_t>(pivot.limiting)];
    ended = 0;
    ended = 1 + *std::max_element(chain.begin(), chain.end());
    longest = std::max(longest, ended);
  }
  return longest;
}

// visit(value, rate) of every quantity whose sign a condition asks for: where a step begins, and how it changes
// per unit step.
template <class Visit>
void ForEachQuantity(const ExactProblem& problem, const ExactProblem::Vector& f, const ExactProblem::Vector& a,
                     const ExactProblem::Vector& df, const ExactProblem::Vector& da, Visit visit) {
  for (std::size_t contact = 0; contact < problem.contacts.size(); ++contact) {
    const auto n = static_cast<Eigen::Index>(2 * contact), t = n + 1;
    const Rational& mu = problem.contacts[contact].mu;
    visit(f[n], df[n]);
    visit(a[n], da[n]);
    visit(a[t], da[t]);
    visit(Rational(mu * f[n] - f[t]), Rational(mu * df[n] - df[t]));
    visit(Rational(mu * f[n] + f[t]), Rational(mu * df[n] + df[t]));
  }
}

// How much later than s, relative to the later, the next quantity reaches zero. 1 where none does.
double GapOfStep(const ExactProblem& problem, const Pivot<Rational>& before, const Pivot<Rational>& step,
                 bool bounce) {
  if (step.s == 0) return bounce ? 1 : 0;
  double gap = 1;
  int k = 0;
  ForEachQuantity(problem, before.f, before.a, step.df, step.da,
                  [&](const Rational& value, const Rational& rate) {
                    const int contact = k++ / 5;
                    if (value == 0 || sgn(value) == sgn(rate) || rate == 0) return;
                    const Rational zero = -value / rate;
                    if (zero == step.s && contact != step.limiting / 2) gap = 0;
                    if (zero > step.s) gap = std::min(gap, ToDouble((zero - step.s) / zero));
                    if (zero < step.s) gap = std::min(gap, ToDouble((step.s - zero) / step.s));
                  });
  return gap;
}

// Whether the variable that limits a step of length zero limited a step just before: it wants back at once.
// That is how a determinant turns, and no tie.
bool IsBounce(const std::vector<Pivot<Rational>>& steps, std::size_t k) {
  for (std::size_t i = k; i-- > 0 && steps[i].drive == steps[k].drive;) {
    if (steps[i].limiting == steps[k].limiting) return true;
    if (steps[i].s != 0) return false;
  }
  return false;
}

// The least size of what is not zero between two drives, relative to its kind.
double GapOfScan(const ExactProblem& problem, const Pivot<Rational>& end) {
  const double largest_f = LargestOf<Rational>(end.f), largest_a = LargestOf<Rational>(end.a);
  double gap = 1;
  int k = 0;
  ForEachQuantity(problem, end.f, end.a, end.f, end.a, [&](const Rational& value, const Rational&) {
    const bool of_acceleration = k % 5 == 1 || k % 5 == 2;
    ++k;
    const double scale = of_acceleration ? largest_a : largest_f;
    if (value != 0 && scale > 0) gap = std::min(gap, std::abs(ToDouble(value)) / scale);
  });
  return gap;
}

}  // namespace

std::optional<double> DistanceToLoop(InexactTrial& trial) { return Distance(trial); }
std::optional<double> DistanceToLoop(ExactTrial& trial) { return Distance(trial); }
std::optional<double> SmallestPivot(InexactTrial& trial) { return LeastPivot(trial); }
std::optional<double> SmallestPivot(ExactTrial& trial) { return LeastPivot(trial); }

std::int64_t LongestMemory(InexactTrial& trial) { return Memory(trial); }
std::int64_t LongestMemory(ExactTrial& trial) { return Memory(trial); }

std::optional<double> Margin(ExactTrial& trial) {
  if (!trial.Loops()) return std::nullopt;
  const std::int64_t start = trial.Published().start;
  const auto& pivots = trial.Steps();
  double margin = 1;
  for (std::size_t k = 0; k < pivots.size(); ++k) {
    if (pivots[k].drive <= start) continue;
    Pivot<Rational> rest;  // before the first step
    if (k == 0) {
      rest.f = ExactProblem::Vector::Constant(trial.problem().rows(), Rational(0));
      rest.a = trial.problem().b;
    }
    const Pivot<Rational>& before = k == 0 ? rest : pivots[k - 1];
    margin = std::min(margin, GapOfStep(trial.problem(), before, pivots[k], IsBounce(pivots, k)));
    const bool last_of_drive = k + 1 == pivots.size() || pivots[k + 1].drive != pivots[k].drive;
    if (last_of_drive) margin = std::min(margin, GapOfScan(trial.problem(), pivots[k]));
  }
  return margin;
}

std::int64_t LongestNumber(ExactTrial& trial) {
  std::int64_t longest = 0;
  for (const Pivot<Rational>& pivot : trial.Steps()) {
    for (const Rational& x : pivot.f) longest = std::max(longest, Bits(x));
    for (const Rational& x : pivot.a) longest = std::max(longest, Bits(x));
  }
  return longest;
}

std::optional<double> Condition(const ContactProblem<double>& problem) {
  constexpr double kClear = 1e-10;  // of the largest eigenvalue
  if (problem.rows() == 0) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(problem.A, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues().minCoeff(), most = solver.eigenvalues().maxCoeff();
  if (!(least > kClear * most)) return std::nullopt;
  return most / least;
}

}  // namespace stiction
