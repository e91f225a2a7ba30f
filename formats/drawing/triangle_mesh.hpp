// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::formats_detail {

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

// ---- for the rows of shapes ----

/// A circle about z of a surface of revolution, with the surface's normal there (outwards, upwards).
struct Ring {
  double radius = 0, z = 0;
  Vec2 normal{0, 1};
};

/// The surface through the rings, which run from its top to its bottom. Rings in one place part it: an edge between
/// them.
TriangleMesh revolved(const std::vector<Ring>& rings);
/// Half of a ball's rings, from its pole to its equator (top) or from its equator to its pole.
void addHalfBall(std::vector<Ring>& rings, double radius, double centre, bool top);
/// Four corners about `centre`, spanned by u and v with u x v outwards.
void addFace(TriangleMesh& mesh, const Vec3& centre, const Vec3& u, const Vec3& v);
TriangleMesh surfaceMesh(const Surface& surface, double scale);
/// Adds a part at its pose.
void append(TriangleMesh& whole, const TriangleMesh& part, const Vec3& x, const Quat& q);

/// Adds the faces of a hull or mesh, coordinates times `scale`.
void addSurface(TriangleMesh& mesh, const Surface& surface, double scale);

}  // namespace carom::formats_detail
