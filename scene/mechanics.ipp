// SPDX-License-Identifier: Apache-2.0
// Definitions for mechanics.h, in its order.

#pragma once

#include <algorithm>
#include <numeric>
#include <utility>

#include "scene/mechanics.h"
#include "solver/problem/scalar.h"

namespace stiction {

inline int RootOf(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

template <class Scalar, int Dof>
std::vector<Island> FindIslands(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                                const std::vector<Constraint<Scalar, Dof>>& constraints, bool together) {
  const int count = static_cast<int>(bodies.size());
  std::vector<int> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto member = [&](const Constraint<Scalar, Dof>& constraint) {
    return !bodies[constraint.bodies[0]].fixed ? constraint.bodies[0] : constraint.bodies[1];
  };
  for (const auto& constraint : constraints) {
    const auto [first, second] = constraint.bodies;
    if (!bodies[first].fixed && !bodies[second].fixed) parent[RootOf(parent, first)] = RootOf(parent, second);
  }
  std::vector<Island> islands;
  std::vector<int> island_of(count, -1);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const int body = member(constraints[i]);
    if (bodies[body].fixed) continue;
    int& island = island_of[together ? 0 : RootOf(parent, body)];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[island].constraints.push_back(static_cast<int>(i));
    islands[island].rows += static_cast<int>(constraints[i].rows.size());
  }
  for (int body = 0; body < count && !islands.empty(); ++body) {
    const int island = island_of[together ? 0 : RootOf(parent, body)];
    if (!bodies[body].fixed && island >= 0) islands[island].bodies.push_back(body);
  }
  return islands;
}

// add(i, j, value), j <= i: what a body that can move contributes to A(i, j). The values of all bodies add up.
template <class Scalar, int Dof, class Add>
void ForEachEntry(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                  const std::vector<Constraint<Scalar, Dof>>& constraints, const Island& island,
                  const Add& add) {
  using Vector = Eigen::Matrix<Scalar, Dof, 1>;
  struct Touch {
    int row;
    const Vector* J;
    Vector WJ;
  };
  std::vector<std::vector<Touch>> touches(island.bodies.size());
  int at = 0;
  for (const int i : island.constraints) {
    for (int side = 0; side < 2; ++side) {
      const int body = constraints[i].bodies[side];
      if (bodies[body].fixed) continue;
      auto& list =
          touches[std::lower_bound(island.bodies.begin(), island.bodies.end(), body) - island.bodies.begin()];
      int row = at;
      for (const auto& of : constraints[i].rows)
        list.push_back({row++, &of.J[side], bodies[body].W * of.J[side]});
    }
    at += static_cast<int>(constraints[i].rows.size());
  }
  for (const auto& list : touches) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) add(list[i].row, list[j].row, Scalar(list[i].J->dot(list[j].WJ)));
    }
  }
}

// A problem with everything but A.
template <class Problem, class Scalar, int Dof>
Problem WithoutMatrix(const std::vector<Constraint<Scalar, Dof>>& constraints, const Island& island) {
  Problem problem;
  problem.dimension = Dof == 3 ? 2 : 3;
  problem.b.resize(island.rows);
  int at = 0;
  for (const int i : island.constraints) {
    problem.contacts.push_back(constraints[i].law);
    for (const auto& row : constraints[i].rows) problem.b[at++] = row.b;
  }
  return problem;
}

template <class Scalar, int Dof>
ContactProblem<Scalar> DenseProblemOf(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                                      const std::vector<Constraint<Scalar, Dof>>& constraints,
                                      const Island& island) {
  auto problem = WithoutMatrix<ContactProblem<Scalar>>(constraints, island);
  problem.A = ContactProblem<Scalar>::Matrix::Constant(island.rows, island.rows, Scalar(0));
  ForEachEntry(bodies, constraints, island,
               [&problem](int i, int j, const Scalar& value) { problem.A(i, j) += value; });
  for (int i = 0; i < island.rows; ++i) {
    for (int j = 0; j < i; ++j) problem.A(j, i) = problem.A(i, j);
  }
  return problem;
}

