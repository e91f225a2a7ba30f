// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "adjoint/base/types.h"

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace carom::formats_detail {

/// Appends arrays to the one buffer of a model and returns the index of the accessor of each. Vectors and rotations are
/// given in our axes, z up, and stored in glTF's, y up (frame.hpp). Vertices and indices that
/// are there already, as those of equal bodies, are used again. Throws InputError, with `what` as the place, for a
/// number that is not finite as a float.
class GltfBuffer {
 public:
  explicit GltfBuffer(tinygltf::Model& model) : model_(model) {}

  int addTimes(const std::vector<float>& times, const std::string& what);
  int addVectors(const std::vector<Vec3>& vectors, const std::string& what);
  int addQuaternions(const std::vector<Quat>& quaternions, const std::string& what);  ///< stored x, y, z, w
  int addVertices(const std::vector<Vec3>& vertices, const std::string& what);
  int addIndices(const std::vector<std::uint32_t>& indices);

  /// Appends coordinates as doubles, which no accessor can name. Returns the index of the buffer view.
  int addDoubles(const std::vector<Vec3>& vectors);

 private:
  int addFloats(const std::vector<float>& numbers, int width, int type, int target, bool bounds,
                const std::string& what);
  int addView(const void* data, std::size_t bytes, int target);
  int findShared(const void* data, std::size_t bytes, int target) const;  ///< accessor, -1 if there is none
  int addAccessor(const tinygltf::Accessor& accessor, const void* data, std::size_t bytes, int target);

  tinygltf::Model& model_;
  std::unordered_multimap<std::size_t, int> shared_;  // accessors of vertices and indices by the hash of their bytes
};

}  // namespace carom::formats_detail
