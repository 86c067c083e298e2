// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/nearby_words.h"

#include <algorithm>
#include <cmath>

#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/linear/elimination.ipp"
#include "solver/problem/check.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

using enum Mode;

// The largest magnitude, 1 if all are zero; what the values were rounded to tells most of it.
template <class Values, class RoundedValues>
Rational Largest(const Values& values, const RoundedValues& rounded) {
  const Rational* largest = nullptr;
  double most = 0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const Rational& value = values.data()[k];
    const double magnitude = std::abs(rounded.data()[k]);
    if (magnitude < most || value == 0) continue;
    if (largest == nullptr || magnitude > most || abs(value) > abs(*largest)) largest = &value;
    most = magnitude;
  }
  return largest == nullptr ? Rational(1) : Rational(abs(*largest));
}

}  // namespace

ScaledProblem MakeScaled(const ExactProblem& problem) {
  const Rational A_unit = Largest(problem.A, Eigen::MatrixXd(problem.A.unaryExpr(&ToDouble))),
                 b_unit = Largest(problem.b, Eigen::VectorXd(problem.b.unaryExpr(&ToDouble)));
  for (const auto& contact : problem.contacts) {
    if (!std::isfinite(ToDouble(contact.mu)))
      throw InputError("mu: found " + Shortened(ToString(contact.mu)) + ", expected a finite double for ipopt");
  }
  const auto in_units = [](const Rational& unit) {
    return [&unit](const Rational& x) { return ToDouble(x / unit); };
  };
  return {{problem.dimension, Converted<double>(problem.contacts, &ToDouble),
           problem.A.unaryExpr(in_units(A_unit)), problem.b.unaryExpr(in_units(b_unit))},
          b_unit / A_unit};
}

ScaledProblem MakeScaled(const ExactProblem& problem, const ContactProblem<double>& rounded) {
  const Rational A_unit = Largest(problem.A, rounded.A), b_unit = Largest(problem.b, rounded.b);
  return {{problem.dimension, rounded.contacts, rounded.A / ToDouble(A_unit), rounded.b / ToDouble(b_unit)},
          b_unit / A_unit};
}

// ---- Words near a point --------------------------------------------------------------------------

namespace {

// A second mode of a contact is tried if the point breaks its conditions by no more than this, on a scale where
// the largest entries of A and b are 1. Wide, since at a degenerate solution Ipopt's accuracy is a root of its
// tolerance, and near a singular A worse; the order and number of words bound what this costs.
constexpr double kNear = 0.1;

double ConditionsBroken(Mode mode, double mu, double slip, double f_n, double f_t, double a_n, double a_t) {
  const double negative = std::max(-f_n, 0.0);
  switch (mode) {
    case kHold:
      return std::abs(a_n);
    case kBreak:
      return std::abs(f_n) + std::abs(f_t) + std::max(-a_n, 0.0);
    case kTouch:
      return negative + std::abs(a_n) + std::abs(f_t + mu * slip * f_n);
    case kStick:
      return std::abs(a_n) + std::abs(a_t) + std::max(std::abs(f_t) - mu * f_n, 0.0);
    case kSlipPlus:
      return negative + std::abs(a_n) + std::abs(f_t + mu * f_n) + std::max(-a_t, 0.0);
    case kSlipMinus:
      return negative + std::abs(a_n) + std::abs(f_t - mu * f_n) + std::max(a_t, 0.0);
  }
  STICTION_FAIL("no such mode");
}

// By contact, best first: the best mode and those that are near.
std::vector<std::vector<RankedMode>> RankModes(const ExactProblem& problem, const ScaledProblem& scaled,
                                               const std::vector<double>& f) {
  Eigen::VectorXd a = scaled.numbers.b;
  for (int i = 0; i < a.size(); ++i) {
    for (int j = 0; j < a.size(); ++j) a[i] += scaled.numbers.A(i, j) * f[j];
  }
  std::vector<std::vector<RankedMode>> ranked;
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const bool rough = contact.HasFrictionRows();
    auto& modes = ranked.emplace_back();
    for (const Mode mode : ModesOf(contact)) {
      const auto& [kind, mu, slip] = scaled.numbers.contacts[i];
      modes.emplace_back(
          ConditionsBroken(mode, mu, slip[0], f[row], rough ? f[row + 1] : 0, a[row], rough ? a[row + 1] : 0),
          mode);
    }
    std::ranges::stable_sort(modes, {}, &RankedMode::first);
    while (modes.size() > 1 && modes.back().first > kNear) modes.pop_back();
    row += rough ? 2 : 1;
  }
  return ranked;
}

}  // namespace

