// SPDX-License-Identifier: MIT
#include "formats/gltf/write/look.hpp"

#include <tiny_gltf.h>

#include <variant>

#include "formats/drawing/triangle_mesh.hpp"
#include "formats/gltf/axes.hpp"

namespace carom::formats_detail {

void setPose(tinygltf::Node& node, const Vec3& ours, const Quat& our_axes) {
  const Vec3 x = gltf::yUp(ours);
  const Quat q = gltf::yUp(our_axes);
  node.translation = {x.x(), x.y(), x.z()};
  node.rotation = {q.x(), q.y(), q.z(), q.w()};
}

int GltfLook::body(int index, double alpha) {
  const auto [entry, added] = bodies_.emplace(std::pair(index, alpha), 0);
  if (!added) return entry->second;
  const Body& b = scene_.bodies[static_cast<std::size_t>(index)];
  Tint tint{bodyColour(scene_, index), alpha};
  if (b.fixed) tint.roughness = 0.9;
  tint.both_sides = kindOf(b.shape).endless;
  return entry->second = shape(b.shape, b.name + (alpha < 1 ? " ghost" : ""), tint);
}

int GltfLook::shape(const Shape& shape, const std::string& name, const Tint& tint) {
  const TriangleMesh triangles = meshOf(shape, plane_half_width_);
  const std::string place = "body '" + name + "'";
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = buffer_.addVertices(triangles.positions, place);
  primitive.attributes["NORMAL"] = buffer_.addVertices(triangles.normals, place);
  primitive.indices = buffer_.addIndices(triangles.triangles);
  primitive.material = addMaterial(name, tint);
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives.push_back(primitive);
  if (!triangles.accent.empty()) {
    Tint accent = tint;
    accent.colour = tint.colour.mixedWith({1, 1, 1}, 0.55);
    primitive.indices = buffer_.addIndices(triangles.accent);
    primitive.material = addMaterial(name + " accent", accent);
    mesh.primitives.push_back(primitive);
  }
  return append(model_.meshes, mesh);
}

int GltfLook::addMaterial(const std::string& name, const Tint& tint) {
  tinygltf::Material material;
  material.name = name;
  const auto [r, g, b] = tint.colour.linear();
  material.pbrMetallicRoughness.baseColorFactor = {r, g, b, tint.alpha};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = tint.roughness;
  if (tint.alpha < 1) material.alphaMode = "BLEND";
  material.doubleSided = tint.both_sides;
  return append(model_.materials, material);
}

}  // namespace carom::formats_detail
