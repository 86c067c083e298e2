// SPDX-License-Identifier: Apache-2.0
#include "solver/numeric/interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stiction {
namespace {

constexpr int kSteps = 120, kIdleSteps = 20, kWeakSteps = 6;
constexpr double kJudgeBelow = 1e-6;  // tau from which on forces are judged
constexpr double kLeastTau = 1e-28;
constexpr int kPatience = 6;  // attempts after which what is loose has to do
constexpr double kFinishEps = 0.1, kPolishEps = 1e-4;
constexpr int kFactorsOfCurve = 800;  // at most
constexpr int kFinishSteps = 12, kFinishFailures = 2, kLastFailures = 20, kPolishFailures = 1,
              kPolishPoints = 12;

}  // namespace

// The first ends nearly all, the second some of the rest, and a curve most of what is left. After the last the
// curves follow again, with other weights.
const std::array<InteriorPoint::Attempt, InteriorPoint::kTurnCount> InteriorPoint::kTurns = {{
    {},
    {.delta = 1e-6, .first = 0.1, .spread = 0.5},
    {.delta = 1e-7, .first = 10, .spread = 0.5, .kappa = 10, .curve = true},
    {.delta = 1e-7, .spread = 0.5, .curve = true},
    {.curve = true},
    {.delta = 1e-7, .kappa = 1, .curve = true},
    {.first = 100, .spread = 0.5, .kappa = 1, .curve = true},
    {.step = 0.95, .delta = 1e-7, .spread = 1, .kappa = 100, .curve = true},
    {.step = 0.7, .spread = 0.5, .curve = true},
}};

RunEnd<> InteriorPoint::Run(const Problem& problem) {
  problem_ = &problem;
  verdict_ = {.statistics = {Counter::kStarts, Counter::kIterations, Counter::kFactorizations}};
  seed_ = 1;
  matrix_.Take(problem);
  states_.resize(problem.contacts.size());
  D_.resize(states_.size());
  most_b_ = 0;
  for (const auto& piece : matrix_.pieces()) {
    const double own = std::sqrt(matrix_.own(static_cast<int>(&piece - matrix_.pieces().data())));
    for (int i = 0; i < piece.rows; ++i) most_b_ = std::max(most_b_, std::abs(problem.b[piece.row + i]) / own);
  }
  best_.Start(problem, request_, measure);
  best_.Offer(Vector::Zero(problem.rows()));
  is_strict_ = best_.IsGood();
  if (!best_.IsGood()) best_.Forget();  // its error is no measure of others
  const double residual = ResidualOf<double>(request_);
  const int most = MostAttempts();
  f_.setZero(problem.rows());  // for who says stop before there are others
  for (int i = 0; i < most && !request_.limits.Stopped(); ++i) {
    if (best_.error() <= (i < kPatience ? residual : std::max(residual, loose))) break;
    ++verdict_.statistics[Counter::kStarts];
    Begin(kTurns[i < kTurnCount ? i : kFirstTurns + (i - kTurnCount) % (kTurnCount - kFirstTurns)]);
    if (attempt_.curve) FollowCurve();
    if (!(best_.error() <= aim)) Follow();
    Finish(i + 1 == most);
  }
  if (best_.f().size() != problem.rows()) best_.Offer(f_);
  if (best_.IsGood()) {
    verdict_.outcome = Outcome::kSolved;
  } else {
    verdict_.reason =
        request_.limits.Stopped() ? kStopped : "the path of the interior point ends in no solution";
  }
  return verdict_;
}

// Where contacts slide there may be no solution; and large problems are not tried for ever.
int InteriorPoint::MostAttempts() const {
  constexpr int kSliding = 5, kLeast = 6, kRowsInAll = 20000;
  const bool slides = std::ranges::any_of(
      problem_->contacts, [](const auto& contact) { return contact.kind == ContactKind::kSliding; });
  return slides ? kSliding : std::clamp(kRowsInAll / std::max(1, problem_->rows()), kLeast, kAttempts);
}