WordsByRank::WordsByRank(const ExactProblem& problem, const ScaledProblem& scaled, const std::vector<double>& f)
    : modes_(RankModes(problem, scaled, f)) {
  Push(std::vector<int>(modes_.size(), 0));
}

std::optional<ModeWord> WordsByRank::Next() {
  if (waiting_.empty()) return std::nullopt;
  const std::vector<int> ranks = waiting_.top().second;
  waiting_.pop();
  ModeWord word;
  for (std::size_t i = 0; i < ranks.size(); ++i) word.push_back(modes_[i][ranks[i]].second);
  // Every word is reached once: by raising ranks from the first contact to the last.
  for (std::size_t i = ranks.size(); i-- > 0;) {
    if (ranks[i] + 1 < static_cast<int>(modes_[i].size())) {
      std::vector<int> raised = ranks;
      ++raised[i];
      Push(std::move(raised));
    }
    if (ranks[i] > 0) break;
  }
  return word;
}

void WordsByRank::Push(std::vector<int> ranks) {
  double sum = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) sum += modes_[i][ranks[i]].first;
  waiting_.emplace(sum, std::move(ranks));
}

// ---- The equations of a word ---------------------------------------------------------------------

namespace {

constexpr int kLiftedSize = 16;    // of equations, from which on lifting costs less than elimination
constexpr int kEnclosedSize = 64;  // of equations, beyond which balls grow too wide

// A force that a word leaves open, x (e_row + f_t e_(row + 1)); in return a_row = 0.
template <class Scalar>
struct Unknown {
  int row;
  Scalar f_t;
};

// M x = right: nothing accelerates that the word holds.
template <class Scalar>
struct WordEquations {
  using Problem = ContactProblem<Scalar>;

  WordEquations(const Problem& problem, const ModeWord& word) {
    ForEachContact(problem, [&](int i, int row, int) {
      const auto& contact = problem.contacts[i];
      Scalar f_t(0);
      if (word[i] == kSlipPlus) f_t = -contact.mu;
      if (word[i] == kSlipMinus) f_t = contact.mu;
      if (word[i] == kTouch && contact.kind == ContactKind::kSliding) f_t = -contact.mu * contact.slip[0];
      if (word[i] != kBreak) unknowns.push_back({row, f_t});
      if (word[i] == kStick) unknowns.push_back({row + 1, Scalar(0)});
    });
    const int size = static_cast<int>(unknowns.size());
    M.resize(size, size);
    right.resize(size);
    for (int i = 0; i < size; ++i) {
      const int of = unknowns[i].row;
      right[i] = -problem.b[of];
      for (int j = 0; j < size; ++j) {
        const auto& [at, f_t] = unknowns[j];
        M(i, j) = problem.A(of, at);
        if (!IsSurelyZero(f_t)) M(i, j) += f_t * problem.A(of, at + 1);
      }
    }
  }

  typename Problem::Vector Forces(int rows, const typename Problem::Vector& x) const {
    typename Problem::Vector f = Problem::Vector::Constant(rows, Scalar(0));
    for (int j = 0; j < x.size(); ++j) {
      const auto& [at, f_t] = unknowns[j];
      f[at] += x[j];
      if (!IsSurelyZero(f_t)) f[at + 1] += f_t * x[j];
    }
    return f;
  }

  std::vector<Unknown<Scalar>> unknowns;
  typename Problem::Matrix M;
  typename Problem::Vector right;
};

}  // namespace

Answer<Rational> SolveWord(const ExactProblem& problem, const ModeWord& word,
                           const std::vector<Rational>& near) {
  const WordEquations<Rational> equations(problem, word);
  const int size = static_cast<int>(equations.unknowns.size());
  ExactVector guess(size);
  for (int i = 0; i < size; ++i) guess[i] = near[equations.unknowns[i].row];
  const auto solve = size < kLiftedSize ? &SolveEquations : &SolveByLifting;
  for (const ExactVector& free : {ExactVector(ExactVector::Zero(size)), guess}) {
    const auto x = solve(equations.M, equations.right, free);
    if (!x) break;
    Answer<Rational> solution;
    solution.f = equations.Forces(problem.rows(), *x);
    solution.a = Accelerations(problem, solution.f);
    if (FindViolation(problem, solution.f, solution.a)) continue;
    solution.outcome = Outcome::kSolved;
    return solution;
  }
  return {};
}

