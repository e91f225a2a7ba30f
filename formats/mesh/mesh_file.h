// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/base/format_error.h"
#include "formats/mesh/triangle_soup.h"

namespace carom {

/// Reads a mesh by its file extension: .obj (axes as written), .gltf or .glb (y up converted to z up, all triangles
/// of the default scene). Throws FormatError with the path, and the line or the JSON pointer inside the file.
TriangleSoup readMeshFile(const std::string& path);

/// The points of a hull: all vertices of a file's triangles, or all its vertices if it has no triangles.
std::vector<Vec3> readPointsFile(const std::string& path);

}  // namespace carom
