// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom {

/// Triangles of one surface, counter-clockwise seen from outside; `accent` triangles take a second shade, so that the
/// turning of a round body can be seen.
struct TriangleMesh {
  std::vector<Vec3> positions, normals;
  std::vector<std::uint32_t> triangles, accent;
};

/// Mesh of a shape in its own axes: round shapes inscribed, hulls and meshes as they are, compounds part by part (parts
/// that overlap stay apart). Round surfaces and shallow edges have smooth normals, others flat ones. A plane becomes a
/// square of the given half width in x and y about the origin, facing +z, whatever its normal: that is its node's turn.
TriangleMesh meshOf(const Shape& shape, double plane_half_width);

/// Adds the faces of a hull or mesh, coordinates times `scale`.
void addSurface(TriangleMesh& mesh, const Surface& surface, double scale);

}  // namespace carom
