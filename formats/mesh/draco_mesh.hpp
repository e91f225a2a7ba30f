// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adjoint/base/types.h"

/// Private to formats/*.cpp.
namespace carom::formats_detail {

inline constexpr const char* kDracoCompression = "KHR_draco_mesh_compression";

/// Whether meshes compressed by KHR_draco_mesh_compression are read: the library was there when carom was configured.
bool readsDraco();

/// A decompressed mesh.
struct DracoMesh {
  std::vector<Vec3> positions;          ///< by vertex
  std::vector<std::uint32_t> triangles;  ///< three vertices each, all of them within `positions`
};

/// The triangles of a mesh compressed by Draco (bitstream 2.2, as the extension has it), and the attribute of that unique
/// id, whose numbers are divided by `divisor` (of normalised integers; 1 of others). The counts are those of the accessors
/// that the mesh is for: they are compared before anything is decoded, so that a broken file cannot ask for more memory.
/// Throws InputError without a place.
DracoMesh decodeDraco(std::span<const unsigned char> bytes, std::uint32_t positions_id, std::uint64_t vertices,
                      std::uint64_t corners, double divisor);

}  // namespace carom::formats_detail
