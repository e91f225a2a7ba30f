// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <memory>
#include <set>

#include "formats/base/document.h"
#include "formats/gltf/read/bodies.hpp"
#include "formats/gltf/physics_nodes.hpp"

namespace tinygltf {
class Value;
}

namespace carom::formats_detail {

/// The scene document as a value, as writeDocument writes it for this scene: the words that importGltf takes bodies
/// from without loss. Surfaces are named by their meshes, as files "#/meshes/3". Throws InputError as writeDocument
/// does.
tinygltf::Value documentOf(const Document& document, const Scene& scene, const SurfaceMeshes& meshes);

/// The name by which the document in a file calls a mesh of that file.
std::string meshReference(int mesh);

}  // namespace carom::formats_detail

namespace carom::gltf {

/// The scene document that carom left in a file, held against the physics that the file has now.
class LeftDocument {
 public:
  /// Reads extras/carom of the default scene, if there is any. What cannot be read is reported, and left out.
  LeftDocument(const Json& document, std::size_t mesh_count, ShapeMaker& shapes, ImportReport& report);

  /// The body whose node this is, as written, while the node says the same; otherwise null.
  const Body* bodyOf(const PhysicsNode& node, const Frame& world, const std::vector<FileMaterial>& materials);

  /// The scene of bodies made from a file: materials, gravity and tilts as they were left where the file agrees.
  Scene sceneOf(std::vector<Body> bodies, const PhysicsFile& file);

  /// Duration, controls and constraints. Those that the scene has no bodies for any more are reported, and left out.
  void addEdit(Document& document);

 private:
  void read(const Json& json, std::size_t mesh_count, ShapeMaker& shapes);
  std::vector<FileMaterial> materials() const;
  std::vector<Material> materialsOf(const PhysicsFile& file) const;

  ImportReport& report_;
  Json edit_;  // object with duration, controls and constraints; empty when nothing was left
  bool has_scene_ = false;
  Scene scene_;
  SurfaceMeshes meshes_;
  std::set<std::string> found_;
};

}  // namespace carom::gltf
