// SPDX-License-Identifier: MIT
#include "formats/gltf/write/buffer.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string_view>

#include "adjoint/base/errors.h"
#include "formats/gltf/axes.hpp"

namespace carom::formats_detail {
namespace {

constexpr int kNoTarget = 0;

std::size_t hashOf(const void* data, std::size_t bytes) {
  return std::hash<std::string_view>()({static_cast<const char*>(data), bytes});
}

std::vector<float> flat(const std::vector<Vec3>& vectors) {
  std::vector<float> out;
  out.reserve(3 * vectors.size());
  for (const Vec3& v : vectors)
    for (const double number : gltf::yUp(v)) out.push_back(static_cast<float>(number));
  return out;
}

}  // namespace

int GltfBuffer::addTimes(const std::vector<float>& times, const std::string& what) {
  return addFloats(times, 1, TINYGLTF_TYPE_SCALAR, kNoTarget, true, what);
}

int GltfBuffer::addVectors(const std::vector<Vec3>& vectors, const std::string& what) {
  return addFloats(flat(vectors), 3, TINYGLTF_TYPE_VEC3, kNoTarget, false, what);
}

int GltfBuffer::addQuaternions(const std::vector<Quat>& quaternions, const std::string& what) {
  std::vector<float> numbers;
  numbers.reserve(4 * quaternions.size());
  for (const Quat& ours : quaternions) {
    const Quat q = gltf::yUp(ours);
    for (const double number : {q.x(), q.y(), q.z(), q.w()}) numbers.push_back(static_cast<float>(number));
  }
  return addFloats(numbers, 4, TINYGLTF_TYPE_VEC4, kNoTarget, false, what);
}

int GltfBuffer::addVertices(const std::vector<Vec3>& vertices, const std::string& what) {
  return addFloats(flat(vertices), 3, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER, true, what);
}

int GltfBuffer::addIndices(const std::vector<std::uint32_t>& indices) {
  const std::size_t bytes = indices.size() * sizeof(std::uint32_t);
  constexpr int kTarget = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  if (const int found = findShared(indices.data(), bytes, kTarget); found >= 0) return found;
  tinygltf::Accessor accessor;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = indices.size();
  return addAccessor(accessor, indices.data(), bytes, kTarget);
}

int GltfBuffer::addDoubles(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  std::vector<Vec3> turned;
  turned.reserve(vectors.size());
  for (const Vec3& v : vectors) turned.push_back(gltf::yUp(v));
  return addView(turned.data(), turned.size() * sizeof(Vec3), kNoTarget);
}

int GltfBuffer::addFloats(const std::vector<float>& numbers, int width, int type, int target, bool bounds,
                          const std::string& what) {
  for (const float number : numbers)
    if (!std::isfinite(number)) throw InputError(what, "a number is too large for glTF's floats, or not finite");
  const std::size_t bytes = numbers.size() * sizeof(float);
  if (const int found = findShared(numbers.data(), bytes, target); found >= 0) return found;
  tinygltf::Accessor accessor;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = type;
  accessor.count = numbers.size() / static_cast<std::size_t>(width);
  if (bounds && !numbers.empty()) {
    accessor.minValues.assign(numbers.begin(), numbers.begin() + width);
    accessor.maxValues = accessor.minValues;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      double& low = accessor.minValues[i % static_cast<std::size_t>(width)];
      double& high = accessor.maxValues[i % static_cast<std::size_t>(width)];
      low = std::min(low, static_cast<double>(numbers[i]));
      high = std::max(high, static_cast<double>(numbers[i]));
    }
  }
  return addAccessor(accessor, numbers.data(), bytes, target);
}

int GltfBuffer::findShared(const void* data, std::size_t bytes, int target) const {
  if (target == kNoTarget) return -1;
  const auto [first, last] = shared_.equal_range(hashOf(data, bytes));
  for (auto it = first; it != last; ++it) {
    const auto& accessor = model_.accessors[static_cast<std::size_t>(it->second)];
    const auto& view = model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    if (view.target == target && view.byteLength == bytes &&
        std::memcmp(model_.buffers[0].data.data() + view.byteOffset, data, bytes) == 0)
      return it->second;
  }
  return -1;
}

int GltfBuffer::addAccessor(const tinygltf::Accessor& accessor, const void* data, std::size_t bytes, int target) {
  const int index = static_cast<int>(model_.accessors.size());
  model_.accessors.push_back(accessor);
  model_.accessors.back().bufferView = addView(data, bytes, target);
  if (target != kNoTarget) shared_.emplace(hashOf(data, bytes), index);
  return index;
}

int GltfBuffer::addView(const void* data, std::size_t bytes, int target) {
  if (model_.buffers.empty()) model_.buffers.emplace_back();
  auto& store = model_.buffers[0].data;
  tinygltf::BufferView view;  // every array is of four-byte numbers, so all views stay aligned
  view.buffer = 0;
  view.byteOffset = store.size();
  view.byteLength = bytes;
  view.target = target;
  store.resize(store.size() + bytes);
  std::memcpy(store.data() + view.byteOffset, data, bytes);
  model_.bufferViews.push_back(view);
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

}  // namespace carom::formats_detail
