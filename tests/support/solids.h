// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "adjoint/scene/surface.h"

/// Triangles of solids whose mass properties are known.
namespace carom::test {

struct Triangles {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;

  std::shared_ptr<const Surface> surface() const { return meshSurface(vertices, triangles); }
  /// Each vertex turned, then moved.
  Triangles placed(const Quat& turn, const Vec3& move) const;
  /// Both, apart or not.
  Triangles with(const Triangles& other) const;
  /// Its triangles seen from the other side.
  Triangles insideOut() const;
};

/// Centred on the origin, two triangles a side.
Triangles boxTriangles(const Vec3& size);
/// An icosahedron with its triangles split in four `level` times and its vertices on the ball.
Triangles ballTriangles(double radius, int level);
/// Ring about z: `around` sections of `across` corners at distance `tube` from a circle of radius `ring`.
Triangles torusTriangles(double ring, double tube, int around, int across);
Triangles tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace carom::test