// ---- The same, enclosed --------------------------------------------------------------------------

namespace {

// Whether whatever the ends of f and a enclose meets the law in the mode, whose equations it solves.
bool MeetsMode(const Contact<NarrowBall>& contact, Mode mode, int row, const Answer<NarrowBall>::Vector& f,
               const Answer<NarrowBall>::Vector& a) {
  if (mode == kHold) return true;
  const auto may_be_negative = [](const NarrowBall& x) { return !x.TellsSign() || x.Sign() < 0; };
  if (may_be_negative(mode == kBreak ? a[row] : f[row])) return false;
  if (mode == kSlipPlus) return !may_be_negative(a[row + 1]);
  if (mode == kSlipMinus) return !may_be_negative(-a[row + 1]);
  if (mode != kStick) return true;
  const NarrowBall limit = contact.mu * f[row];
  return !may_be_negative(limit - f[row + 1]) && !may_be_negative(limit + f[row + 1]);
}

bool MeetsWord(const ContactProblem<NarrowBall>& problem, const ModeWord& word,
               const Answer<NarrowBall>& solution) {
  int row = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (!MeetsMode(problem.contacts[i], word[i], row, solution.f, solution.a)) return false;
    row += problem.contacts[i].HasFrictionRows() ? 2 : 1;
  }
  return true;
}

// Numbers that were rounded once, relative to themselves.
ContactProblem<NarrowBall> AroundRounded(const ContactProblem<double>& rounded) {
  return Converted<NarrowBall>(
      rounded, [](double x) { return NarrowBall(x, x == 0 ? 0 : Rounding<double>::OfProduct(x)); });
}

}  // namespace

Answer<NarrowBall> EncloseWord(const ContactProblem<double>& rounded, const ModeWord& word) {
  const ContactProblem<NarrowBall> problem = AroundRounded(rounded);
  const WordEquations<NarrowBall> equations(problem, word);
  const int size = static_cast<int>(equations.unknowns.size()), rows = problem.rows();
  if (size > kEnclosedSize) return {};
  ContactProblem<NarrowBall>::Matrix augmented(size, size + 1);
  augmented.leftCols(size) = equations.M;
  augmented.col(size) = equations.right;
  Answer<NarrowBall>::Vector x(size);
  try {
    Elimination<NarrowBall> elimination;
    elimination.Assign(augmented);
    elimination.Run(size, size, size + 1);
    if (elimination.rank() < size) return {};
    elimination.BackSubstitute(size);
    for (int j = 0; j < size; ++j) x[j] = elimination.Solution(j);
  } catch (const UnsureSign&) {
    return {};
  }
  Answer<NarrowBall> solution;
  solution.f = equations.Forces(rows, x);
  solution.a = problem.b;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j)
      if (!IsSurelyZero(solution.f[j])) solution.a[i] += problem.A(i, j) * solution.f[j];
  for (const auto& unknown : equations.unknowns) solution.a[unknown.row] = NarrowBall();
  if (MeetsWord(problem, word, solution)) solution.outcome = Outcome::kSolved;
  return solution;
}

// ---- Words near a point, solved ------------------------------------------------------------------

namespace {

constexpr double kPlaces = 0x1p20;

// Multiples of 1 / kPlaces, so that their numbers are short; in the units of the problem.
std::vector<Rational> Shortened(const std::vector<double>& f, const Rational& unit) {
  std::vector<Rational> rounded;
  for (const double x : f) rounded.push_back(Rational(std::round(x * kPlaces) / kPlaces) * unit);
  return rounded;
}

}  // namespace

Answer<Rational> SolveNear(const ExactProblem& problem, const ScaledProblem& scaled,
                           const std::vector<double>& f, int words, std::set<ModeWord>& tried) {
  Answer<Rational> answer;
  std::int64_t solved = 0;
  if (static_cast<int>(f.size()) != problem.rows()) return answer;  // a run that could not begin
  if (!std::all_of(f.begin(), f.end(), [](double x) { return std::isfinite(x * kPlaces); })) return answer;
  const std::vector<Rational> near = Shortened(f, scaled.force);
  WordsByRank ranked(problem, scaled, f);
  for (int count = 0; count < words && !answer.Solved(); ++count) {
    const auto word = ranked.Next();
    if (!word) break;
    if (!tried.insert(*word).second) continue;
    ++solved;
    answer = SolveWord(problem, *word, near);
  }
  answer.counters = {{Counter::kWords, solved}};
  return answer;
}

}  // namespace stiction