// Of a sparse matrix over rationals; over doubles the pattern is that of what touches, and orderings are kept.
template <class Scalar>
bool IsLeftOut(const Scalar& entry) {
  return kIsExact<Scalar> && entry == 0;
}

// The blocks of the island's bodies, which are matrix(body), as one sparse matrix.
template <class Scalar, int Dof, class Block>
Eigen::SparseMatrix<Scalar> BlockDiagonal(const Island& island, const Block& matrix) {
  constexpr int kMoves = Dof == 3 ? 2 : 3;  // before the spins, with which they share no entry
  const int size = Dof * static_cast<int>(island.bodies.size());
  Eigen::SparseMatrix<Scalar> blocks(size, size);
  blocks.reserve(size * kMoves);
  for (int column = 0; column < size; ++column) {
    const auto& block = matrix(island.bodies[column / Dof]);
    const int k = column % Dof, begin = column - k;
    blocks.startVec(column);
    for (int i = k < kMoves ? k : kMoves; i < (k < kMoves ? k + 1 : Dof); ++i) {
      if (!IsLeftOut(block(i, k))) blocks.insertBack(begin + i, column) = block(i, k);
    }
  }
  blocks.finalize();
  return blocks;
}

template <class Scalar, int Dof>
FactoredProblem<Scalar> FactoredProblemOf(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                                          const std::vector<Constraint<Scalar, Dof>>& constraints,
                                          const Island& island) {
  auto problem = WithoutMatrix<FactoredProblem<Scalar>>(constraints, island);
  const int velocities = Dof * static_cast<int>(island.bodies.size());
  problem.w.resize(velocities);
  std::vector<int> first(bodies.size(), -1);  // velocity of a body
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    const int body = island.bodies[k];
    first[body] = Dof * static_cast<int>(k);
    problem.w.template segment<Dof>(first[body]) = bodies[body].FreeAcceleration();
  }
  typename FactoredMatrix<Scalar>::Rows J(island.rows, velocities);
  J.reserve(2 * Dof * island.rows);
  int at = 0;
  for (const int i : island.constraints) {
    const auto& ends = constraints[i].bodies;
    const int lower = first[ends[1]] < first[ends[0]] ? 1 : 0;
    for (const auto& row : constraints[i].rows) {
      J.startVec(at);
      for (const int side : {lower, 1 - lower}) {
        if (first[ends[side]] < 0) continue;
        for (int k = 0; k < Dof; ++k) {
          if (!IsLeftOut(row.J[side][k])) J.insertBack(at, first[ends[side]] + k) = row.J[side][k];
        }
      }
      ++at;
    }
  }
  J.finalize();
  problem.M = BlockDiagonal<Scalar, Dof>(
      island, [&](int body) -> const auto& { return bodies[body].M; });
  problem.A = {std::move(J), BlockDiagonal<Scalar, Dof>(
                                 island, [&](int body) -> const auto& { return bodies[body].W; })};
  problem.c = problem.b - problem.A.J() * problem.w;
  if constexpr (std::is_floating_point_v<Scalar>) {
    // Of impulses and positions b has nothing of w, whose rounding would hide a small b.
    if (problem.rows() > 0 && problem.c.cwiseAbs().maxCoeff() > problem.b.cwiseAbs().maxCoeff()) {
      problem.w.setZero();
      problem.c = problem.b;
    }
  }
  return problem;
}

template <class Scalar, int Dof>
void AddResponse(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                 const std::vector<Constraint<Scalar, Dof>>& constraints, const Island& island,
                 const typename ContactProblem<Scalar>::Vector& f,
                 std::vector<Eigen::Matrix<Scalar, Dof, 1>>& change) {
  int at = 0;
  for (const int i : island.constraints) {
    for (const auto& row : constraints[i].rows) {
      for (int side = 0; side < 2; ++side) {
        const int body = constraints[i].bodies[side];
        if (!bodies[body].fixed) change[body] += bodies[body].W * row.J[side] * f[at];
      }
      ++at;
    }
  }
}

