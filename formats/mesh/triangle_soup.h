// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "adjoint/base/types.h"

namespace carom {

// Larger files are refused: another kind of file, or one that would exhaust memory.
inline constexpr std::size_t kLargestMeshFile = 200'000'000;  ///< bytes, with the buffers that it names
inline constexpr std::size_t kMostVertices = 5'000'000;       ///< of a mesh
inline constexpr std::size_t kMostTriangles = 5'000'000;      ///< of a mesh

/// Triangles as in the file, with only their indices checked; counter-clockwise seen from outside.
struct TriangleSoup {
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
  std::vector<int> lines;  ///< in the file, one per triangle; empty if it has no lines
  std::vector<std::string> repairs = {};  ///< what of the file was left out or changed, a phrase each
};

}  // namespace carom
