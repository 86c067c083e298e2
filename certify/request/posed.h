// SPDX-License-Identifier: Apache-2.0
// Posed: a problem as it is put to methods, in the numbers that they take: exact, as that of a file, of which
// proofs are, and rounded. What is asked for is made once.

#pragma once

#include <optional>
#include <utility>

#include "certify/request/quad.h"
#include "corpus/exact_problem.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "corpus/stopwatch.h"

namespace stiction {

// Whether rounding changed nothing. Shapes fit.
template <class Scalar>
bool IsRoundedExactly(const ExactProblem& file, const ContactProblem<Scalar>& rounded) {
  const auto same = [](const Rational& x, const Scalar& y) { return x == Rational(static_cast<double>(y)); };
  for (int j = 0; j < file.rows(); ++j) {
    if (!same(file.b[j], rounded.b[j])) return false;
    for (int i = 0; i < file.rows(); ++i)
      if (!same(file.A(i, j), rounded.A(i, j))) return false;
  }
  for (std::size_t i = 0; i < file.contacts.size(); ++i) {
    const auto& mine = file.contacts[i];
    const auto& other = rounded.contacts[i];
    if (!same(mine.mu, other.mu) || !same(mine.slip[0], other.slip[0]) || !same(mine.slip[1], other.slip[1]))
      return false;
  }
  return true;
}

class Posed {
 public:
  // Of a file: `watch` starts anew once its problem is rounded.
  explicit Posed(AnyProblem file, Stopwatch* watch = nullptr) : file_(std::move(file)), watch_(watch) {}
  // Of doubles that nobody rounded, which outlive it.
  explicit Posed(const ContactProblem<double>& doubles) : given_(&doubles) {}

  int dimension() const { return given_ != nullptr ? given_->dimension : file_->dimension(); }
  int rows() const { return given_ != nullptr ? given_->rows() : file_->rows(); }
  // Null where it did not come in factors.
  const ExactFactors* factors() const { return file_ ? file_->factors() : nullptr; }
  // Whether A stays as it is, since all of it is a burden.
  bool StaysSparse() const { return keeps_sparse_ || (file_ && stiction::StaysSparse(*file_)); }
  void KeepSparse() { keeps_sparse_ = true; }

  const AnyProblem& file() {
    if (!file_) file_ = Unrounded(*given_);
    return *file_;
  }
  // RangeError for a number that the scalar does not hold.
  const ContactProblem<double>& doubles() {
    if (given_ != nullptr) return *given_;
    if (!doubles_) doubles_ = RoundedTo<double>();
    return *doubles_;
  }
  template <class Scalar>
  ContactProblem<Scalar> RoundedTo() {
    ContactProblem<Scalar> rounded = Rounded<Scalar>(file());
    if (watch_ != nullptr) *std::exchange(watch_, nullptr) = Stopwatch();
    return rounded;
  }

 private:
  std::optional<AnyProblem> file_;
  std::optional<ContactProblem<double>> doubles_;
  const ContactProblem<double>* given_ = nullptr;
  Stopwatch* watch_ = nullptr;
  bool keeps_sparse_ = false;
};

}  // namespace stiction
