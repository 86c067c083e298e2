// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/rest.h"

#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <numeric>

#include "certify/exact/cones.h"
#include "certify/exact/farkas.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/problem/check.h"
#include "solver/solve.h"

namespace stiction {
namespace {

// f in K with A f + b = 0 along the edges of polygons, or y that refutes it (DecideRest).
Rest DecideRestAlong(const ExactProblem& problem, const RationalPolygons& polygons, EdgesOf which) {
  const std::vector<ConeEdge> edges = MakeEdges(problem, polygons, which);
  const int rows = problem.rows();
  std::vector<bool> free;
  for (const ConeEdge& edge : edges) free.push_back(edge.free);
  std::vector<RationalRow> system;
  for (int i = 0; i < rows; ++i) {
    RationalRow& row = system.emplace_back(RationalRow{{}, problem.b[i]});
    for (const ConeEdge& edge : edges) row.coefficients.push_back(Along(edge, problem.A, i));
  }
  const auto answer = Solve(free, system);
  if (const Point* x = std::get_if<Point>(&answer)) return {Combined(edges, *x, rows), {}};
  ExactVector y(rows);
  for (int i = 0; i < rows; ++i) y[i] = -std::get<Multipliers>(answer).values[i];
  return {{}, std::move(y)};
}

}  // namespace

Rest DecideRest(const ExactProblem& problem) {
  constexpr int kRounds = 8;
  RationalPolygons polygons = FirstPolygons(problem);
  for (int round = 0; round < kRounds; ++round) {
    Rest within = DecideRestAlong(problem, polygons, EdgesOf::kWithinCone);
    if (within.f) return within;
    const ExactVector g = problem.A.transpose() * *within.y;
    if (!FindDualConeViolation(problem, g)) return within;
    AddCorners(problem, EdgesOf::kWithinCone, g, polygons);
    const Rest around = DecideRestAlong(problem, polygons, EdgesOf::kAroundCone);
    if (around.y || !FindConeViolation(problem, *around.f)) return around;
    AddCorners(problem, EdgesOf::kAroundCone, *around.f, polygons);
  }
  return {};
}

namespace {

// Whether g = A'y is in K* and y'b > 0. Then nothing rests: of f in K with A f = -b it would be 0 <= g'f =
// -y'b.
bool RefutesRest(const ExactProblem& problem, const ExactVector& y) {
  const FarkasVector farkas = MakeFarkasVector(problem, y);
  return farkas.value > 0 && !FindDualConeViolation(problem, farkas.g);
}

// A problem without friction over doubles: x >= 0 along the edges of the cones. Its forces E x, by least
// acceleration, propose forces at rest, and proofs that there are none. Exact numbers decide.
class AlongEdges {
 public:
  // Throws InputError where doubles do not hold the problem.
  AlongEdges(const ExactProblem& problem, EdgesOf which)
      : problem_(problem),
        rounded_(Rounded<double>(problem)),
        edges_(MakeEdges(problem, FirstPolygons(problem), which)) {
    E_ = Eigen::MatrixXd::Zero(rounded_.rows(), static_cast<int>(edges_.size()));
    for (std::size_t j = 0; j < edges_.size(); ++j)
      for (std::size_t k = 0; k < edges_[j].values.size(); ++k)
        E_(edges_[j].row + static_cast<int>(k), static_cast<int>(j)) = ToDouble(edges_[j].values[k]);
  }

  // Exact forces on the edges that doubles load, none of them accelerated along itself; empty if doubles find
  // none.
  std::optional<ExactVector> Forces() const {
    constexpr double kLoads = 1e-9;
    const Eigen::VectorXd x = Pushed(0);
    std::vector<ConeEdge> loaded;
    std::vector<double> loads;
    for (int j = 0; j < x.size(); ++j) {
      if (!edges_[j].free && !(x[j] > kLoads * x.cwiseAbs().maxCoeff())) continue;
      loaded.push_back(edges_[j]);
      loads.push_back(x[j]);
    }
    const int count = static_cast<int>(loaded.size()), rows = problem_.rows();
    const ExactVector guess = Eigen::Map<const Eigen::VectorXd>(loads.data(), count).unaryExpr([](double load) {
      return Rational(load);
    });
    ExactMatrix columns(rows, count), M(count, count);
    ExactVector right(count);
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < rows; ++i) columns(i, j) = Along(loaded[j], problem_.A, i);
      right[j] = -Along(loaded[j], problem_.b);
    }
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) M(i, j) = Along(loaded[i], columns.col(j));
    // What the equations leave free: nothing, which leaves simple numbers, or what doubles have.
    std::optional<ExactVector> f;
    for (const ExactVector& free : {ExactVector(ExactVector::Zero(count)), guess}) {
      const auto exact = SolveEquations(M, right, free);
      if (!exact) return std::nullopt;
      f = Combined(loaded, Point(exact->begin(), exact->end()), rows);
      if (!FindConeViolation(problem_, *f)) break;
    }
    return f;
  }

  // Forces f that push off by a margin have A f + b in the inside of K*, and f'(A f + b) next to 0; so f + z
  // refutes rest, where A z = b. Where contacts jam there is no such margin, and nothing is found.
  bool RefuteRest() const {
    constexpr double kMargin = 1e-6;
    if (std::any_of(edges_.begin(), edges_.end(), [](const ConeEdge& edge) { return edge.free; })) return false;
    const Eigen::VectorXd x = Pushed(kMargin);
    if (x.size() != E_.cols()) return false;
    const Eigen::VectorXd y = E_ * x + rounded_.A.completeOrthogonalDecomposition().solve(rounded_.b);
    if (!y.allFinite()) return false;
    return RefutesRest(problem_, y.unaryExpr([](double value) { return Rational(value); }));
  }

 private:
  // Empty where none are found. `margin`: of the largest b along the edges.
  Eigen::VectorXd Pushed(double margin) const {
    ContactProblem<double> pushing;
    for (const ConeEdge& edge : edges_)
      pushing.contacts.push_back(
          {.kind = edge.free ? ContactKind::kBilateral : ContactKind::kFrictionless, .mu = 0, .slip = {}});
    pushing.A = E_.transpose() * rounded_.A * E_;
    pushing.b = E_.transpose() * rounded_.b;
    pushing.b.array() -= margin * pushing.b.cwiseAbs().maxCoeff();
    Eigen::VectorXd x = Solve(pushing, {.method = "fast"}).f;
    return x.allFinite() ? x : Eigen::VectorXd();
  }

  const ExactProblem& problem_;
  ContactProblem<double> rounded_;
  std::vector<ConeEdge> edges_;
  Eigen::MatrixXd E_;
};

