// SPDX-License-Identifier: Apache-2.0
// The best forces that a run of a problem in factors finds: those of the smallest error, the strict one
// (errors.h) with the rounding of accelerations counted in, or the lenient one (lenient.h). A run that measures
// often has A in entries.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/problem/errors.h"
#include "solver/problem/forms.h"
#include "solver/problem/lenient.h"
#include "solver/problem/options.h"

namespace stiction {

// Shapes  f, a = A f + b: rows x 1. Memory is kept between problems.
class BestForces {
 public:
  using Problem = FactoredProblem<double>;
  using Vector = Eigen::VectorXd;

  enum class Measure : std::uint8_t { kStrict, kLenient };

  // Of the request residual and noise are read. Both outlive what follows.
  void Start(const Problem& problem, const Request& request, Measure measure) {
    problem_ = &problem;
    request_ = &request;
    measure_ = measure;
    offers_ = 0;
    Forget();
  }
  void Forget() {
    error_ = std::numeric_limits<double>::infinity();
    is_rounding_ = false;
    f_.resize(0);
    a_.resize(0);
  }

  // The error of f; what is better than all before is kept, and so is the first.
  double Offer(const Vector& f) {
    now_ = problem_->A.J() * (problem_->w + problem_->Responses(f)) + problem_->c;
    if (++offers_ == kOften) entries_ = EntriesOf(*problem_);
    const double error = offers_ < kOften ? Measured(*problem_, f) : Measured(entries_, f);
    if (error < error_ || f_.size() != f.size()) {
      error_ = error;
      is_rounding_ = error <= 2 * rounding_;
      f_ = f;
      a_ = now_;
    }
    return error;
  }

  double error() const { return error_; }
  // Whether the best has no error but the rounding of its accelerations: no other forces are better.
  bool IsRounding() const { return is_rounding_; }
  bool IsGood() const { return error_ <= ResidualOf<double>(*request_); }
  const Vector& f() const { return f_; }
  const Vector& a() const { return a_; }

 private:
  static constexpr int kOften = 6;

  template <class AnyForm>
  double Measured(const AnyForm& problem, const Vector& f) {
    rounding_ = 0;
    if (measure_ == Measure::kLenient)
      return MeasureLeniently(problem, FrictionLaw::kCoulomb, f, now_, units_, request_->noise).error;
    told_ = now_.unaryExpr([this](double x) { return std::abs(x) <= request_->noise ? 0 : x; });
    const Errors<double> errors = MeasureErrors(problem, FrictionLaw::kCoulomb, f, told_, meter_,
                                                WorkingTheta<double>(request_->residual, problem.rows()));
    rounding_ = std::numeric_limits<double>::epsilon() * errors.amplification;
    return errors.Largest() + rounding_;
  }

  const Problem* problem_ = nullptr;
  const Request* request_ = nullptr;
  Measure measure_ = Measure::kStrict;
  double error_ = std::numeric_limits<double>::infinity();
  double rounding_ = 0;  // of what was measured last
  bool is_rounding_ = false;
  Vector f_, a_, now_, told_;
  int offers_ = 0;
  SparseContactProblem<double> entries_;
  ErrorMeter<double> meter_;
  LenientUnits<double> units_;
};

}  // namespace stiction
