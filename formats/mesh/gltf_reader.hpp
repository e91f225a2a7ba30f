// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {

/// The triangles (lists, strips and fans) of all meshes of the default scene of a glTF 2.0 document, text or binary,
/// with the transforms of their nodes, and y up turned to z up: (x, y, z) -> (x, -z, y). Vertices that no triangle uses
/// are left out. Buffers in other files are searched in `folder`. Textures, materials and animations do not matter;
/// skins, weights of morph targets, compressed meshes, positions that are not floats, points and lines are refused.
/// Throws InputError whose place is the JSON pointer.
TriangleSoup parseGltfMesh(std::string_view bytes, const std::string& folder);

}  // namespace carom::formats_detail
