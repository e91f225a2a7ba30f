// SPDX-License-Identifier: MIT
#include "formats/mesh/gltf_reader.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <vector>

#include "formats/json/json.hpp"
#include "formats/mesh/gltf_geometry.hpp"

namespace carom::formats_detail {

TriangleSoup parseGltfMesh(std::string_view bytes, const std::string& folder) {
  const tinygltf::Model model = parseGltf(bytes, folder);
  TriangleSoup soup;
  if (model.scenes.empty()) fail("/scenes", "none", "a scene with meshes");
  struct Visit {
    int node;
    Eigen::Affine3d parent;
  };
  std::vector<Visit> visits;
  const auto push = [&](const std::vector<int>& nodes, const Eigen::Affine3d& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) visits.push_back({*node, parent});
  };
  Eigen::Affine3d root = Eigen::Affine3d::Identity();
  root.linear() = zUpFromYUp();
  push(model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes, root);
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    const auto index = static_cast<std::size_t>(visit.node);
    const tinygltf::Node& node = model.nodes[index];
    const std::string where = pointerTo("/nodes", index);
    const Eigen::Affine3d transform = visit.parent * nodeTransform(node, where);
    if (node.mesh >= 0) {
      if (node.skin >= 0) fail(where + "/skin", "a skin, which bends the mesh", "a rigid mesh");
      if (std::any_of(node.weights.begin(), node.weights.end(), [](double w) { return w != 0; }))
        fail(where + "/weights", "a morphed mesh", "weights of 0 or none");
      appendMeshTriangles(model, node.mesh, transform, soup.vertices, soup.triangles, "");
    }
    push(node.children, transform);
  }
  return soup;
}

}  // namespace carom::formats_detail
