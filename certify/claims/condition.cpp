// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/condition.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/claims/claim.h"
#include "certify/claims/safe.h"
#include "corpus/json.h"
#include "solver/problem/check.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

// Every static contact's friction row, the normal row being the one before it.
template <class Visit>
void ForEachFriction(const ExactProblem& problem, const Visit& visit) {
  ForEachContact(problem, [&](int i, int row, int count) {
    if (count > 1) visit(problem.contacts[i], row + 1);
  });
}

Rational LargestRatio(const ExactProblem& problem, const ExactVector& d, FrictionWeights weights) {
  Rational largest = 0;
  ForEachFriction(problem, [&](const Contact<Rational>& contact, int row) {
    const Rational weight = weights == FrictionWeights::kUniform ? Rational(1) : contact.mu;
    largest = std::max(largest, Rational(weight * d[row - 1] / d[row]));
  });
  return largest;
}

ExactMatrix Scaled(const ExactMatrix& A, const ExactVector& d) { return d.asDiagonal() * A * d.asDiagonal(); }

bool IsSemidefinite(const ExactMatrix& A) { return std::holds_alternative<LdltFactors>(DecideSemidefinite(A)); }

// least I <= B <= most I.
bool Encloses(const Rational& least, const Rational& most, const ExactMatrix& B) {
  const ExactMatrix I = ExactMatrix::Identity(B.rows(), B.cols());
  return IsSemidefinite(B - least * I) && IsSemidefinite(most * I - B);
}

bool IsGoodEnough(const Rational& friction, const Rational& least, const Rational& most) {
  const Rational gap = most - least;
  return friction * friction * gap * gap < 4 * least * most;
}

// ---- Searching over doubles ----

constexpr double kWork = 2e9;       // of a search, in multiplications
constexpr double kLastStep = 0.02;  // of a logarithm of d

// Ascending.
Eigen::VectorXd EigenvaluesOf(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

// m (k - 1) / (2 sqrt(k)), which has to be less than 1, as a function of log d.
struct Objective {
  Eigen::MatrixXd A;
  std::vector<std::pair<int, double>> frictions;  // row, weight

  double operator()(const Eigen::VectorXd& log_d) const {
    const Eigen::VectorXd d = log_d.array().exp();
    const Eigen::MatrixXd B = d.asDiagonal() * A * d.asDiagonal();
    const Eigen::VectorXd values = EigenvaluesOf(B);
    const double least = values[0], most = values[values.size() - 1];
    if (!(least > 0) || !std::isfinite(most)) return std::numeric_limits<double>::infinity();
    double friction = 0;
    for (const auto& [row, weight] : frictions) friction = std::max(friction, weight * d[row - 1] / d[row]);
    return friction * (most - least) / (2 * std::sqrt(most) * std::sqrt(least));
  }
};

// Steps along each axis, then half as long, from d_i = 1 / sqrt(A_ii), where all rows weigh alike.
Eigen::VectorXd Minimize(const Objective& objective, Eigen::VectorXd x) {
  const double n = static_cast<double>(x.size());
  double best = objective(x), work = 0;
  for (double step = 1; step > kLastStep && work < kWork;) {
    bool fell = false;
    for (Eigen::Index i = 0; i < x.size() && work < kWork; ++i) {
      for (const double sign : {1.0, -1.0}) {
        Eigen::VectorXd y = x;
        y[i] += sign * step;
        const double value = objective(y);
        work += 10 * n * n * n;
        if (value >= best) continue;
        x = y;
        best = value;
        fell = true;
        break;
      }
    }
    if (!fell) step /= 2;
  }
  return x;
}

// A number of few digits near x > 0.
Rational Short(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return Rational(std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits));
}

long BitsOf(const mpz_class& x) { return static_cast<long>(mpz_sizeinbase(x.get_mpz_t(), 2)); }

Rational TimesPowerOfTwo(const Rational& x, long exponent) {
  Rational product;
  if (exponent >= 0) mpq_mul_2exp(product.get_mpq_t(), x.get_mpq_t(), static_cast<unsigned long>(exponent));
  if (exponent < 0) mpq_div_2exp(product.get_mpq_t(), x.get_mpq_t(), static_cast<unsigned long>(-exponent));
  return product;
}

// An unsafe problem shows that its condition number is not enough.
Json ByCondition(const ExactProblem& problem) {
  if (auto found = ConditionCertificate(problem)) return std::move(*found);
  Json safety = SafetyCertificateIfDecided(problem);
  if (safety.is_object() && safety["claim"] == "unsafe") return safety;
  return "no scaling was found under which the condition number of A is small enough";
}

}  // namespace

std::optional<Rational> ConditionBound::SafeFriction() const {
  if (ratio == 0 || most == least) return std::nullopt;
  const Rational square = 4 * least * most / ((most - least) * (most - least) * ratio * ratio);
  const long half = (BitsOf(square.get_num()) - BitsOf(square.get_den())) / 2;
  const Rational reduced = TimesPowerOfTwo(square, -2 * half);  // not far from 1, whatever the square
  for (double mu = std::sqrt(reduced.get_d());; mu *= 1 - 0x1p-12) {
    const Rational rounded = Short(mu, 12);
    if (rounded * rounded < reduced) return TimesPowerOfTwo(rounded, half);
  }
}

