// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "adjoint/base/types.h"
#include "formats/base/format_error.h"

namespace carom {

/// What is larger is refused: a file of another kind, or one that would take the machine down.
inline constexpr std::size_t kLargestMeshFile = 200'000'000;  // bytes, with the buffers that it names
inline constexpr std::size_t kMostVertices = 5'000'000;
inline constexpr std::size_t kMostTriangles = 5'000'000;

/// Triangles as a file has them, unchecked but for indices in range: corners counter-clockwise seen from outside.
struct TriangleSoup {
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> lines;  ///< of the file, one a triangle; empty where it has no lines
};

/// Reads a mesh by the ending of its name: .obj (axes as they are), .gltf or .glb (y up turned to z up, all triangles
/// of the default scene). Throws FormatError with the path, and the line or the JSON pointer inside the file.
TriangleSoup readMeshFile(const std::string& path);

/// The points that a hull is made of: all vertices of a file's triangles, or all its vertices where it has none.
std::vector<Vec3> readPointsFile(const std::string& path);

}  // namespace carom
