// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/safety_threshold.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Polynomial.h>
#include <CGAL/Polynomial_traits_d.h>
#include <CGAL/gmpxx.h>
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "certify/claims/safe.h"

namespace stiction {

namespace {

static_assert(std::is_same_v<CGAL::Exact_rational, Rational>, "CGAL computes with the same exact rational");

using enum Mode;
using Polynomial = CGAL::Polynomial<Rational>;

Rational ValueAt(const Polynomial& p, const Rational& x) {
  Rational value = 0;
  for (int k = p.degree(); k >= 0; --k) value = value * x + p[k];
  return value;
}

// Newton's interpolation of values at 0, 1, ....
Polynomial Interpolate(const std::vector<Rational>& values) {
  Polynomial p(Rational(0)), basis(Rational(1));
  for (int point = 0; point < static_cast<int>(values.size()); ++point) {
    const Rational missing = values[point] - ValueAt(p, point);
    p += basis * Polynomial(Rational(missing / ValueAt(basis, point)));
    basis *= Polynomial(Rational(-point), Rational(1));
  }
  return p;
}

// For mu = 0, 1, ..., as many as a polynomial needs whose degree is the number of slips in the word.
template <class Function>
auto ValuesOverMu(ExactProblem problem, const ModeWord& word, const Function& value) {
  const auto is_slip = [](Mode mode) { return mode == kSlipPlus || mode == kSlipMinus; };
  std::vector<decltype(value(problem, word))> values;
  for (int point = 0; point <= std::ranges::count_if(word, is_slip); ++point) {
    for (auto& contact : problem.contacts) contact.mu = point;
    values.push_back(value(problem, word));
  }
  return values;
}

// det R(word).
Polynomial DeterminantPolynomial(const ExactProblem& problem, const ModeWord& word) {
  return Interpolate(ValuesOverMu(problem, word, ReducedDeterminant));
}

// The first coefficient of det(R(word) + eps I) that is not zero for all mu. The last is 1.
Polynomial LimitPolynomial(const ExactProblem& problem, const ModeWord& word) {
  const Polynomial determinant = DeterminantPolynomial(problem, word);
  if (!determinant.is_zero()) return determinant;
  const auto coefficients = ValuesOverMu(problem, word, [](const ExactProblem& at, const ModeWord& w) {
    return ShiftedDeterminant(ReducedMatrix(at, w));
  });
  for (std::size_t k = 1;; ++k) {
    std::vector<Rational> values;
    for (const auto& of_point : coefficients) values.push_back(of_point[k]);
    const Polynomial p = Interpolate(values);
    if (!p.is_zero()) return p;
  }
}

// Distinct real roots of a polynomial that is not zero, counted by Sturm's theorem.
class SturmChain {
 public:
  explicit SturmChain(const Polynomial& p) : chain_{CGAL::make_square_free(p)} {
    Polynomial next = CGAL::differentiate(chain_[0]);
    while (!next.is_zero()) {
      chain_.push_back(next);
      Polynomial quotient, remainder;
      Polynomial::euclidean_division(chain_[chain_.size() - 2], next, quotient, remainder);
      next = -remainder;
    }
  }

  const Polynomial& square_free() const { return chain_[0]; }
  // Low is not a root or is left out, high is counted.
  int RootsIn(const Rational& low, const Rational& high) const { return Variations(low) - Variations(high); }

 private:
  int Variations(const Rational& x) const {
    int variations = 0, last = 0;
    for (const Polynomial& p : chain_) {
      const int sign = sgn(ValueAt(p, x));
      if (sign * last < 0) ++variations;
      if (sign != 0) last = sign;
    }
    return variations;
  }

  std::vector<Polynomial> chain_;  // the square-free part, its derivative, minus the remainders
};

// The smallest positive root: low < root <= high, no other positive root <= high.
struct FirstRoot {
  SturmChain chain;
  Rational low, high;

