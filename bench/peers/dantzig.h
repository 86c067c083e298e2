// SPDX-License-Identifier: Apache-2.0
// What ODE, DART and Bullet share: A x = b + w by rows of a given stride, bounds, a friction index; the data of
// a call are destroyed by it.
//
// findex   solved first are the rows without a friction index. When the first of the others has its turn, the
//          bounds of all are set to mu abs(fN) with the normal forces of that moment, and stay, whatever these
//          become. In space a contact has two such rows, each with its own bounds: a pyramid.
// cfm      constraint force mixing: what is added to the diagonal, as a part of its largest entry.

#pragma once

#include <algorithm>
#include <limits>

#include "bench/peers/contender.h"

namespace stiction {

// Thrown where a library finds one of its own checks broken, and would end the program.
struct BrokenCheck {};

class DantzigContender : public Contender {
 public:
  explicit DantzigContender(bool friction, double cfm = 0) : friction_(friction), cfm_(cfm) {}

  void Load(const std::vector<PeerProblem>& problems) override {
    rows_ = problems.front().rows();
    const int stride = Stride(rows_);
    loaded_.assign(problems.size(), {});
    for (std::size_t k = 0; k < problems.size(); ++k) LoadOne(problems[k], stride, cfm_, loaded_[k]);
    A_.resize(static_cast<std::size_t>(rows_) * stride);
    for (auto* values : {&x_, &b_, &w_, &low_, &high_}) values->resize(rows_);
    index_.resize(rows_);
  }

  Eigen::VectorXd Forces() const override { return Eigen::Map<const Eigen::VectorXd>(x_.data(), rows_); }

 protected:
  struct Loaded {
    std::vector<double> A, b, low, high;
    std::vector<int> index;
  };

  virtual int Stride(int rows) const = 0;

  void Restore(int k) {
    const Loaded& from = loaded_[k];
    std::copy(from.A.begin(), from.A.end(), A_.begin());
    std::copy(from.b.begin(), from.b.end(), b_.begin());
    std::copy(from.low.begin(), from.low.end(), low_.begin());
    std::copy(from.high.begin(), from.high.end(), high_.begin());
    if (friction_) std::copy(from.index.begin(), from.index.end(), index_.begin());
  }
  int* FrictionIndex() { return friction_ ? index_.data() : nullptr; }

  bool friction_;
  double cfm_;
  int rows_ = 0;
  std::vector<Loaded> loaded_;
  std::vector<double> A_, x_, b_, w_, low_, high_;
  std::vector<int> index_;

 private:
  static void LoadOne(const PeerProblem& problem, int stride, double cfm, Loaded& to) {
    const int rows = problem.rows();
    const double mixed = cfm * problem.A.diagonal().maxCoeff();
    to.A.assign(static_cast<std::size_t>(rows) * stride, 0.0);
    to.low.assign(rows, 0.0);
    to.high.assign(rows, std::numeric_limits<double>::infinity());
    to.index.assign(rows, -1);
    for (int i = 0; i < rows; ++i) {
      to.b.push_back(-problem.b[i]);
      for (int j = 0; j < rows; ++j) to.A[static_cast<std::size_t>(i) * stride + j] = problem.A(i, j);
      to.A[static_cast<std::size_t>(i) * stride + i] += mixed;
    }
    int row = 0;
    for (const auto& contact : problem.contacts) {
      const int normal = row++;
      if (contact.kind == ContactKind::kBilateral) to.low[normal] = -std::numeric_limits<double>::infinity();
      if (!contact.HasFrictionRows()) continue;
      for (int k = 1; k < problem.dimension; ++k, ++row) {
        to.low[row] = -contact.mu;
        to.high[row] = contact.mu;
        to.index[row] = normal;
      }
    }
  }
};

}  // namespace stiction
