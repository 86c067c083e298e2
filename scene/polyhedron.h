// SPDX-License-Identifier: Apache-2.0
// Pieces of bodies in space: convex polyhedra and balls.

#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace stiction {

// The convex hull of the corners. `fault` is what keeps them from being the corners of a convex polyhedron
// (fewer than four, all in one plane, one that is none of the hull), or empty. Decided exactly.
struct Polyhedron {
  ShapeInSpace<mpq_class> shape;
  std::string fault;
};
Polyhedron MakePolyhedron(std::vector<Vector3<mpq_class>> corners);

MassPropertiesIn<Space> MassPropertiesOf(const std::vector<ShapeInSpace<mpq_class>>& shapes);

}  // namespace stiction
