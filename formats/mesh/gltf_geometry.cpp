// SPDX-License-Identifier: MIT
#include "formats/mesh/gltf_geometry.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>

#include "adjoint/base/errors.h"
#include "formats/json/json.hpp"
#include "formats/mesh/draco_mesh.hpp"
#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian");

/// The elements of an accessor, which checkGltf has found to lie within their buffers.
class Elements {
 public:
  Elements(const tinygltf::Model& model, int accessor)
      : accessor_(model.accessors[static_cast<std::size_t>(accessor)]) {
    const auto components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(unsigned(accessor_.type)));
    size_ = components * sizeOf(accessor_.componentType);
    if (accessor_.bufferView >= 0) {
      data_ = bytesOf(model, accessor_.bufferView) + accessor_.byteOffset;
      const std::size_t stride = model.bufferViews[static_cast<std::size_t>(accessor_.bufferView)].byteStride;
      stride_ = stride == 0 ? size_ : stride;
    }
    if (accessor_.sparse.isSparse) readReplaced(model);
  }

  std::size_t count() const { return accessor_.count; }

  Vec3 position(std::size_t i) const {
    const unsigned char* from = element(i);
    switch (accessor_.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return vector<std::int8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return vector<std::uint8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return vector<std::int16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return vector<std::uint16_t>(from);
      default:
        return vector<float>(from);
    }
  }

  std::uint32_t index(std::size_t i) const {
    const unsigned char* from = element(i);
    return from == nullptr ? 0 : integerAt(from, accessor_.componentType);
  }

 private:
  /// Integers of quantised positions count from -1 to 1, or from 0 to 1, where they are normalised.
  template <class Number>
  Vec3 vector(const unsigned char* from) const {
    Number numbers[3] = {};
    if (from != nullptr) std::memcpy(numbers, from, sizeof numbers);
    Vec3 v(numbers[0], numbers[1], numbers[2]);
    if (std::is_integral_v<Number> && accessor_.normalized)
      v = (v / static_cast<double>(std::numeric_limits<Number>::max())).cwiseMax(-1);
    return v;
  }

  static std::size_t sizeOf(int component) {
    return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(component)));
  }

  static const unsigned char* bytesOf(const tinygltf::Model& model, int view) {
    const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(view)];
    return model.buffers[static_cast<std::size_t>(v.buffer)].data.data() + v.byteOffset;
  }

  static std::uint32_t integerAt(const unsigned char* from, int component) {
    std::uint32_t value = 0;
    std::memcpy(&value, from, sizeOf(component));
    return value;
  }

  void readReplaced(const tinygltf::Model& model) {
    const auto& sparse = accessor_.sparse;
    const unsigned char* indices = bytesOf(model, sparse.indices.bufferView) + sparse.indices.byteOffset;
    for (int i = 0; i < sparse.count; ++i) {
      replaced_.push_back(integerAt(indices, sparse.indices.componentType));
      indices += sizeOf(sparse.indices.componentType);
    }
    for (std::size_t i = 0; i < replaced_.size(); ++i)
      if (replaced_[i] >= count() || (i > 0 && replaced_[i] <= replaced_[i - 1]))
        fail("/sparse/indices", "element " + std::to_string(replaced_[i]),
             "increasing ones below " + std::to_string(count()));
    replacements_ = bytesOf(model, sparse.values.bufferView) + sparse.values.byteOffset;
  }

  /// Bytes of an element; null for one that nothing is given for, which is 0.
  const unsigned char* element(std::size_t i) const {
    const auto found = std::lower_bound(replaced_.begin(), replaced_.end(), i);
    if (found != replaced_.end() && *found == i)
      return replacements_ + size_ * static_cast<std::size_t>(found - replaced_.begin());
    return data_ == nullptr ? nullptr : data_ + stride_ * i;
  }

  const tinygltf::Accessor& accessor_;
  std::size_t size_ = 0, stride_ = 0;  // bytes
  const unsigned char* data_ = nullptr;
  std::vector<std::uint32_t> replaced_;  // increasing
  const unsigned char* replacements_ = nullptr;
};

/// Runs a function and puts `where` before the places that its errors name.
template <class Function>
auto within(const std::string& where, Function function) {
  try {
    return function();
  } catch (const InputError& error) {
    throw InputError(where + error.where(), error.message());
  }
}

/// The accessor of the vertices, which has numbers that are read.
int positionAccessor(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto attribute = primitive.attributes.find("POSITION");
  if (attribute == primitive.attributes.end()) fail("/attributes", "no \"POSITION\"", "one");
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(attribute->second)];
  const auto& used = model.extensionsUsed;
  const bool quantised = std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
  const bool integers = quantised && accessor.componentType >= TINYGLTF_COMPONENT_TYPE_BYTE &&
                        accessor.componentType <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  if (accessor.type != TINYGLTF_TYPE_VEC3 || !(integers || accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT))
    fail("/attributes/POSITION", "component type " + std::to_string(accessor.componentType),
         "vectors of 3 floats (VEC3 of 5126), or of integers with the extension KHR_mesh_quantization");
  return attribute->second;
}