template <class Visit>
void InteriorPoint::ForEachPair(Visit visit) {
  for (State& state : states_) {
    if (state.kind != ContactKind::kBilateral) visit(state.normal);
    if (state.kind == ContactKind::kStatic) visit(state.slip);
  }
}

// A factor near 1, as often below as above. Sums and quotients alone, which are the same on every machine.
double InteriorPoint::Chance() {
  if (!(attempt_.spread > 0)) return 1;
  double sum = -6;
  for (int i = 0; i < 12; ++i) {
    seed_ = seed_ * 6364136223846793005u + 1442695040888963407u;
    sum += std::ldexp(static_cast<double>(seed_ >> 11), -53);
  }
  const double factor = 1 + attempt_.spread * std::abs(sum);
  return sum < 0 ? 1 / factor : factor;
}

void InteriorPoint::Begin(const Attempt& attempt) {
  attempt_ = attempt;
  end_.resize(0);
  v_ = problem_->w;
  f_.setZero(problem_->rows());
  df_.setZero(problem_->rows());
  pairs_ = 0;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const auto& contact = problem_->contacts[c];
    const auto& piece = matrix_.pieces()[c];
    State& state = states_[c];
    state = {};
    const bool is_smooth = contact.kind == ContactKind::kStatic && !(contact.mu > 0);
    state.kind = is_smooth ? ContactKind::kFrictionless : contact.kind;
    if (state.kind == ContactKind::kBilateral) continue;
    const double own = std::sqrt(matrix_.own(static_cast<int>(c)));
    const double force = attempt.first * most_b_ / own, acceleration = attempt.first * most_b_ * own;
    Pair& normal = state.normal;
    normal.x = f_[piece.row] = force * Chance();
    normal.y = acceleration * Chance();
    normal.weight = normal.x * normal.y;
    ++pairs_;
    for (int i = 1; i < piece.rows && state.kind == ContactKind::kSliding; ++i)
      f_[piece.row + i] = -contact.mu * contact.slip[i - 1] * normal.x;
    if (state.kind != ContactKind::kStatic) continue;
    state.slip.x = acceleration * attempt.kappa * Chance();
    state.slip.y = contact.mu * normal.x / 2;
    state.slip.weight = 2 / contact.mu * state.slip.x * state.slip.y;
    ++pairs_;
  }
}

double InteriorPoint::MeanProduct() {
  double sum = 0;
  ForEachPair([&sum](const Pair& pair) { sum += pair.x * pair.y / pair.weight; });
  return sum / std::max(1, pairs_);
}

// Each contact in the mode that its force and acceleration ask for; a bilateral one keeps its force.
void InteriorPoint::Offer() {
  Vector snapped = f_;
  const Vector a = problem_->A.J() * v_ + problem_->c;
  BodyMatrix::Block slope;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    if (states_[c].kind == ContactKind::kBilateral) continue;
    const auto& piece = matrix_.pieces()[c];
    std::array<double, 3> p{};
    for (int i = 0; i < piece.rows; ++i)
      p[i] = f_[piece.row + i] - a[piece.row + i] / matrix_.own(static_cast<int>(c));
    ProjectOnLaw(problem_->contacts[c], piece.rows, p.data(), &snapped[piece.row], slope);
  }
  best_.Offer(snapped);
  end_ = snapped;
}

// Whether forces are so large that their rounding hides what acts: there is mostly no solution.
bool InteriorPoint::Diverges() const {
  constexpr double kMost = 1e8;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const double force = f_[matrix_.pieces()[c].row] * std::sqrt(matrix_.own(static_cast<int>(c)));
    if (std::abs(force) > kMost * most_b_) return true;
  }
  return false;
}