std::optional<ConditionBound> FindConditionBound(const ExactProblem& problem, FrictionWeights weights) {
  RequireSafetyDecidable(problem);
  const int n = problem.rows();
  if (n == 0 || FindAsymmetry(problem.A)) return std::nullopt;
  Objective objective;
  objective.A = problem.A.unaryExpr([](const Rational& x) { return x.get_d(); });
  if (!objective.A.allFinite() || !(objective.A.diagonal().array() > 0).all()) return std::nullopt;
  ForEachFriction(problem, [&](const Contact<Rational>& contact, int row) {
    objective.frictions.emplace_back(row, weights == FrictionWeights::kUniform ? 1.0 : contact.mu.get_d());
  });
  const Eigen::VectorXd log_d = Minimize(objective, -0.5 * objective.A.diagonal().array().log());
  if (!std::isfinite(objective(log_d))) return std::nullopt;

  ConditionBound bound;
  bound.scaling.resize(n);
  for (int i = 0; i < n; ++i) bound.scaling[i] = Short(std::exp(log_d[i]), 8);
  bound.ratio = LargestRatio(problem, bound.scaling, weights);
  const ExactMatrix B = Scaled(problem.A, bound.scaling);
  const Eigen::MatrixXd rounded = B.unaryExpr([](const Rational& x) { return x.get_d(); });
  const Eigen::VectorXd values = EigenvaluesOf(rounded);
  if (!(values[0] > 0)) return std::nullopt;
  bound.least = Short(values[0] * (1 - 0x1p-12), 16);
  bound.most = Short(values[n - 1] * (1 + 0x1p-12), 16);
  if (!Encloses(bound.least, bound.most, B)) return std::nullopt;
  return bound;
}

std::optional<Json> ConditionCertificate(const ExactProblem& problem) {
  const auto bound = FindConditionBound(problem, FrictionWeights::kOfProblem);
  if (!bound || !IsGoodEnough(bound->ratio, bound->least, bound->most)) return std::nullopt;
  Json scaling = Json::array();
  for (const Rational& d : bound->scaling) scaling.push_back(ToString(d));
  Json witness = {
      {"scaling", std::move(scaling)}, {"least", ToString(bound->least)}, {"most", ToString(bound->most)}};
  const auto fault = FindFault(CheckSafeByCondition, problem, witness);
  STICTION_CHECK(!fault, "a certificate of safety by condition is none: " + fault->path);
  return MakeCertificate("safe-by-condition", problem, std::move(witness));
}

Json CheckSafeByCondition(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"least", "most", "scaling"});
  RequireClaimableSafety(problem);
  if (const auto pair = FindAsymmetry(problem.A)) {
    throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second),
                   ToString(problem.A(pair->first, pair->second)),
                   ToString(problem.A(pair->second, pair->first)) + ", as across the diagonal"};
  }
  const int n = problem.rows();
  Cost(EliminationOperations(n, 2));
  const ExactVector d = ReadVector(witness["scaling"], "witness.scaling", n);
  for (int i = 0; i < d.size(); ++i) {
    if (d[i] <= 0) throw Rejected{ElementPath("witness.scaling", i), ToString(d[i]), "a number > 0"};
  }
  const Rational least = ReadNumber(witness["least"], "witness.least");
  const Rational most = ReadNumber(witness["most"], "witness.most");
  if (least <= 0) throw Rejected{"witness.least", ToString(least), "a number > 0"};
  Cost(EliminationOperations(n, 2)).AllRows(problem).Vector(d, 2 * n).Numbers({{least, most}}, n);
  const ExactMatrix B = Scaled(problem.A, d), I = ExactMatrix::Identity(B.rows(), B.cols());
  if (!IsSemidefinite(B - least * I)) {
    throw Rejected{"witness.least", ToString(least), "no more than the least eigenvalue of DAD"};
  }
  if (!IsSemidefinite(most * I - B)) {
    throw Rejected{"witness.most", ToString(most), "no less than the largest eigenvalue of DAD"};
  }
  const Rational friction = LargestRatio(problem, d, FrictionWeights::kOfProblem);
  if (!IsGoodEnough(friction, least, most)) {
    throw Rejected{"witness", "m = " + ToString(friction) + " and these bounds", "m^2 (u - l)^2 < 4 u l"};
  }
  return {{"condition", ToString(Rational(most / least))}, {"friction", ToString(friction)}};
}

ClaimRows ConditionClaims() {
  static constexpr Claim kClaims[] = {Claim{"safe-by-condition", CheckSafeByCondition,
                                            "its condition number alone shows that it is", Alone<ByCondition>,
                                            RequireSafetyIsSaid}};
  return {60, kClaims};
}

}  // namespace stiction