Elements positionsOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const int accessor = positionAccessor(model, primitive);
  return within("/attributes/POSITION", [&] { return Elements(model, accessor); });
}

/// What normalised integers are divided by; 1 for other numbers.
double normalisedBy(const tinygltf::Accessor& accessor) {
  if (!accessor.normalized || accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return 1;
  const int bits = 8 * tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(accessor.componentType));
  const bool is_signed = accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE || accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
  return static_cast<double>((std::uint64_t{1} << (is_signed ? bits - 1 : bits)) - 1);
}

/// The vertices along the primitive, one after another, by the numbers that POSITION has them under.
std::vector<std::uint32_t> orderOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                   std::size_t vertices) {
  std::vector<std::uint32_t> order;
  const auto require_few = [](std::size_t count) {
    if (count > 3 * kMostTriangles)
      fail("", std::to_string(count) + " corners", "at most " + std::to_string(3 * kMostTriangles));
  };
  if (primitive.indices < 0) {
    require_few(vertices);
    for (std::size_t i = 0; i < vertices; ++i) order.push_back(static_cast<std::uint32_t>(i));
    return order;
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(primitive.indices)];
  const int type = accessor.componentType;
  if (accessor.type != TINYGLTF_TYPE_SCALAR ||
      (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
       type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
    fail("/indices", "component type " + std::to_string(type), "unsigned scalars (5121, 5123 or 5125)");
  const Elements indices = within("/indices", [&] { return Elements(model, primitive.indices); });
  require_few(indices.count());
  for (std::size_t i = 0; i < indices.count(); ++i) {
    order.push_back(indices.index(i));
    if (order.back() >= vertices)
      fail("/indices", "vertex " + std::to_string(order.back()) + " at place " + std::to_string(i),
           "one below " + std::to_string(vertices));
  }
  return order;
}

using Corners = std::array<std::uint32_t, 3>;

/// Corners counter-clockwise. Triangles with a corner twice, which strips use to jump, are left out of strips and fans.
std::vector<Corners> cornersOf(int mode, const std::vector<std::uint32_t>& order) {
  static constexpr const char* kModes[] = {
      "points", "lines", "a line loop", "a line strip", "triangles", "a triangle strip", "a triangle fan"};
  if (mode < TINYGLTF_MODE_TRIANGLES) fail("/mode", kModes[mode], "triangles, a triangle strip or a triangle fan");
  const bool list = mode == TINYGLTF_MODE_TRIANGLES;
  if (order.size() < 3 || (list && order.size() % 3 != 0))
    fail("", std::string(kModes[mode]) + " of " + std::to_string(order.size()) + " corners",
         list ? "three a triangle" : "three or more");
  std::vector<Corners> corners;
  const std::size_t count = list ? order.size() / 3 : order.size() - 2;
  for (std::size_t t = 0; t < count; ++t) {
    Corners c;
    if (list) {
      c = {order[3 * t], order[3 * t + 1], order[3 * t + 2]};
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      c = {order[t], order[t + 1 + t % 2], order[t + 2 - t % 2]};
    } else {
      c = {order[t + 1], order[t + 2], order[0]};
    }
    if (list || (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])) corners.push_back(c);
  }
  return corners;
}

void requireRigid(const std::vector<double>& weights) {
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; }))
    fail("/weights", "a morphed mesh", "weights of 0 or none");
}

/// Which vertices the corners of a primitive are, and where these are.
struct Geometry {
  std::vector<Corners> corners;
  std::function<Vec3(std::uint32_t)> position;
};

Geometry plainGeometry(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto positions = std::make_shared<const Elements>(positionsOf(model, primitive));
  return {cornersOf(primitive.mode, orderOf(model, primitive, positions->count())),
          [positions](std::uint32_t i) { return positions->position(i); }};
}

/// Of a primitive compressed by Draco: its accessors say how much there is, and of what kind it was.
Geometry dracoGeometry(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const tinygltf::Value& extension) {
  if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP)
    fail("/mode", std::to_string(primitive.mode), "triangles (4) or a triangle strip (5), which Draco compresses");
  const tinygltf::Accessor& positions = model.accessors[static_cast<std::size_t>(positionAccessor(model, primitive))];
  const int kept = extension.Has("indices") ? extension.Get("indices").GetNumberAsInt() : primitive.indices;  // see gltf_load.cpp
  if (kept < 0) fail("", "a compressed mesh without \"indices\"", "an accessor that says how many there are");
  const tinygltf::Accessor& indices = model.accessors[static_cast<std::size_t>(kept)];
  const auto view = static_cast<std::size_t>(extension.Get("bufferView").GetNumberAsInt());
  const auto id = static_cast<std::uint32_t>(extension.Get("attributes").Get("POSITION").GetNumberAsInt());
  const tinygltf::BufferView& v = model.bufferViews[view];
  const std::span<const unsigned char> bytes(model.buffers[static_cast<std::size_t>(v.buffer)].data.data() + v.byteOffset, v.byteLength);
  return within(std::string("/extensions/") + kDracoCompression, [&] {
    const auto mesh = std::make_shared<const DracoMesh>(decodeDraco(bytes, id, positions.count, indices.count, normalisedBy(positions)));
    Geometry geometry{{}, [mesh](std::uint32_t i) { return mesh->positions[i]; }};
    for (std::size_t t = 0; t + 2 < mesh->triangles.size(); t += 3)
      geometry.corners.push_back({mesh->triangles[t], mesh->triangles[t + 1], mesh->triangles[t + 2]});
    return geometry;
  });
}