// The rows of a constraint as seen from the lower of its bodies.
template <class Scalar, int Dof>
class RowView {
 public:
  explicit RowView(const Constraint<Scalar, Dof>& constraint)
      : constraint_(constraint), swapped_(constraint.bodies[1] < constraint.bodies[0]) {}

  const Scalar& J(int row, int k) const {
    const int side = k < Dof ? 0 : 1;
    return constraint_.rows[row].J[swapped_ ? 1 - side : side][k % Dof];
  }
  const Scalar& b(int row) const { return constraint_.rows[row].b; }

 private:
  const Constraint<Scalar, Dof>& constraint_;
  bool swapped_;
};

// x - (w y + (1 - w) z) as a sign, zero within rounding.
template <class Scalar>
int SignOfExcess(const Scalar& x, const Scalar& w, const Scalar& y, const Scalar& z) {
  const Scalar scale = std::max<Scalar>(Scalar(1), std::max<Scalar>(Abs(x), std::max<Scalar>(Abs(y), Abs(z))));
  return Sign<Scalar>(Scalar(x - w * y - (Scalar(1) - w) * z),
                      Scalar(scale / Scalar(1000000) / Scalar(1000000)));
}

// Whether constraint i is the combination of j and k that FindRedundant asks for.
template <class Scalar, int Dof>
bool IsBetween(const Constraint<Scalar, Dof>& i, const Constraint<Scalar, Dof>& j,
               const Constraint<Scalar, Dof>& k) {
  const RowView<Scalar, Dof> inner(i), first(j), second(k);
  int widest = 0;
  const auto width = [&](int at) { return Abs<Scalar>(Scalar(first.J(0, at) - second.J(0, at))); };
  for (int at = 1; at < 2 * Dof; ++at) {
    if (width(at) > width(widest)) widest = at;
  }
  Scalar w(1);
  if (Sign(width(widest)) != 0) {
    w = Scalar(inner.J(0, widest) - second.J(0, widest)) / Scalar(first.J(0, widest) - second.J(0, widest));
    if (w < 0 || w > 1) return false;
  }
  for (int row = 0; row < static_cast<int>(i.rows.size()); ++row) {
    for (int at = 0; at < 2 * Dof; ++at) {
      if (SignOfExcess<Scalar>(inner.J(row, at), w, first.J(row, at), second.J(row, at)) != 0) return false;
      if (row > 0 && SignOfExcess<Scalar>(first.J(row, at), Scalar(1), second.J(row, at), Scalar(0)) != 0)
        return false;
    }
    const int excess = SignOfExcess<Scalar>(inner.b(row), w, first.b(row), second.b(row));
    if (row == 0 && excess < 0) return false;
    if (row == 0 || i.law.kind != ContactKind::kStatic) continue;
    if (excess != 0 || SignOfExcess<Scalar>(first.b(row), Scalar(1), second.b(row), Scalar(0)) != 0)
      return false;
  }
  return true;
}

// Whether the frictionless constraint i is a combination of three others, as the inner points of a face are in
// space.
template <class Scalar, int Dof>
bool IsInTriangle(const Constraint<Scalar, Dof>& i,
                  const std::array<const Constraint<Scalar, Dof>*, 3>& corners) {
  const RowView<Scalar, Dof> inner(i), first(*corners[0]), second(*corners[1]), third(*corners[2]);
  const auto x = [&](int at) { return Scalar(first.J(0, at) - third.J(0, at)); };
  const auto y = [&](int at) { return Scalar(second.J(0, at) - third.J(0, at)); };
  const auto z = [&](int at) { return Scalar(inner.J(0, at) - third.J(0, at)); };
  // u x + v y = z, by the widest columns.
  int p = 0, q = 0;
  for (int at = 1; at < 2 * Dof; ++at) {
    if (Abs<Scalar>(x(at)) > Abs<Scalar>(x(p))) p = at;
  }
  const auto determinant = [&](int at) { return Scalar(x(p) * y(at) - x(at) * y(p)); };
  for (int at = 1; at < 2 * Dof; ++at) {
    if (Abs<Scalar>(determinant(at)) > Abs<Scalar>(determinant(q))) q = at;
  }
  const Scalar d = determinant(q);
  if (Sign(d) == 0) return false;
  const Scalar u = (z(p) * y(q) - z(q) * y(p)) / d, v = (x(p) * z(q) - x(q) * z(p)) / d;
  if (u < 0 || v < 0 || u + v > 1) return false;
  const auto mean = [&](const Scalar& a, const Scalar& b, const Scalar& c) {
    return Scalar(u * a + v * b + (1 - u - v) * c);
  };
  for (int at = 0; at < 2 * Dof; ++at) {
    const Scalar expected = mean(first.J(0, at), second.J(0, at), third.J(0, at));
    if (SignOfExcess<Scalar>(inner.J(0, at), Scalar(1), expected, Scalar(0)) != 0) return false;
  }
  return SignOfExcess<Scalar>(inner.b(0), Scalar(1), mean(first.b(0), second.b(0), third.b(0)), Scalar(0)) >= 0;
}

