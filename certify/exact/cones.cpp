// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/cones.h"

#include "solver/problem/units.h"

namespace stiction {
namespace {

using Tangents = std::vector<std::vector<Rational>>;

// d_k or w_k.
Tangents TangentsOf(const FrictionPolygon<Rational>& polygon, EdgesOf which) {
  Tangents tangents;
  for (int k = 0; k < polygon.sides(); ++k) {
    const Planar<Rational>&d = polygon.corner(k), &next = polygon.corner(k + 1);
    const Rational scale = 1 + Dot(d, next);
    if (which == EdgesOf::kAroundCone) {
      tangents.push_back({Rational((d[0] + next[0]) / scale), Rational((d[1] + next[1]) / scale)});
    } else {
      tangents.push_back({d[0], d[1]});
    }
  }
  return tangents;
}

std::vector<Rational> EdgeOf(const Rational& normal, const Rational& factor,
                             const std::vector<Rational>& tangent) {
  std::vector<Rational> values = {normal};
  for (const Rational& x : tangent) values.push_back(factor * x);
  return values;
}

// Of a static contact, at its row.
std::vector<ConeEdge> RoundEdges(const Rational& mu, EdgesOf which, const Tangents& tangents, ConeEdge edge) {
  std::vector<ConeEdge> edges;
  for (const auto& tangent : tangents) {
    edge.values = which == EdgesOf::kWithinDualCone ? EdgeOf(mu, 1, tangent) : EdgeOf(1, mu, tangent);
    edges.push_back(edge);
  }
  return edges;
}

// The same with mu = 0: vF = 0, and gF is free.
std::vector<ConeEdge> SmoothEdges(EdgesOf which, int tangents, ConeEdge edge) {
  edge.values.assign(tangents + 1, 0);
  edge.values[0] = 1;
  std::vector<ConeEdge> edges = {edge};
  for (int k = 1; which == EdgesOf::kWithinDualCone && k <= tangents; ++k) {
    edge.values.assign(tangents + 1, 0);
    edge.values[k] = 1;
    edge.free = true;
    edges.push_back(edge);
  }
  return edges;
}

// Whether the entries of a static contact are in its cone, or in its dual cone.
bool IsWithin(const Rational& mu, bool dual, const ExactVector& x, int row) {
  const Rational length = Dot(TangentialOf(x, row), TangentialOf(x, row)), normal = x[row] * x[row];
  return x[row] >= 0 && (dual ? mu * mu * length <= normal : length <= mu * mu * normal);
}

bool AddCorner(const Planar<Rational>& direction, FrictionPolygon<Rational>& polygon) {
  for (int bits = 4; bits <= 44; bits += 4) {
    if (polygon.Insert(NearDirection(direction, bits))) return true;
  }
  return false;
}

}  // namespace

RationalPolygons FirstPolygons(const ExactProblem& problem) {
  const std::size_t count = problem.dimension == 3 ? problem.contacts.size() : 0;
  return RationalPolygons(count, FrictionPolygon<Rational>(8));
}

std::vector<ConeEdge> MakeEdges(const ExactProblem& problem, const RationalPolygons& polygons, EdgesOf which) {
  const int tangents = problem.dimension - 1;
  std::vector<ConeEdge> edges;
  ForEachContact(problem, [&](int i, int row, int) {
    const Contact<Rational>& contact = problem.contacts[i];
    ConeEdge edge = {i, row, {1}, contact.kind == ContactKind::kBilateral};
    std::vector<ConeEdge> own = {edge};
    if (contact.kind == ContactKind::kSliding) {
      const std::vector<Rational> slip(contact.slip.begin(), contact.slip.begin() + tangents);
      own[0].values = EdgeOf(1, Rational(-contact.mu), slip);
    } else if (contact.kind == ContactKind::kStatic && contact.mu == 0) {
      own = SmoothEdges(which, tangents, edge);
    } else if (contact.kind == ContactKind::kStatic) {
      own = RoundEdges(contact.mu, which,
                       polygons.empty() ? Tangents{{1}, {-1}} : TangentsOf(polygons[i], which), edge);
    } else if (edge.free && which == EdgesOf::kWithinDualCone) {
      own.clear();  // gN = 0
    }
    edges.insert(edges.end(), own.begin(), own.end());
  });
  return edges;
}

Rational Along(const ConeEdge& edge, const ExactMatrix& A, int i) {
  Rational sum = 0;
  for (std::size_t k = 0; k < edge.values.size(); ++k)
    sum += A(i, edge.row + static_cast<int>(k)) * edge.values[k];
  return sum;
}

Rational Along(const ConeEdge& edge, const ExactVector& values) {
  Rational sum = 0;
  for (std::size_t k = 0; k < edge.values.size(); ++k)
    sum += values[edge.row + static_cast<int>(k)] * edge.values[k];
  return sum;
}

ExactVector Combined(const std::vector<ConeEdge>& edges, const Point& x, int rows) {
  ExactVector sum = ExactVector::Constant(rows, Rational(0));
  for (std::size_t j = 0; j < edges.size(); ++j) {
    if (x[j] == 0) continue;
    for (std::size_t k = 0; k < edges[j].values.size(); ++k)
      sum[edges[j].row + static_cast<int>(k)] += x[j] * edges[j].values[k];
  }
  return sum;
}

bool AddCorners(const ExactProblem& problem, EdgesOf which, const ExactVector& x, RationalPolygons& polygons) {
  const int sign = which == EdgesOf::kAroundCone ? 1 : -1;
  bool added = false;
  ForEachContact(problem, [&](int i, int row, int) {
    const Contact<Rational>& contact = problem.contacts[i];
    const bool round = contact.kind == ContactKind::kStatic && contact.mu > 0;
    if (round && !IsWithin(contact.mu, which == EdgesOf::kWithinCone, x, row)) {
      const Planar<Rational> tangent = TangentialOf(x, row);
      added |= AddCorner({Rational(sign * tangent[0]), Rational(sign * tangent[1])}, polygons[i]);
    }
  });
  return added;
}

}  // namespace stiction
