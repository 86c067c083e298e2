// SPDX-License-Identifier: Apache-2.0
#include "solver/numeric/body_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stiction {
namespace {

constexpr double kFirstEps = 1e-2, kLeastEps = 1e-7;
constexpr int kHalvings = 6;  // of a step that does not make R smaller

}  // namespace

RunEnd<> BodyNewton::Run(const Problem& problem, const Vector* start) {
  Start(problem, start);
  constexpr int kIdle = 3;                          // points that gain nothing before a solution is good enough
  const int most = start != nullptr ? 10 : points;  // before a start is too far off
  constexpr double kHopeless = 1e4;
  eps_ = start != nullptr ? warm_eps : kFirstEps;
  // The error of a start may cost as much as a step.
  const auto offer_start = [this] {
    if (best_.f().size() != center_.size()) best_.Offer(center_);
  };
  if (start == nullptr || measures_start) offer_start();
  double mark = best_.error();
  int idle = 0, failures = 0;
  while (!(best_.error() <= aim)) {
    const bool is_good = best_.IsGood();
    if (is_good && best_.IsRounding()) break;
    if (request_.limits.Stopped() && !is_good) {
      offer_start();
      verdict_.reason = kStopped;
      return verdict_;
    }
    if (request_.limits.Stopped()) break;
    const std::int64_t tried = verdict_.statistics[Counter::kPoints];
    if (tried == points || eps_ > kHopeless || idle >= (is_good ? kIdle : most)) {
      if (is_good) break;
      verdict_.reason = eps_ > kHopeless ? "Newton's method settles for no eps" : "too many proximal points";
      return verdict_;
    }
    ++verdict_.statistics[Counter::kPoints];
    const Vector v = v_;
    if (!Settle()) {
      offer_start();
      if (++failures > this->failures) {
        verdict_.reason = "Newton's method settles too rarely";
        return verdict_;
      }
      v_ = v;
      eps_ = std::max(3 * eps_, kFirstEps);  // of a start, too, which is far off then
      continue;
    }
    ++idle;
    center_ = f_;
    eps_ = std::max(std::min(kLeastEps, eps_), eps_ / 10);
    if (!(best_.Offer(f_) < mark / 2)) continue;
    mark = best_.error();
    idle = 0;
  }
  verdict_.outcome = Outcome::kSolved;
  return verdict_;
}

void BodyNewton::Start(const Problem& problem, const Vector* start) {
  problem_ = &problem;
  verdict_ = {.statistics = {Counter::kPoints, Counter::kNewtonSteps, Counter::kFactorizations}};
  is_factored_ = false;
  best_.Start(problem, request_, measure);
  matrix_.Take(problem);
  near_.resize(matrix_.widest());
  if (start != nullptr) {
    center_ = *start;
  } else {
    center_.setZero(problem.rows());
  }
  f_ = center_;
  v_ = problem.w + problem.Responses(f_);
}

// Solves the proximal problem of center_ from v_ on; false if Newton's method does not come to rest. It does
// where R is rounding, and where it no longer falls on a piece that is linear, or nearly.
bool BodyNewton::Settle() {
  const double rounding = 64 * std::numeric_limits<double>::epsilon(), small = 1e-9;
  Evaluate();
  if (R_.size() == 0) return true;  // there are no velocities: f_ is all that it can be
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= steps; ++step) {
    const double now = R_.cwiseAbs().maxCoeff();
    if (now <= rounding * size_ || (now <= small * size_ && !(now < before / 2))) return true;
    if (step == steps) break;
    before = now;
    ++verdict_.statistics[Counter::kNewtonSteps];
    if (request_.limits.Stopped() || !Factor()) break;
    Backtrack(matrix_.Solve(R_));
    if (!v_.allFinite()) break;
  }
  return false;
}

// v_ less the step, or less a part of it that makes R smaller; where none of some does, less the last of them.
void BodyNewton::Backtrack(const Vector& step) {
  const Vector from = v_;
  const double norm = R_.norm();
  double part = 1;
  for (int halvings = 0;; ++halvings, part /= 2) {
    v_ = from - part * step;
    Evaluate();
    if (halvings == kHalvings || R_.norm() <= (1 - part / 1000) * norm) return;
  }
}

// f_, slopes_ and R_ of v_.
void BodyNewton::Evaluate() {
  const auto& pieces = matrix_.pieces();
  slopes_.resize(pieces.size());
  f_.resize(problem_->rows());
  symmetric_ = true;
  R_ = problem_->M * (v_ - problem_->w);
  size_ = R_.size() > 0 ? R_.cwiseAbs().maxCoeff() : 0;
  largest_.assign(near_.size(), 0);
  for (std::size_t c = 0; c < pieces.size(); ++c) {
    const BodyMatrix::Piece& piece = pieces[c];
    const auto columns = matrix_.columns(piece);
    const double* J = matrix_.entries(piece);
    const double slope = 1 / (eps_ * matrix_.own(static_cast<int>(c)));
    const int width = piece.columns;
    for (int k = 0; k < width; ++k) near_[k] = v_[columns[k]];
    std::array<double, 3> p{};
    for (int i = 0; i < piece.rows; ++i) {
      double a = problem_->c[piece.row + i];
      for (int k = 0; k < width; ++k) a += J[i * width + k] * near_[k];
      p[i] = center_[piece.row + i] - a * slope;
    }
    symmetric_ &= ProjectOnLaw(problem_->contacts[c], piece.rows, p.data(), &f_[piece.row], slopes_[c]);
    for (auto& line : slopes_[c]) {
      for (double& x : line) x *= slope;
    }
    if (f_[piece.row] == 0) continue;  // and with it its friction
    std::fill(near_.begin(), near_.begin() + width, 0);
    for (int i = 0; i < piece.rows; ++i) {
      const double force = f_[piece.row + i];
      for (int k = 0; k < width; ++k) {
        const double part = J[i * width + k] * force;
        near_[k] += part;
        largest_[k] = std::max(largest_[k], std::abs(part));
      }
    }
    for (int k = 0; k < width; ++k) R_[columns[k]] -= near_[k];
  }
  for (const double part : largest_) size_ = std::max(size_, part);
}

bool BodyNewton::Factor() {
  if (is_factored_ && eps_ == factored_eps_ && slopes_ == factored_) return true;
  ++verdict_.statistics[Counter::kFactorizations];
  is_factored_ = matrix_.Factor(slopes_, symmetric_);
  factored_eps_ = eps_;
  factored_ = slopes_;
  return is_factored_;
}

}  // namespace stiction
