// SPDX-License-Identifier: MIT
#include "formats/gltf/read/import_gltf.h"

#include <tiny_gltf.h>

#include <filesystem>

#include "formats/base/in_file.hpp"
#include "formats/base/read_file.hpp"
#include "formats/gltf/read/left_document.hpp"
#include "formats/mesh/gltf_geometry.hpp"
#include "formats/mesh/mesh_file.h"

namespace carom {

using namespace formats_detail;

Imported parseGltfScene(std::string_view bytes, const std::string& folder) {
  const tinygltf::Model model = parseGltf(bytes, folder);
  const Json json = gltfJson(bytes);
  Imported out;
  const gltf::PhysicsFile file = gltf::readPhysics(json, out.report);
  gltf::ShapeMaker shapes(model, json, out.report);
  gltf::LeftDocument left(json, model.meshes.size(), shapes, out.report);
  std::vector<Body> bodies = gltf::makeBodies(
      file, shapes,
      [&](const gltf::PhysicsNode& node, const gltf::Frame& world) { return left.bodyOf(node, world, file.materials); },
      out.report);
  if (bodies.empty())
    throw InputError(
        "found no body, expected nodes with a collider (extension KHR_physics_rigid_bodies) in the default scene" +
        std::string(out.report.warnings.empty() ? "" : "; " + oneLine(out.report.warnings.front())));
  out.document.scene = left.sceneOf(std::move(bodies), file);
  validate(out.document.scene);
  left.addEdit(out.document);
  for (std::string& warning : out.report.warnings) warning = oneLine(std::move(warning));  // names of nodes
  return out;
}

Imported importGltf(const std::string& path) {
  const std::string bytes = readFile(path, "a glTF file", kLargestMeshFile);
  return inFile(path, [&] { return parseGltfScene(bytes, std::filesystem::path(path).parent_path().string()); });
}

}  // namespace carom
