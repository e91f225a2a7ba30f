// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/base/format_error.h"
#include "formats/mesh/triangle_soup.h"

namespace carom {

/// Reads a mesh by the ending of its name: .obj (axes as they are), .gltf or .glb (y up turned to z up, all triangles
/// of the default scene). Throws FormatError with the path, and the line or the JSON pointer inside the file.
TriangleSoup readMeshFile(const std::string& path);

/// The points that a hull is made of: all vertices of a file's triangles, or all its vertices where it has none.
std::vector<Vec3> readPointsFile(const std::string& path);

}  // namespace carom