/// As it is compressed, or as it is given beside that for those who do not read it.
Geometry geometryOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto draco = primitive.extensions.find(kDracoCompression);
  if (draco == primitive.extensions.end()) return plainGeometry(model, primitive);
  if (readsDraco()) return dracoGeometry(model, primitive, draco->second);
  const bool beside = model.accessors[static_cast<std::size_t>(positionAccessor(model, primitive))].bufferView >= 0;
  if (beside && !draco->second.Has("indices")) return plainGeometry(model, primitive);
  fail(std::string("/extensions/") + kDracoCompression, "a compressed mesh", "one without compression: this carom was built without Draco");
}

void appendPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                     const Eigen::Affine3d& transform, std::vector<Vec3>& vertices,
                     std::vector<std::array<int, 3>>& triangles) {
  const Geometry geometry = geometryOf(model, primitive);
  const std::vector<Corners>& corners = geometry.corners;
  std::vector<std::uint32_t> used;
  for (const Corners& c : corners) used.insert(used.end(), c.begin(), c.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (vertices.size() + used.size() > kMostVertices || triangles.size() + corners.size() > kMostTriangles)
    fail("", "more triangles or vertices",
         "at most " + std::to_string(kMostTriangles) + " triangles and " + std::to_string(kMostVertices) + " vertices");

  const std::size_t first = vertices.size();
  for (const std::uint32_t vertex : used) {
    const Vec3 p = geometry.position(vertex);
    if (!p.allFinite())
      fail("/attributes/POSITION", "numbers that are not finite in element " + std::to_string(vertex), "finite ones");
    vertices.push_back(transform * p);
  }
  const bool mirrors = transform.linear().determinant() < 0;
  for (const Corners& c : corners) {
    std::array<int, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto place = std::lower_bound(used.begin(), used.end(), c[mirrors ? 2 - k : k]);
      triangle[k] = static_cast<int>(first + static_cast<std::size_t>(place - used.begin()));
    }
    triangles.push_back(triangle);
  }
}

}  // namespace

Mat3 zUpFromYUp() {
  Mat3 turn;
  turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

Eigen::Affine3d nodeTransform(const tinygltf::Node& node, const std::string& where) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (!node.matrix.empty()) {
    const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      fail(where + "/matrix", "a last row that is not 0, 0, 0, 1", "an affine transform");
    transform.matrix() = matrix;
  } else {
    const auto vector = [](const std::vector<double>& v, double otherwise) {
      return v.empty() ? Vec3(Vec3::Constant(otherwise)) : Vec3(v[0], v[1], v[2]);
    };
    Quat q = Quat::Identity();
    if (const auto& r = node.rotation; !r.empty()) q = Quat(r[3], r[0], r[1], r[2]);
    constexpr double kRounded = 1e-3;  // floats, or numbers that were printed with few digits
    if (!(std::abs(q.norm() - 1) <= kRounded))
      fail(where + "/rotation", "a quaternion of length " + std::to_string(q.norm()), "a unit quaternion");
    transform.translation() = vector(node.translation, 0);
    transform.linear() = q.normalized().toRotationMatrix() * vector(node.scale, 1).asDiagonal();
  }
  const double determinant = transform.linear().determinant();
  if (!transform.matrix().allFinite() || !std::isfinite(determinant) || determinant == 0)
    fail(where, "a transform that flattens what is in it", "a scale that is not 0");
  return transform;
}

void appendMeshTriangles(const tinygltf::Model& model, int mesh, const Eigen::Affine3d& transform,
                         std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles,
                         const std::string& where) {
  const auto index = static_cast<std::size_t>(mesh);
  const tinygltf::Mesh& m = model.meshes.at(index);
  const std::string place = where + pointerTo("/meshes", index);
  within(place, [&] { requireRigid(m.weights); });
  for (std::size_t i = 0; i < m.primitives.size(); ++i)
    within(pointerTo(place + "/primitives", i),
           [&] { appendPrimitive(model, m.primitives[i], transform, vertices, triangles); });
}

}  // namespace carom::formats_detail
