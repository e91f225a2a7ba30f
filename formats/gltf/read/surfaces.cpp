// SPDX-License-Identifier: MIT
// Surfaces of colliders from the meshes of a glTF document.
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "formats/gltf/read/shapes.hpp"
#include "formats/json/json_place.hpp"
#include "formats/mesh/gltf_geometry.hpp"
#include "formats/mesh/repair/mesh_repair.hpp"
#include "ode_bridge/convex_hull.h"

namespace carom::gltf {

using namespace formats_detail;

std::shared_ptr<const Surface> ShapeMaker::surfaceOf(const MeshShape& shape, const Mat3& baked, bool solid) {
  Key key{shape.mesh, shape.node, shape.convex, {}, solid && !shape.convex};
  std::copy(baked.data(), baked.data() + 9, std::get<3>(key).begin());
  auto& surface = made_[key];
  if (!surface) {
    const Triangles soup = trianglesOf(shape, baked);
    if (shape.convex) return surface = convexHull(soup.vertices);
    RepairedSurface made = formats_detail::surfaceOf({soup.vertices, soup.triangles, {}, {}}, solid);
    const std::string place = shape.mesh >= 0 ? "/meshes/" + std::to_string(shape.mesh) : "/nodes/" + std::to_string(shape.node);
    for (const std::string& repair : made.repairs) report_.warnings.push_back("mesh " + place + " was repaired: " + repair);
    surface = std::move(made.surface);
  }
  return surface;
}

ShapeMaker::Triangles ShapeMaker::trianglesOf(const MeshShape& shape, const Mat3& baked) {
  Triangles out;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (shape.mesh >= 0) {
    appendMeshTriangles(model_, shape.mesh, transform, out.vertices, out.triangles, "");
    useExactVertices(shape.mesh, out.vertices);
    for (Vec3& v : out.vertices) v = zUp(v);
    if (!baked.isIdentity(0)) {
      for (Vec3& v : out.vertices) v = baked * v;
      if (baked.determinant() < 0)
        for (auto& triangle : out.triangles) std::swap(triangle[1], triangle[2]);
    }
  } else {
    transform.linear() = baked * zUpFromYUp();
    appendBelow(shape.node, transform, out);
  }
  return out;
}

/// The meshes at a node and below it, down to bodies of their own, in the axes of the node.
void ShapeMaker::appendBelow(int index, const Eigen::Affine3d& transform, Triangles& out) {
  const std::string where = "/nodes/" + std::to_string(index);
  const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
  const auto leave_out = [&](const char* what) {
    report_.warnings.push_back("node '" + node.name + "' (" + where + "): its " + what +
                               " ignored: the mesh collides in its rest pose");
  };
  if (std::any_of(node.weights.begin(), node.weights.end(), [](double w) { return w != 0; }))
    leave_out("morph weights are");
  if (node.skin >= 0) leave_out("skin is");
  if (node.mesh >= 0) appendMeshTriangles(model_, node.mesh, transform, out.vertices, out.triangles, where);
  for (const int child : node.children) {
    const tinygltf::Node& below = model_.nodes[static_cast<std::size_t>(child)];
    const auto physics = below.extensions.find("KHR_physics_rigid_bodies");
    if (physics != below.extensions.end() && physics->second.Has("motion")) continue;
    appendBelow(child, transform * nodeTransform(below, "/nodes/" + std::to_string(child)), out);
  }
}

void ShapeMaker::useExactVertices(int mesh, std::vector<Vec3>& vertices) {
  static_assert(std::endian::native == std::endian::little, "glTF stores little-endian numbers");
  const JsonPlace place = JsonPlace{document_, ""}.require("meshes").at(static_cast<std::size_t>(mesh));
  const auto extras = caromExtrasOf(place);
  const auto positions = extras ? extras->find("positions") : std::nullopt;
  if (!positions) return;
  const auto ignore = [&] {
    report_.warnings.push_back("mesh " + place.pointer +
                               ": the exact positions that carom left beside it are not those of its vertices any "
                               "more; the vertices are used");
  };
  if (!positions->value.is_number_unsigned() || positions->value.get<std::uint64_t>() >= model_.bufferViews.size())
    return ignore();
  const tinygltf::BufferView& view = model_.bufferViews[positions->value.get<std::size_t>()];
  if (view.byteLength != vertices.size() * sizeof(double) * 3) return ignore();
  const unsigned char* data = model_.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset;
  std::vector<Vec3> exact(vertices.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    std::memcpy(exact[i].data(), data + i * sizeof(double) * 3, sizeof(double) * 3);
    if (exact[i].cast<float>() != vertices[i].cast<float>()) return ignore();
  }
  vertices = std::move(exact);
}

}  // namespace carom::gltf
