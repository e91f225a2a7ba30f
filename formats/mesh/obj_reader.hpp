// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {

/// Reads Wavefront OBJ: vertices `v x y z` (a weight or colours behind them are ignored) and faces `f` of three corners
/// or more, as v, v/vt, v//vn or v/vt/vn (what stands behind a slash may be missing), counted from 1 or, if negative,
/// backwards from the latest vertex; polygons become fans about one of their corners, the first that leaves no triangle
/// without area or turned over, or else triangles of least area (mesh_repair::triangulate); faces of fewer than three
/// corners are left out, which `repairs` tells. Vertices keep their numbers, used or not. Texture
/// coordinates, normals, groups, objects, smoothing, materials, points, lines and comments are ignored; curved surfaces
/// and words that are not OBJ are refused. Coordinates come out as the nearest doubles. Throws InputError whose place
/// is "line 12".
TriangleSoup parseObj(std::string_view text);
/// The vertices that faces use, whatever their shape; all if there are no faces.
std::vector<Vec3> parseObjPoints(std::string_view text);

}  // namespace carom::formats_detail
