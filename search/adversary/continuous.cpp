// SPDX-License-Identifier: Apache-2.0
// NLopt on what is nearly continuous.
//
// Coordinates: the choices of a candidate whose range is wide (WideChoices), each as a number in [0, 1] that is
// rounded to an integer of its range; and, where friction is to be lowered, mu from a quarter of the
// candidate's to all of it. So every point of the cube is a valid exact problem. The narrow choices (numbers of
// columns, kinds, places) stay those of the candidate. Global methods and local ones take turns, each from
// another candidate.
//
// What NLopt is told    the value, or where there is none a penalty of 1e15 and 1e9 times the distance to a
//                       loop. Never a NaN, which it would take. Exceptions are kept and thrown again outside:
//                       it loses their text.
// Random numbers        nlopt::srand, of this thread, before every start.

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <nlopt.hpp>
#include <stdexcept>

#include "search/adversary/optimizer.h"

namespace stiction {
namespace {

constexpr std::array<nlopt::algorithm, 4> kMethods = {nlopt::GN_CRS2_LM, nlopt::LN_SBPLX, nlopt::GN_ESCH,
                                                      nlopt::LN_NELDERMEAD};
constexpr std::size_t kMostCoordinates = 64;

class Cube {
 public:
  Cube(Attempt& attempt, const Assessed& from) : attempt_(attempt), from_(from), wide_(WideChoices(from.made)) {
    if (wide_.size() > kMostCoordinates) wide_.resize(kMostCoordinates);
    lowers_ = attempt.optimization().objective->lowers_friction && from.candidate.mu.numerator > 0 &&
              from.worth.value;
  }

  std::size_t coordinates() const { return wide_.size() + (lowers_ ? 1 : 0); }

  std::vector<double> Start() const {
    std::vector<double> x;
    for (const std::size_t i : wide_) {
      const Choice& choice = from_.made[i];
      x.push_back(static_cast<double>(choice.value - choice.low) /
                  static_cast<double>(choice.high - choice.low));
    }
    if (lowers_) x.push_back(1);
    return x;
  }

  double Value(const std::vector<double>& x) {
    const Assessed assessed = attempt_.Look(At(x));
    const Worth worth = assessed.worth;
    attempt_.Admit(assessed);
    if (worth.value) return *worth.value;
    return -1e15 + 1e9 * std::max(worth.nearness, -1e3);
  }
  bool Ended() const { return attempt_.Ended(); }

  std::exception_ptr error;

 private:
  Candidate At(const std::vector<double>& x) const {
    Candidate candidate = from_.candidate;
    for (std::size_t k = 0; k < wide_.size(); ++k) {
      const Choice& choice = from_.made[wide_[k]];
      const double span = static_cast<double>(choice.high - choice.low);
      candidate.choices[wide_[k]] =
          std::clamp<std::int64_t>(choice.low + std::llround(x[k] * span), choice.low, choice.high);
    }
    if (lowers_) {
      constexpr int kParts = 1 << 10;
      const auto part = std::clamp<std::int64_t>(std::llround(x.back() * kParts), 0, kParts);
      const Rational mu = Rational(candidate.mu.numerator) / Rational(candidate.mu.denominator) *
                          Rational(kParts + 3 * part) / Rational(4 * kParts);
      candidate.mu = SimplestNear(mu, candidate.mu, LargestMuPart(candidate.generator));
    }
    return candidate;
  }

  Attempt& attempt_;
  const Assessed from_;
  std::vector<std::size_t> wide_;
  bool lowers_ = false;
};

double CubeValue(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  (void)gradient;  // none of the methods asks for one
  Cube& cube = *static_cast<Cube*>(data);
  if (cube.Ended()) throw nlopt::forced_stop();
  try {
    return cube.Value(x);
  } catch (...) {
    cube.error = std::current_exception();
    throw nlopt::forced_stop();
  }
}

void Optimize(Attempt& attempt, nlopt::algorithm method, const Assessed& from, std::int64_t evaluations) {
  Cube cube(attempt, from);
  nlopt::srand(static_cast<unsigned long>(attempt.random().Integer(1, (std::int64_t{1} << 31) - 1)));
  nlopt::opt nlopt(method, static_cast<unsigned>(cube.coordinates()));
  nlopt.set_lower_bounds(0.0);
  nlopt.set_upper_bounds(1.0);
  nlopt.set_max_objective(CubeValue, &cube);
  nlopt.set_maxeval(static_cast<int>(std::min<std::int64_t>(evaluations, 1 << 30)));
  nlopt.set_xtol_abs(1e-6);
  nlopt.set_initial_step(0.1);
  std::vector<double> x = cube.Start();
  double value = 0;
  try {
    nlopt.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {  // the best so far is in the elites
  } catch (const nlopt::forced_stop&) {
    if (cube.error) std::rethrow_exception(cube.error);
  } catch (const std::runtime_error&) {  // a failure of the method: another has its turn
  }
}

}  // namespace

Optimized OptimizeContinuously(const Optimization& optimization) {
  Attempt attempt(optimization);
  attempt.Begin();
  const std::int64_t each = std::max<std::int64_t>(200, optimization.evaluations / 16);
  for (std::size_t turn = 0; !attempt.Ended(); ++turn) {
    const Assessed from = turn % 2 == 0 ? attempt.Draw() : attempt.Best();
    const std::int64_t before = attempt.Left();
    if (Cube(attempt, from).coordinates() > 0)
      Optimize(attempt, kMethods[turn % kMethods.size()], from, std::min(each, attempt.Left()));
    if (attempt.Left() == before) attempt.Try(attempt.Random());
  }
  return attempt.Take();
}

}  // namespace stiction