// The path of the attempt, from where it is to its end.
void InteriorPoint::Follow() {
  constexpr double kFalls = 0.3, kShort = 0.02;
  double mark = std::numeric_limits<double>::infinity();
  int since = 0, weak = 0;
  const int patience = attempt_.curve ? 3 : 1;  // near the end of a curve
  for (int step = 0; step < patience * kSteps && !request_.limits.Stopped(); ++step) {
    const double tau = MeanProduct();
    ++verdict_.statistics[Counter::kIterations];
    if (!std::isfinite(tau) || Diverges()) return;
    if (tau < kFalls * mark) {
      mark = tau;
      since = step;
    }
    if (tau < kJudgeBelow) {
      Offer();
      if (best_.error() <= aim) return;
    }
    if (step - since > patience * kIdleSteps || weak > patience * kWeakSteps || tau < kLeastTau) return;
    TakeResiduals();
    ++verdict_.statistics[Counter::kFactorizations];
    if (!matrix_.Factor(D_, false)) return;
    Aim(0, tau, false);
    if (!SolveStep()) return;
    const double ahead = std::min(1.0, Longest());
    double product = 0;
    ForEachPair([&](Pair& pair) {
      pair.ahead_x = pair.dx;
      pair.ahead_y = pair.dy;
      product += (pair.x + ahead * pair.dx) * (pair.y + ahead * pair.dy) / pair.weight;
    });
    product /= std::max(1, pairs_);
    const double share = std::clamp(product / tau, 0.0, 1.0);
    double sigma = std::max(share * share * share, 1e-3);
    if (ahead < 0.1) sigma = std::max(sigma, 0.3);
    if (weak > 2) sigma = std::max(sigma, 0.5);
    Aim(sigma, tau, ahead > 0.1);
    if (!SolveStep()) return;
    const double length = std::min(1.0, attempt_.step * Longest());
    weak = length < kShort ? weak + 1 : std::max(0, weak - 1);
    if (!(length > 1e-10)) return;
    Move(length);
  }
}

// From the end of the path, or from the best forces where they are a solution, by Newton's method, which is
// exact to rounding where it settles. Another attempt costs less than its patience, but for the last.
void InteriorPoint::Finish(bool is_last) {
  if (best_.f().size() != problem_->rows()) return;
  const bool polishes = best_.IsGood();
  newton_.request() = request_;
  newton_.measure = polishes ? BestForces::Measure::kStrict : measure;
  newton_.steps = kFinishSteps;
  newton_.warm_eps = polishes ? kPolishEps : kFinishEps;
  newton_.failures = polishes ? kPolishFailures : is_last ? kLastFailures : kFinishFailures;
  newton_.points = polishes ? kPolishPoints : BodyNewton::kPoints;
  const Vector start = polishes || end_.size() == 0 ? best_.f() : end_;
  const RunEnd<> end = newton_.Run(*problem_, &start);
  verdict_.statistics[Counter::kFactorizations] += end.statistics[Counter::kFactorizations];
  is_strict_ = polishes && end.outcome == Outcome::kSolved;
  if (is_strict_) best_.Forget();  // better than leniently right
  best_.Offer(newton_.f());
}

