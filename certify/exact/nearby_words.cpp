// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/nearby_words.h"

#include <algorithm>
#include <cmath>

#include "certify/exact/lifted_equations.h"
#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using enum Mode;

template <class Values>
Rational Largest(const Values& values) {
  Rational largest = 0;
  for (const Rational& value : values.reshaped()) largest = std::max(largest, Rational(abs(value)));
  return largest == 0 ? Rational(1) : largest;
}

}  // namespace

ScaledProblem MakeScaled(const ExactProblem& problem) {
  const Rational A_unit = Largest(problem.A), b_unit = Largest(problem.b);
  ScaledProblem scaled;
  for (const auto& contact : problem.contacts) {
    scaled.mu.push_back(ToDouble(contact.mu));
    scaled.slip.push_back(ToDouble(contact.slip[0]));
    if (!std::isfinite(scaled.mu.back())) {
      throw InputError("mu: found " + Shortened(ToString(contact.mu)) + ", expected a finite double for ipopt");
    }
  }
  for (int i = 0; i < problem.rows(); ++i) {
    scaled.b.push_back(ToDouble(problem.b[i] / b_unit));
    auto& row = scaled.A.emplace_back();
    for (int j = 0; j < problem.rows(); ++j) row.push_back(ToDouble(problem.A(i, j) / A_unit));
  }
  scaled.force = b_unit / A_unit;
  return scaled;
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
  std::vector<double> a = scaled.b;
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < f.size(); ++j) a[i] += scaled.A[i][j] * f[j];
  }
  std::vector<std::vector<RankedMode>> ranked;
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const bool rough = contact.HasFrictionRows();
    auto& modes = ranked.emplace_back();
    for (const Mode mode : ModesOf(contact)) {
      modes.push_back({mode, ConditionsBroken(mode, scaled.mu[i], scaled.slip[i], f[row],
                                              rough ? f[row + 1] : 0, a[row], rough ? a[row + 1] : 0)});
    }
    std::stable_sort(modes.begin(), modes.end(), [](auto& x, auto& y) { return x.broken < y.broken; });
    while (modes.size() > 1 && modes.back().broken > kNear) modes.pop_back();
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
  for (std::size_t i = 0; i < ranks.size(); ++i) word.push_back(modes_[i][ranks[i]].mode);
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
  for (std::size_t i = 0; i < ranks.size(); ++i) sum += modes_[i][ranks[i]].broken;
  waiting_.emplace(sum, std::move(ranks));
}

// ---- The equations of a word ---------------------------------------------------------------------

namespace {

constexpr int kLiftedSize = 16;  // of equations, from which on lifting costs less than elimination

// A force that a word leaves open, x (e_row + f_t e_(row + 1)); in return a_row = 0.
struct Unknown {
  int row;
  Rational f_t;
};

std::vector<Unknown> UnknownsOf(const ExactProblem& problem, const ModeWord& word) {
  std::vector<Unknown> unknowns;
  int row = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const auto& contact = problem.contacts[i];
    Rational f_t = 0;
    if (word[i] == kSlipPlus) f_t = -contact.mu;
    if (word[i] == kSlipMinus) f_t = contact.mu;
    if (word[i] == kTouch && contact.kind == ContactKind::kSliding) f_t = -contact.mu * contact.slip[0];
    if (word[i] != kBreak) unknowns.push_back({row, f_t});
    if (word[i] == kStick) unknowns.push_back({row + 1, 0});
    row += contact.HasFrictionRows() ? 2 : 1;
  }
  return unknowns;
}

ExactVector Forces(const ExactProblem& problem, const std::vector<Unknown>& unknowns, const ExactVector& x) {
  ExactVector f = ExactVector::Constant(problem.rows(), Rational(0));
  for (int j = 0; j < x.size(); ++j) {
    f[unknowns[j].row] += x[j];
    if (unknowns[j].f_t != 0) f[unknowns[j].row + 1] += unknowns[j].f_t * x[j];
  }
  return f;
}

}  // namespace

std::optional<ExactVector> SolveWord(const ExactProblem& problem, const ModeWord& word,
                                     const std::vector<Rational>& near) {
  const std::vector<Unknown> unknowns = UnknownsOf(problem, word);
  const int size = static_cast<int>(unknowns.size());
  ExactMatrix M(size, size);
  ExactVector right(size), guess(size);
  for (int i = 0; i < size; ++i) {
    const int row = unknowns[i].row;
    right[i] = -problem.b[row];
    guess[i] = near[row];
    for (int j = 0; j < size; ++j) {
      M(i, j) = problem.A(row, unknowns[j].row);
      if (unknowns[j].f_t != 0) M(i, j) += unknowns[j].f_t * problem.A(row, unknowns[j].row + 1);
    }
  }
  const auto solve = size < kLiftedSize ? &SolveEquations : &SolveByLifting;
  for (const ExactVector& free : {ExactVector(ExactVector::Zero(size)), guess}) {
    const auto x = solve(M, right, free);
    if (!x) return std::nullopt;
    ExactVector f = Forces(problem, unknowns, *x);
    if (!FindViolation(problem, f)) return f;
  }
  return std::nullopt;
}

namespace {

constexpr double kPlaces = 0x1p20;

// Multiples of 1 / kPlaces, so that their numbers are short; in the units of the problem.
std::vector<Rational> Shortened(const std::vector<double>& f, const Rational& unit) {
  std::vector<Rational> rounded;
  for (const double x : f) rounded.push_back(Rational(std::round(x * kPlaces) / kPlaces) * unit);
  return rounded;
}

}  // namespace

NearbyWords SolveNear(const ExactProblem& problem, const ScaledProblem& scaled, const std::vector<double>& f,
                      int words, std::set<ModeWord>& tried) {
  if (static_cast<int>(f.size()) != problem.rows()) return {};  // a run that could not begin
  if (!std::all_of(f.begin(), f.end(), [](double x) { return std::isfinite(x * kPlaces); })) return {};
  const std::vector<Rational> near = Shortened(f, scaled.force);
  WordsByRank ranked(problem, scaled, f);
  NearbyWords result;
  for (int count = 0; count < words; ++count) {
    const auto word = ranked.Next();
    if (!word) break;
    if (!tried.insert(*word).second) continue;
    ++result.words;
    result.f = SolveWord(problem, *word, near);
    result.is_first = result.f && count == 0;
    if (result.f) break;
  }
  return result;
}

}  // namespace stiction
