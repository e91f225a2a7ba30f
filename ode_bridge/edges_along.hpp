// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ode_bridge/separation.hpp"

namespace carom::ode_bridge_detail {

/// Whether the faces beside an edge fall away from a contact, n outward in the axes of the solid.
bool fallsAway(const Solid& solid, const SolidEdge& edge, const Vec3& n);

/// Two sharp edges that lie along each other may push along any normal in the cones of both, which reach from one face
/// beside them to another one: the outermost of these normals, from b to a; none where there is but one, or no such edges.
/// n separates the pieces, so that such edges lie in front along it.
std::vector<Vec3> normalsAlongEdges(const PlacedPiece& a, const PlacedPiece& b, const Vec3& n, double tolerance, double scale);

}  // namespace carom::ode_bridge_detail