// What the equations miss, and D.
void InteriorPoint::TakeResiduals() {
  const Vector a = problem_->A.J() * v_ + problem_->c;
  unbalanced_ = problem_->M * (v_ - problem_->w) - problem_->A.J().transpose() * f_;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    State& state = states_[c];
    const auto& contact = problem_->contacts[c];
    const auto& piece = matrix_.pieces()[c];
    const double *at = &a[piece.row], *force = &f_[piece.row];
    const double delta = attempt_.delta * matrix_.own(static_cast<int>(c));
    BodyMatrix::Block& D = D_[c];
    D = {};
    if (state.kind == ContactKind::kBilateral) {
      D[0][0] = 1 / delta;
      state.miss = -at[0];
      continue;
    }
    state.miss = state.normal.y - at[0];
    D[0][0] = 1 / (state.normal.y / state.normal.x + delta);
    for (int i = 1; i < piece.rows && state.kind == ContactKind::kSliding; ++i)
      D[i][0] = -contact.mu * contact.slip[i - 1] * D[0][0];
    if (state.kind != ContactKind::kStatic) continue;
    const double R = contact.mu * force[0], l = state.slip.x, s = state.slip.y;
    const int tangents = piece.rows - 1;
    double square = 0;
    for (int i = 0; i < tangents; ++i) {
      state.g[i] = force[1 + i] / R;
      square += state.g[i] * state.g[i];
      state.slip_miss[i] = at[1 + i] + l * state.g[i];
    }
    state.slack_miss = s - R / 2 * (1 - square);
    state.length = std::sqrt(square);
    state.e = {1, 0};
    for (int i = 0; i < tangents && state.length > 0; ++i) state.e[i] = state.g[i] / state.length;
    state.give = l / R + delta;
    state.Q = state.give * s + l * square;
    state.along = contact.mu * state.length * l * (s / R + (1 + square) / 2) / state.Q;
    const double along = s / state.Q, across = 1 / state.give;
    for (int i = 0; i < tangents; ++i) {
      D[1 + i][0] = state.along * state.e[i] * D[0][0];
      for (int j = 0; j < tangents; ++j)
        D[1 + i][1 + j] = across * (i == j) + (along - across) * state.e[i] * state.e[j];
    }
  }
}

void InteriorPoint::Aim(double sigma, double tau, bool corrects) {
  ForEachPair([&](Pair& pair) {
    pair.aim = sigma * tau * pair.weight - pair.x * pair.y - (corrects ? pair.ahead_x * pair.ahead_y : 0);
  });
}

// dv, df = q - D J dv, and the changes of the pairs; false if they are no numbers.
bool InteriorPoint::SolveStep() {
  Vector q = Vector::Zero(f_.size());
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const State& state = states_[c];
    const auto& contact = problem_->contacts[c];
    const auto& piece = matrix_.pieces()[c];
    double* at = &q[piece.row];
    at[0] = D_[c][0][0] *
            (state.miss + (state.kind != ContactKind::kBilateral ? state.normal.aim / state.normal.x : 0));
    for (int i = 1; i < piece.rows && state.kind == ContactKind::kSliding; ++i)
      at[i] = -contact.mu * contact.slip[i - 1] * at[0];
    if (state.kind != ContactKind::kStatic) continue;
    const double along_miss = state.slip_miss[0] * state.e[0] + state.slip_miss[1] * state.e[1];
    const double along =
        (-state.slip.y * along_miss - state.length * (state.slip.aim + state.slip.x * state.slack_miss)) /
            state.Q +
        state.along * at[0];
    for (int i = 1; i < piece.rows; ++i)
      at[i] = along * state.e[i - 1] - (state.slip_miss[i - 1] - along_miss * state.e[i - 1]) / state.give;
  }
  dv_ = matrix_.Solve(problem_->A.J().transpose() * q - unbalanced_);
  const Vector da = problem_->A.J() * dv_;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    State& state = states_[c];
    const auto& contact = problem_->contacts[c];
    const auto& piece = matrix_.pieces()[c];
    for (int i = 0; i < piece.rows; ++i) {
      double change = 0;
      for (int j = 0; j < piece.rows; ++j) change += D_[c][i][j] * da[piece.row + j];
      df_[piece.row + i] = q[piece.row + i] - change;
    }
    if (state.kind == ContactKind::kBilateral) continue;
    const double normal = df_[piece.row];
    state.normal.dx = normal;
    state.normal.dy = (state.normal.aim - state.normal.y * normal) / state.normal.x;
    if (state.kind != ContactKind::kStatic) continue;
    double miss = 0, along_a = 0, along_f = 0, by_g = 0;
    for (int i = 1; i < piece.rows; ++i) {
      miss += state.slip_miss[i - 1] * state.e[i - 1];
      along_a += da[piece.row + i] * state.e[i - 1];
      along_f += df_[piece.row + i] * state.e[i - 1];
      by_g += state.g[i - 1] * df_[piece.row + i];
    }
    Pair& slip = state.slip;
    const double R = contact.mu * f_[piece.row], square = state.length * state.length;
    if (slip.x * square > state.give * slip.y) {
      slip.dx = (-miss - along_a - state.give * along_f) / state.length + slip.x * contact.mu / R * normal;
      slip.dy = (slip.aim - slip.y * slip.dx) / slip.x;
    } else {
      slip.dy = (1 + square) / 2 * contact.mu * normal - by_g - state.slack_miss;
      slip.dx = (slip.aim - slip.x * slip.dy) / slip.y;
    }
  }
  return dv_.allFinite() && df_.allFinite();
}