// Whether i is in a triangle of any of the others.
template <class Scalar, int Dof>
bool IsInHull(const std::vector<Constraint<Scalar, Dof>>& constraints, int i, const std::vector<int>& others) {
  if (constraints[i].law.kind != ContactKind::kFrictionless) return false;
  for (std::size_t j = 0; j < others.size(); ++j) {
    for (std::size_t k = j + 1; k < others.size(); ++k) {
      for (std::size_t l = k + 1; l < others.size(); ++l) {
        if (IsInTriangle<Scalar, Dof>(
                constraints[i], {&constraints[others[j]], &constraints[others[k]], &constraints[others[l]]}))
          return true;
      }
    }
  }
  return false;
}

template <class Scalar, int Dof>
bool HaveOneLaw(const Constraint<Scalar, Dof>& i, const Constraint<Scalar, Dof>& j) {
  return i.law.kind == j.law.kind && i.law.mu == j.law.mu && i.law.slip == j.law.slip;
}

// Contacts between the same two bodies, ascending: the entries [from, to) of an order of all constraints, or
// where that is empty these numbers themselves.
struct ContactGroup {
  const std::vector<int>& order;
  int from, to;

  int size() const { return to - from; }
  int operator[](int k) const { return order.empty() ? from + k : order[from + k]; }
};

// The normal row of a constraint: the part of the lower of its bodies, or of the higher.
template <class Scalar, int Dof>
const Eigen::Matrix<Scalar, Dof, 1>& NormalPart(const Constraint<Scalar, Dof>& constraint, int side) {
  return constraint.rows[0].J[constraint.bodies[1] < constraint.bodies[0] ? 1 - side : side];
}

// More than what IsBetween and IsInTriangle forgive in numbers up to 1, 1e-12, and the rounding here.
inline constexpr double kForgiven = 4e-12;

// Two tests that show cheaply that contact i is no combination of any others of its group, as combinations lie
// in their hull. Whether the last number of its normal row, a moment, is beyond that of all others, as that of
// the ends of an edge is:
template <class Scalar, int Dof>
bool IsOutermost(const std::vector<Constraint<Scalar, Dof>>& constraints, int i, const ContactGroup& group) {
  const auto last = [&](int n) -> const Scalar& { return NormalPart(constraints[group[n]], 1)[Dof - 1]; };
  const Scalar& own = NormalPart(constraints[i], 1)[Dof - 1];
  Scalar scale(1);
  for (int n = 0; n < group.size(); ++n) scale = std::max<Scalar>(scale, Abs<Scalar>(last(n)));
  const Scalar forgiven = Scalar(scale * kForgiven);
  int side = 0;
  for (int n = 0; n < group.size(); ++n) {
    if (group[n] == i) continue;
    const int sign = Sign<Scalar>(Scalar(own - last(n)), forgiven);
    if (sign == 0 || sign == -side) return false;
    side = sign;
  }
  return true;
}