  void Halve() {
    const Rational middle = (low + high) / 2;
    (chain.RootsIn(low, middle) > 0 ? high : low) = middle;
  }
};

// Requires: p has a root in (0, high].
FirstRoot IsolateFirstRoot(SturmChain chain, const Rational& high) {
  FirstRoot root = {std::move(chain), 0, high};
  while (root.chain.RootsIn(root.low, root.high) > 1) root.Halve();
  return root;
}

bool IsSmaller(FirstRoot left, FirstRoot right) {
  const Polynomial common = CGAL::gcd(left.chain.square_free(), right.chain.square_free());
  const Rational low = std::max(left.low, right.low), high = std::min(left.high, right.high);
  // A common root where both intervals overlap is the only root of either in its interval.
  if (low < high && SturmChain(common).RootsIn(low, high) > 0) return false;
  while (left.low < right.high && right.low < left.high) {
    left.Halve();
    right.Halve();
  }
  return left.high <= right.low;
}

// A power of two above all roots (Cauchy). Requires: p is not zero.
Rational RootBound(const Polynomial& p) {
  Rational largest = 0, bound = 1;
  for (int k = 0; k < p.degree(); ++k) largest = std::max(largest, Rational(abs(p[k] / p.lcoeff())));
  while (bound <= 1 + largest) bound *= 2;
  return bound;
}

bool IsPositiveAboveZero(const Polynomial& p) {
  for (int k = 0; k <= p.degree(); ++k) {
    if (p[k] != 0) return p[k] > 0;
  }
  return false;
}

SafetyThreshold MakeThreshold(const ModeWord& word, const Polynomial& p) {
  return {word, std::vector<Rational>(p.begin(), p.end()), 0, 0};
}

// The rational number with the smallest denominator in [low, high]. Requires: 0 <= low < high.
Rational SimplestBetween(const Rational& low, const Rational& high) {
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), low.get_num_mpz_t(), low.get_den_mpz_t());
  if (low == floor) return low;
  if (floor + 1 <= high) return floor + 1;
  return floor + 1 / SimplestBetween(1 / (high - floor), 1 / (low - floor));
}

// Narrows the interval, and makes it a point if the root is the simplest number in it.
void Refine(SafetyThreshold& threshold, FirstRoot root) {
  while (root.high - root.low > Rational(1, 1 << 20)) root.Halve();
  const Rational simplest = SimplestBetween(root.low, root.high);
  const bool is_root = simplest > root.low && ValueAt(root.chain.square_free(), simplest) == 0;
  threshold.low = is_root ? simplest : root.low;
  threshold.high = is_root ? simplest : root.high;
}

using PolynomialOfWord = Polynomial(const ExactProblem&, const ModeWord&);

std::optional<SafetyThreshold> FirstThreshold(const ExactProblem& problem, PolynomialOfWord& polynomial) {
  RequireSafetyDecidable(problem);
  ExactProblem rough = problem;  // mu = 1: a static contact has all its modes
  for (auto& contact : rough.contacts) contact.mu = contact.HasFrictionRows() ? 1 : 0;
  if (Completions(rough, 0) > kMaxSafetyWords) {
    throw InputError(fmt::format("safe: more than {} words", kMaxSafetyWords));
  }
  std::optional<SafetyThreshold> threshold;
  std::optional<FirstRoot> smallest;
  for (const ModeWord& word : AllWords(rough)) {
    const Polynomial p = polynomial(rough, word);
    if (!IsPositiveAboveZero(p)) return MakeThreshold(word, p);
    const Rational bound = smallest ? smallest->high : RootBound(p);
    SturmChain chain(p);
    if (chain.RootsIn(0, bound) == 0) continue;
    FirstRoot root = IsolateFirstRoot(std::move(chain), bound);
    if (smallest && !IsSmaller(root, *smallest)) continue;
    threshold = MakeThreshold(word, p);
    smallest = std::move(root);
  }
  if (smallest) Refine(*threshold, *smallest);
  return threshold;
}

}  // namespace

std::optional<SafetyThreshold> FindSafetyThreshold(const ExactProblem& problem) {
  return FirstThreshold(problem, DeterminantPolynomial);
}

std::optional<SafetyThreshold> FindLimitThreshold(const ExactProblem& problem) {
  return FirstThreshold(problem, LimitPolynomial);
}

}  // namespace stiction
