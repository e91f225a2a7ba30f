// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "adjoint/base/types.h"

namespace carom {

/// Polygons with shared vertices: the boundary of a convex hull, or a triangle mesh. Immutable; validated by the
/// functions that construct it.
struct Surface {
  /// A flat polygon: corners[first .. first + count), counter-clockwise seen from outside.
  struct Face {
    int first = 0;                ///< its first corner
    int count = 0;                ///< of its corners
    Vec3 normal = Vec3::UnitZ();  ///< unit, outward
  };
  /// An edge between two faces, or on the boundary (`right` is -1).
  struct Edge {
    int from = 0;     ///< vertex; `left` runs along the edge from here
    int to = 0;       ///< vertex where it ends
    int left = -1;    ///< face
    int right = -1;   ///< face on the other side; -1 on the boundary
    double bend = 0;  ///< signed sine of the angle between the normals: > 0 convex, 0 flat, < 0 reflex
  };

  std::vector<Vec3> vertices;  ///< m
  std::vector<int> corners;    ///< indices of vertices, face after face
  std::vector<Face> faces;     ///< polygons
  std::vector<Edge> edges;     ///< each once
  bool closed = false;  ///< every edge has two faces

  // Of a closed surface, by the divergence theorem, at uniform density.
  double volume = 0;                 ///< m^3
  Vec3 center = Vec3::Zero();        ///< m
  Mat3 unit_inertia = Mat3::Zero();  ///< about the centre, per unit mass, m^2

  /// Corner i of a face, m.
  const Vec3& corner(const Face& face, int i) const {
    return vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>(face.first + i)])];
  }
};

/// Smallest allowed edge length of a mesh and dimension of a hull, m: the fifth powers in the integrals and the
/// squares of areas then stay far within the range of a double.
inline constexpr double kLeastLength = 1e-30;

/// Triangle mesh. Coincident vertices are merged. Throws InputError naming the vertex, triangle or edge: an empty
/// mesh, numbers not finite or above 1e9, indices out of range, edges below kLeastLength, triangles without area,
/// non-manifold or inconsistently oriented edges, a closed mesh inside out.
std::shared_ptr<const Surface> meshSurface(const std::vector<Vec3>& vertices,
                                           const std::vector<std::array<int, 3>>& triangles);

/// Surface from polygons whose corners are already shared and counter-clockwise; fills in normals, edges and
/// integrals. The normal of a polygon without area is zero, which the caller must check. Throws InputError for
/// polygons of fewer than three corners and invalid vertex indices.
Surface assembleSurface(std::vector<Vec3> vertices, const std::vector<std::vector<int>>& polygons);

}  // namespace carom
