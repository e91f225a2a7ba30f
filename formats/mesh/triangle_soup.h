// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "adjoint/base/types.h"

namespace carom {

// What is larger is refused: a file of another kind, or one that would take the machine down.
inline constexpr std::size_t kLargestMeshFile = 200'000'000;  ///< bytes, with the buffers that it names
inline constexpr std::size_t kMostVertices = 5'000'000;       ///< of a mesh
inline constexpr std::size_t kMostTriangles = 5'000'000;      ///< of a mesh

/// Triangles as a file has them, unchecked but for indices in range: corners counter-clockwise seen from outside.
struct TriangleSoup {
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
  std::vector<int> lines;  ///< of the file, one a triangle; empty where it has no lines
};

}  // namespace carom
