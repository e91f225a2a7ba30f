// SPDX-License-Identifier: MIT
#include "formats/gltf/read/import_gltf.h"

#include <tiny_gltf.h>

#include <cmath>
#include <filesystem>

#include "formats/base/in_file.hpp"
#include "formats/base/read_file.hpp"
#include "formats/gltf/read/left_document.hpp"
#include "formats/gltf/read/other_physics.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/gltf_geometry.hpp"
#include "formats/mesh/mesh_file.h"

namespace carom {

using namespace formats_detail;

namespace {

void checkImportOptions(const ImportOptions& options) {
  const bool visual = options.as != ImportOptions::As::nothing;
  if (!visual && (options.density || !options.fixed.empty()))
    throw InputError(options.density ? "density" : "fixed", "found it without `as`, expected what meshes without physics are taken as");
  if (options.density && !(*options.density > 0 && std::isfinite(*options.density)))
    throw InputError("density", "found " + numberText(*options.density) + ", expected a number > 0");
}

std::string hintOf(const ImportOptions& options, const tinygltf::Model& model) {
  if (model.meshes.empty() || options.as != ImportOptions::As::nothing) return "";
  return "; --as hull (or mesh, box, sphere) takes its meshes as they are drawn";
}

}  // namespace

Imported parseGltfScene(std::string_view bytes, const std::string& folder, const ImportOptions& options) {
  checkImportOptions(options);
  const tinygltf::Model model = parseGltf(bytes, folder);
  const Json json = gltfJson(bytes);
  Imported out;
  const bool visual = options.as != ImportOptions::As::nothing;
  Json physics = gltf::withKhronosPhysics(json, model);
  if (visual) physics = gltf::withColliders(std::move(physics), model, options);
  const gltf::PhysicsFile file = gltf::readPhysics(physics, out.report);
  gltf::ShapeMaker shapes(model, json, out.report);
  gltf::LeftDocument left(json, model.meshes.size(), shapes, out.report);
  std::vector<Body> bodies = gltf::makeBodies(
      file, shapes,
      [&](const gltf::PhysicsNode& node, const gltf::Frame& world) { return left.bodyOf(node, world, file.materials); },
      out.report);
  if (bodies.empty())
    throw InputError(
        "found no body, expected nodes with a collider (extension KHR_physics_rigid_bodies) in the default scene" +
        hintOf(options, model) + std::string(out.report.warnings.empty() ? "" : "; " + oneLine(out.report.warnings.front())));
  for (Body& body : bodies)
    if (options.density && !body.immovable()) body.mass.reset(), body.density = *options.density;
  out.document.scene = left.sceneOf(std::move(bodies), file);
  validate(out.document.scene);
  left.addEdit(out.document);
  for (std::string& warning : out.report.warnings) warning = oneLine(std::move(warning));  // names of nodes
  return out;
}

Imported importGltf(const std::string& path, const ImportOptions& options) {
  const std::string bytes = readFile(path, "a glTF file", kLargestMeshFile);
  return inFile(path, [&] { return parseGltfScene(bytes, std::filesystem::path(path).parent_path().string(), options); });
}

}  // namespace carom
