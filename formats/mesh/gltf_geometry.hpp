// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "adjoint/base/types.h"
#include "formats/json/json.hpp"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace carom::formats_detail {

/// glTF's axes (y up) to ours (z up): (x, y, z) -> (x, -z, y).
Mat3 zUpFromYUp();

/// Reads the bytes of a .gltf or .glb file with the buffers that it names, which are searched in `folder`; which of the
/// two it is, its first bytes say. Images, textures, materials, samplers, cameras, animations and skins are left out of
/// the model. All indices, types and lengths in the rest are checked: every index of a node, mesh, accessor, view or
/// buffer is in range, every accessor lies within its view, every view within its buffer, and no node is its own
/// ancestor. Throws InputError with the JSON pointer.
tinygltf::Model parseGltf(std::string_view bytes, const std::string& folder);

/// The document of a .gltf or .glb file as it is written, unchecked.
Json gltfJson(std::string_view bytes);

/// Transform of a node relative to its parent. Throws InputError, at `where`, for a matrix or numbers that no rigid
/// body can have: singular, not affine, a rotation that is no unit quaternion.
Eigen::Affine3d nodeTransform(const tinygltf::Node& node, const std::string& where);

/// Appends all triangles of a mesh (lists, strips and fans), its vertices taken through `transform`; vertices that no
/// triangle uses are left out. Triangles stay counter-clockwise seen from outside when `transform` mirrors. The model
/// must come from parseGltf. Throws InputError whose place is `where` followed by the JSON pointer:
/// primitives of points or lines, positions that are not floats, compressed or morphed meshes, indices out of range,
/// more than kMostVertices or kMostTriangles (formats/mesh/mesh_file.h).
void appendMeshTriangles(const tinygltf::Model& model, int mesh, const Eigen::Affine3d& transform,
                         std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles,
                         const std::string& where);

}  // namespace carom::formats_detail