// The part of the step at which the first number of a pair is zero, or friction too far beyond its limit.
double InteriorPoint::Longest() {
  double longest = std::numeric_limits<double>::max();
  ForEachPair([&longest](const Pair& pair) {
    if (pair.dx < 0) longest = std::min(longest, -pair.x / pair.dx);
    if (pair.dy < 0) longest = std::min(longest, -pair.y / pair.dy);
  });
  for (std::size_t c = 0; c < states_.size(); ++c) longest = std::min(longest, LongestInside(c));
  return longest;
}

// Where abs(fF) is some times mu fN, or as many times as far beyond as before: there g, and with it s, is no
// longer what the step takes it for.
double InteriorPoint::LongestInside(std::size_t c) const {
  constexpr double kBeyond = 2;
  const State& state = states_[c];
  if (state.kind != ContactKind::kStatic) return std::numeric_limits<double>::max();
  const double limit = kBeyond * std::max(1.0, state.length) * problem_->contacts[c].mu;
  const auto& piece = matrix_.pieces()[c];
  const double normal = limit * f_[piece.row], change = limit * df_[piece.row];
  // x t^2 + 2 y t + z = 0, z < 0
  double x = -change * change, y = -normal * change, z = -normal * normal;
  for (int i = piece.row + 1; i < piece.row + piece.rows; ++i) {
    x += df_[i] * df_[i];
    y += f_[i] * df_[i];
    z += f_[i] * f_[i];
  }
  const double root = y * y - x * z;
  const double sum = y + std::sqrt(std::max(0.0, root));
  return root >= 0 && sum > 0 ? -z / sum : std::numeric_limits<double>::max();
}

void InteriorPoint::Move(double length) {
  v_ += length * dv_;
  f_ += length * df_;
  ForEachPair([length](Pair& pair) {
    pair.x += length * pair.dx;
    pair.y += length * pair.dy;
  });
  TakeForces();
}

// Of the pairs, and with them those of sliding contacts.
void InteriorPoint::TakeForces() {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const State& state = states_[c];
    const auto& contact = problem_->contacts[c];
    const auto& piece = matrix_.pieces()[c];
    if (state.kind != ContactKind::kBilateral) f_[piece.row] = state.normal.x;
    for (int i = 1; i < piece.rows && state.kind == ContactKind::kSliding; ++i)
      f_[piece.row + i] = -contact.mu * contact.slip[i - 1] * state.normal.x;
  }
}

// ---- The curve -------------------------------------------------------------------------------

// A way from where the path is: the changes of v and f, then those of the numbers of the pairs, x and y in
// turn, and of tau, as parts of themselves. Of the step solved last, with that of tau.
auto InteriorPoint::WayOfStep(double tau) -> Vector {
  Vector way(v_.size() + f_.size() + 2 * pairs_ + 1);
  way.head(v_.size()) = dv_;
  way.segment(v_.size(), f_.size()) = df_;
  Eigen::Index k = v_.size() + f_.size();
  ForEachPair([&way, &k](const Pair& pair) {
    way[k++] = pair.dx / pair.x;
    way[k++] = pair.dy / pair.y;
  });
  way[k] = tau;
  return way;
}

// The parts of the pairs and of tau, by which lengths and angles are measured.
auto InteriorPoint::Relative(const Vector& way) const -> Vector { return way.tail(2 * pairs_ + 1); }

