// SPDX-License-Identifier: Apache-2.0
// A problem as an arithmetic rounds it, which is another problem than that of the file.
//
// Proofs are of the file. An exact method may be run on rounded numbers too, and then it answers with an
// InexactAnswer, which is never called exact or proved: `no-solution` of a rounded problem is `undecided` of
// the file. Where rounding changed nothing the rounded problem is that of the file.

#ifndef STICTION_CERTIFY_REQUEST_ROUNDED_PROBLEM_H_
#define STICTION_CERTIFY_REQUEST_ROUNDED_PROBLEM_H_

#include <optional>
#include <string>
#include <utility>

#include "certify/exact/inexact.h"
#include "certify/exact/solve.h"
#include "corpus/rational.h"
#include "corpus/rounded.h"

namespace stiction {

template <class Scalar>
class RoundedProblem {
 public:
  // Of a file; RangeError for a number that the scalar does not hold.
  explicit RoundedProblem(const ExactProblem& file) : numbers_(Rounded<Scalar>(file)) {
    if (!IsSame(file)) changed_ = file;
  }
  // Of numbers that nobody rounded.
  explicit RoundedProblem(ContactProblem<Scalar> numbers) : numbers_(std::move(numbers)) {}

  const ContactProblem<Scalar>& numbers() const { return numbers_; }
  bool IsFile() const { return !changed_; }
  // The problem of the file, of which proofs are.
  ExactProblem File() const { return changed_ ? *changed_ : Unrounded(numbers_); }

  // An exact method, run on the rounded numbers.
  InexactAnswer RunExactly(const Request& request, double bound) const {
    const ExactAnswer exact = SolveExactly(Unrounded(numbers_), request);
    InexactAnswer told = Told(exact, request.arithmetic, bound);
    if (exact.outcome != Outcome::kNoSolution || IsFile()) return told;
    told.outcome = Outcome::kUndecided;
    told.reason = "the problem, rounded to " + std::string(Name(request.arithmetic)) +
                  ", has no solution, which proves nothing of the file; --arithmetic exact decides it";
    return told;
  }

  // An exact answer in these numbers: its forces are rounded, and judged.
  InexactAnswer Told(const ExactAnswer& exact, Arithmetic arithmetic, double bound) const {
    const auto convert = [](const Rational& x) {
      return static_cast<double>(static_cast<Scalar>(ToDouble(x)));
    };
    InexactAnswer told;
    told.outcome = exact.outcome;
    told.reason = exact.reason;
    told.start = exact.start;
    told.period = exact.period;
    told.method = exact.method;
    told.arithmetic = arithmetic;
    told.law = exact.law;
    told.word = exact.word;
    told.counters = exact.counters;
    told.f = exact.f.unaryExpr(convert);
    told.a = exact.a.unaryExpr(convert);
    told.ray = exact.ray.unaryExpr(convert);
    told.first_f = exact.first_f.unaryExpr(convert);
    for (const auto& pivot : exact.pivots) told.pivots.push_back(Converted<double>(pivot, convert));
    if (exact.f.size() == numbers_.rows()) JudgeInDoubles(bound, told);
    return told;
  }

 private:
  bool IsSame(const ExactProblem& file) const {
    const auto same = [](const Rational& x, Scalar y) { return x == Rational(static_cast<double>(y)); };
    for (int j = 0; j < file.rows(); ++j) {
      if (!same(file.b[j], numbers_.b[j])) return false;
      for (int i = 0; i < file.rows(); ++i)
        if (!same(file.A(i, j), numbers_.A(i, j))) return false;
    }
    for (std::size_t i = 0; i < file.contacts.size(); ++i) {
      const auto& contact = file.contacts[i];
      const auto& rounded = numbers_.contacts[i];
      if (!same(contact.mu, rounded.mu) || !same(contact.slip[0], rounded.slip[0]) ||
          !same(contact.slip[1], rounded.slip[1]))
        return false;
    }
    return true;
  }

  // Forces of float are held to what float tells.
  void JudgeInDoubles(double bound, InexactAnswer& told) const {
    if constexpr (std::is_same_v<Scalar, float>) {
      Answer<float> narrow;
      narrow.outcome = told.outcome;
      narrow.law = told.law;
      narrow.f = told.f.template cast<float>();
      JudgeAnswer(numbers_, bound, narrow);
      told.outcome = narrow.outcome;
      if (!narrow.reason.empty()) told.reason = narrow.reason;
      told.f = narrow.f.template cast<double>();
      told.a = narrow.a.template cast<double>();
      told.errors = narrow.errors;
    } else {
      const auto doubles = Converted<double>(numbers_, [](const Scalar& x) { return static_cast<double>(x); });
      JudgeAnswer(doubles, bound, told);
    }
  }

  ContactProblem<Scalar> numbers_;
  std::optional<ExactProblem> changed_;  // that of the file, where rounding changed it
};

}  // namespace stiction

#endif  // STICTION_CERTIFY_REQUEST_ROUNDED_PROBLEM_H_
