// SPDX-License-Identifier: MIT
// Colliders for the meshes of a file without physics.
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "adjoint/base/errors.h"
#include "formats/base/short_text.hpp"
#include "formats/gltf/read/other_physics.hpp"
#include "formats/json/json_place.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/gltf_geometry.hpp"

namespace carom::gltf {

using namespace formats_detail;

namespace {

constexpr const char* kPhysics = "KHR_physics_rigid_bodies";

class ColliderMaker {
 public:
  ColliderMaker(Json& document, const tinygltf::Model& model, const ImportOptions& options)
      : document_(document), model_(model), options_(options), named_(options.fixed.size(), 0) {}

  void run() {
    if (model_.scenes.empty()) return;
    struct Visit {
      int node;
      bool fixed;
    };
    std::vector<Visit> visits;
    for (const int root : model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))].nodes) visits.push_back({root, false});
    while (!visits.empty()) {
      const Visit visit = visits.back();
      visits.pop_back();
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(visit.node)];
      const bool fixed = isNamed(node.name) || visit.fixed;
      if (node.mesh >= 0) add(visit.node, node, fixed);
      for (const int child : node.children) visits.push_back({child, fixed});
    }
    requireNames();
  }

 private:
  bool isNamed(const std::string& name) {
    bool found = false;
    for (std::size_t i = 0; i < named_.size(); ++i)
      if (options_.fixed[i] == name) named_[i] = 1, found = true;
    return found;
  }

  void requireNames() const {
    for (std::size_t i = 0; i < named_.size(); ++i) {
      if (named_[i] != 0) continue;
      std::string there;
      for (const tinygltf::Node& node : model_.nodes)
        if (!node.name.empty() && there.size() < 200) there += (there.empty() ? "" : ", ") + quotedText(node.name);
      throw InputError("fixed", "found no node " + quotedText(options_.fixed[i]) + ", expected one of " + (there.empty() ? "none: no node has a name" : there));
    }
  }

  void add(int index, const tinygltf::Node& node, bool fixed) {
    Json physics = Json::object();
    if (!fixed) physics["motion"] = Json::object();
    Json& target = document_["nodes"][static_cast<std::size_t>(index)];
    if (options_.as == ImportOptions::As::hull || options_.as == ImportOptions::As::mesh) {
      physics["collider"] = {{"geometry", {{"mesh", static_cast<unsigned>(node.mesh)}, {"convexHull", options_.as == ImportOptions::As::hull}}}};
      target["extensions"][kPhysics] = std::move(physics);
      return;
    }
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
    appendMeshTriangles(model_, node.mesh, Eigen::Affine3d::Identity(), vertices, triangles, pointerTo("/nodes", static_cast<std::size_t>(index)));
    Eigen::AlignedBox3d box;
    for (const Vec3& v : vertices) box.extend(v);
    const Vec3 center = box.center();
    target["extensions"][kPhysics] = std::move(physics);
    Json child = Json::object();
    child["name"] = node.name;
    child["translation"] = {center.x(), center.y(), center.z()};
    child["extensions"][kPhysics]["collider"]["geometry"]["shape"] = shapeAround(vertices, box);
    Json& nodes = document_["nodes"];
    document_["nodes"][static_cast<std::size_t>(index)]["children"].push_back(nodes.size());
    nodes.push_back(std::move(child));
  }

  std::size_t shapeAround(const std::vector<Vec3>& vertices, const Eigen::AlignedBox3d& box) {
    Json& shapes = document_["extensions"]["KHR_implicit_shapes"]["shapes"];
    if (!shapes.is_array()) shapes = Json::array();
    if (options_.as == ImportOptions::As::box) {
      const Vec3 size = box.sizes();
      shapes.push_back({{"type", "box"}, {"box", {{"size", {size.x(), size.y(), size.z()}}}}});
    } else {
      double radius = 0;
      for (const Vec3& v : vertices) radius = std::max(radius, (v - box.center()).norm());
      shapes.push_back({{"type", "sphere"}, {"sphere", {{"radius", radius}}}});
    }
    return shapes.size() - 1;
  }

  Json& document_;
  const tinygltf::Model& model_;
  const ImportOptions& options_;
  std::vector<char> named_;  // of options.fixed: some node has it
};

}  // namespace

bool hasPhysics(const Json& document) {
  const auto nodes = JsonPlace{document, ""}.find("nodes");
  for (std::size_t i = 0; nodes && i < nodes->size(); ++i)
    if (extensionOf(nodes->at(i), kPhysics)) return true;
  return false;
}

Json withColliders(Json document, const tinygltf::Model& model, const ImportOptions& options) {
  if (hasPhysics(document)) throw InputError("as", "found physics in the file, expected one without: its colliders are read");
  ColliderMaker(document, model, options).run();
  return document;
}

}  // namespace carom::gltf