void InteriorPoint::MoveAlong(const Vector& way, double length, double& tau) {
  v_ += length * way.head(v_.size());
  f_ += length * way.segment(v_.size(), f_.size());
  Eigen::Index k = v_.size() + f_.size();
  ForEachPair([&way, &k, length](Pair& pair) {
    pair.x *= 1 + length * way[k++];
    pair.y *= 1 + length * way[k++];
  });
  tau *= 1 + length * way[k];
  TakeForces();
}

// From the beginning of the attempt to the end of the curve, or as far as it can be followed.
void InteriorPoint::FollowCurve() {
  constexpr double kFirst = 0.3, kLongest = 0.8, kShortest = 1e-3;
  double tau = MeanProduct(), length = kFirst;
  Vector tangent;
  for (int left = kFactorsOfCurve; left > 0 && tau >= kLeastTau && !request_.limits.Stopped();) {
    const Vector v = v_, f = f_;
    const std::vector<State> states = states_;
    const double tau_before = tau;
    const bool is_first = tangent.size() == 0;
    if (!is_first) MoveAlong(tangent, length / Relative(tangent).cwiseAbs().maxCoeff(), tau);
    int corrections = 0;
    double cosine = 1;
    if (!ReturnToCurve(tangent, tau, left, corrections, cosine)) {
      v_ = v;
      f_ = f;
      states_ = states;
      tau = tau_before;
      if (is_first || length < kShortest) return;
      length /= 3;
      continue;
    }
    if (corrections <= 3 && cosine > 0.7) {
      length = std::min(kLongest, length * 1.6);
    } else if (corrections > 5 || cosine < 0.3) {
      length /= 1.5;
    }
    if (Diverges()) return;
    if (!(tau < kJudgeBelow)) continue;
    Offer();
    if (best_.error() <= aim) return;
  }
}

// Across the tangent, or at this tau where there is none yet. The tangent is that of the new point then, in the
// direction of the old one, at first to smaller tau; `cosine` is that of the angle between the two.
bool InteriorPoint::ReturnToCurve(Vector& tangent, double& tau, int& left, int& corrections, double& cosine) {
  constexpr double kClose = 0.1, kFar = 2, kPart = 0.9, kLeastDelta = 1e-13;
  constexpr int kFirstCorrections = 25, kCorrections = 8;
  const bool is_first = tangent.size() == 0;
  const double delta = attempt_.delta;
  double before = std::numeric_limits<double>::infinity();
  for (corrections = 1; corrections <= (is_first ? kFirstCorrections : kCorrections); ++corrections, --left) {
    attempt_.delta = std::clamp(tau, kLeastDelta, delta);
    TakeResiduals();
    attempt_.delta = delta;
    ++verdict_.statistics[Counter::kIterations];
    ++verdict_.statistics[Counter::kFactorizations];
    if (!matrix_.Factor(D_, false)) return false;
    Aim(1, tau, false);
    if (!SolveStep()) return false;
    Vector way = WayOfStep(0);
    for (State& state : states_) {
      state.miss = state.slack_miss = 0;
      state.slip_miss = {};
    }
    unbalanced_.setZero();
    ForEachPair([tau](Pair& pair) { pair.aim = tau * pair.weight; });
    if (!SolveStep()) return false;
    const Vector along = WayOfStep(1);
    const Vector turn = is_first ? Vector(-Relative(along)) : Relative(tangent);
    if (!is_first) way -= turn.dot(Relative(way)) / turn.dot(Relative(along)) * along;
    const double size = Relative(way).cwiseAbs().maxCoeff();
    if (!std::isfinite(size)) return false;
    if (!is_first && (size > 3 * before || (corrections > 1 && size > kFar))) return false;
    before = size;
    MoveAlong(way, std::min(1.0, kPart / size), tau);
    if (size >= kClose) continue;
    const double norm = Relative(along).norm(), dot = turn.dot(Relative(along));
    cosine = std::abs(dot) / (norm * turn.norm());
    tangent = (dot < 0 ? -1 : 1) / norm * along;
    --left;
    return true;
  }
  return false;
}

}  // namespace stiction