// What doubles propose: exact forces, which may rest, or not; or that nothing rests, which is proved then.
struct FoundByDoubles {
  std::optional<ExactVector> f;
  bool refuted = false;
};

FoundByDoubles LookByDoubles(const ExactProblem& problem) {
  FoundByDoubles found;
  try {
    found.refuted = AlongEdges(problem, EdgesOf::kAroundCone).RefuteRest();
    if (!found.refuted) found.f = AlongEdges(problem, EdgesOf::kWithinCone).Forces();
  } catch (const InputError&) {  // doubles do not hold the problem
  }
  return found;
}

std::optional<ExactVector> RestOf(const ExactProblem& problem) {
  if (problem.rows() > kQuickRows) return std::nullopt;
  if (HasSlidingContact(problem)) return std::nullopt;
  const FoundByDoubles found = LookByDoubles(problem);
  if (found.refuted) return std::nullopt;
  const auto rests = [&problem](const ExactVector& f) {
    return !FindConeViolation(problem, f) && Accelerations(problem, f).isZero();
  };
  if (found.f && rests(*found.f)) return found.f;
  const auto range = DecideRange(problem.A, problem.b);
  const ExactVector* point = std::get_if<ExactVector>(&range);
  if (point == nullptr) return std::nullopt;
  const ExactVector f = -*point;
  if (!FindConeViolation(problem, f)) return f;
  if (found.f && RefutesRest(problem, *found.f + *point)) return std::nullopt;
  if (RankOf(problem.A) == problem.rows()) return std::nullopt;
  return DecideRest(problem).f;
}

}  // namespace

std::vector<UncoupledPart> UncoupledParts(const ExactProblem& problem) {
  if (problem.contacts.empty()) return {{problem, {}}};
  std::vector<int> group(problem.contacts.size());  // the first contact of the one that it is in
  std::vector<int> contact_of;                      // by row
  ForEachContact(problem, [&](int i, int, int rows) { contact_of.insert(contact_of.end(), rows, i); });
  std::iota(group.begin(), group.end(), 0);
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) {
      const int one = group[contact_of[i]], other = group[contact_of[j]];
      if (one != other && problem.A(i, j) != 0)
        std::ranges::replace(group, std::max(one, other), std::min(one, other));
    }
  }
  std::map<int, UncoupledPart> parts;
  for (std::size_t i = 0; i < group.size(); ++i)
    parts[group[i]].problem.contacts.push_back(problem.contacts[i]);
  for (int i = 0; i < problem.rows(); ++i) parts[group[contact_of[i]]].rows.push_back(i);
  std::vector<UncoupledPart> list;
  for (auto& [unused, part] : parts) {
    part.problem.dimension = problem.dimension;
    part.problem.A = problem.A(part.rows, part.rows);
    part.problem.b = problem.b(part.rows);
    list.push_back(std::move(part));
  }
  return list;
}

std::optional<RestingForces> ForcesAtRest(const ExactProblem& problem, const ExactVector& f,
                                          const ExactVector& a) {
  std::optional<RestingForces> rest;
  for (const UncoupledPart& part : UncoupledParts(problem)) {
    if (std::all_of(part.rows.begin(), part.rows.end(), [&a](int row) { return a[row] == 0; })) continue;
    const auto forces = RestOf(part.problem);
    if (!forces) continue;
    STICTION_CHECK(!FindConeViolation(part.problem, *forces) && Accelerations(part.problem, *forces).isZero(),
                   "forces at rest that are none");
    if (!rest) rest = RestingForces{f, std::vector<bool>(f.size(), false)};
    for (std::size_t k = 0; k < part.rows.size(); ++k) {
      rest->f[part.rows[k]] = (*forces)[static_cast<int>(k)];
      rest->rests[part.rows[k]] = true;
    }
  }
  return rest;
}

}  // namespace stiction