// And whether a plane has its normal row on one side and all of theirs on the other, as that of the corner of a
// face. The plane is across v, the sum of what leads from them to i.
template <class Scalar, int Dof>
bool IsSetApart(const std::vector<Constraint<Scalar, Dof>>& constraints, int i, const ContactGroup& group) {
  using Part = Eigen::Matrix<Scalar, Dof, 1>;
  std::array<Part, 2> v = {Part::Constant(Scalar(0)), Part::Constant(Scalar(0))};
  Scalar scale(1), length(0);
  for (int n = 0; n < group.size(); ++n) {
    for (int side = 0; side < 2; ++side) {
      const Part& other = NormalPart(constraints[group[n]], side);
      v[side] += NormalPart(constraints[i], side) - other;
      for (int k = 0; k < Dof; ++k) scale = std::max<Scalar>(scale, Abs<Scalar>(other[k]));
    }
  }
  for (int k = 0; k < 2 * Dof; ++k) length += Abs<Scalar>(v[k / Dof][k % Dof]);
  const auto height = [&](int j) {
    return Scalar(v[0].dot(NormalPart(constraints[j], 0)) + v[1].dot(NormalPart(constraints[j], 1)));
  };
  const Scalar own = height(i), forgiven = Scalar(scale * length * kForgiven);
  for (int n = 0; n < group.size(); ++n) {
    if (group[n] != i && Sign<Scalar>(Scalar(own - height(group[n])), forgiven) <= 0) return false;
  }
  return true;
}

// Whether contact i is a combination of the others.
template <class Scalar, int Dof>
bool IsCombination(const std::vector<Constraint<Scalar, Dof>>& constraints, int i,
                   const std::vector<int>& others) {
  for (std::size_t j = 0; j < others.size(); ++j) {
    for (std::size_t k = others.size(); k-- > j;) {  // the ends first
      if (IsBetween(constraints[i], constraints[others[j]], constraints[others[k]])) return true;
    }
  }
  return Dof == 6 && IsInHull(constraints, i, others);
}

// Adds what can be dropped of a group.
template <class Scalar, int Dof>
void AddRedundant(const std::vector<Constraint<Scalar, Dof>>& constraints, const ContactGroup& group,
                  std::vector<int>& redundant) {
  if (group.size() == 2 && IsOutermost(constraints, group[0], group)) return;  // so is the other
  const auto before = static_cast<std::ptrdiff_t>(redundant.size());
  std::vector<int> others;
  for (int n = 0; n < group.size(); ++n) {
    const int i = group[n];
    if (IsOutermost(constraints, i, group) || (Dof == 6 && IsSetApart(constraints, i, group))) continue;
    others.clear();
    for (int k = 0; k < group.size(); ++k) {
      const int j = group[k];
      const bool is_kept = std::find(redundant.begin() + before, redundant.end(), j) == redundant.end();
      if (j != i && is_kept && HaveOneLaw(constraints[i], constraints[j])) others.push_back(j);
    }
    if (IsCombination(constraints, i, others)) redundant.push_back(i);
  }
}

template <class Scalar, int Dof>
std::vector<int> FindRedundant(const std::vector<Constraint<Scalar, Dof>>& constraints) {
  const int count = static_cast<int>(constraints.size());
  const auto bodies = [&constraints](int i) {  // those of joints before all others
    const auto [first, second] = constraints[i].bodies;
    if (constraints[i].law.kind == ContactKind::kBilateral) return std::pair(-1, -1);
    return std::pair(std::min(first, second), std::max(first, second));
  };
  std::vector<int> order;
  for (int i = 1; i < count && order.empty(); ++i) {
    if (bodies(i - 1) <= bodies(i)) continue;  // as nearly always: joints come first, contacts pair by pair
    order.resize(constraints.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&bodies](int j, int k) { return bodies(j) < bodies(k); });
  }
  std::vector<int> redundant;
  const ContactGroup all{order, 0, count};
  for (int from = 0, to = 0; from < count; from = to) {
    const auto pair = bodies(all[from]);
    while (to < count && bodies(all[to]) == pair) ++to;
    if (to - from > 1 && pair.first >= 0) AddRedundant<Scalar, Dof>(constraints, {order, from, to}, redundant);
  }
  std::sort(redundant.begin(), redundant.end());
  return redundant;
}

}  // namespace stiction
