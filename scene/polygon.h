// SPDX-License-Identifier: Apache-2.0
// Pieces of bodies in the plane: polygons, their corners anticlockwise and strictly convex, and discs.

#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace stiction {

// What is wrong with a polygon, or nothing: three corners at least, anticlockwise, strictly convex. Decided
// exactly.
std::string PolygonFault(const std::vector<Vector2<mpq_class>>& polygon);

MassPropertiesIn<Plane> MassPropertiesOf(const std::vector<BodyShape<mpq_class>>& shapes);

}  // namespace stiction
