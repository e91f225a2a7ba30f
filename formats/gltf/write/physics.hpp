// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"
#include "formats/gltf/nodes.hpp"

namespace tinygltf {
class Model;
class Value;
}  // namespace tinygltf

namespace carom {

/// Where the surfaces of a scene are in a file: indices of meshes.
using SurfaceMeshes = std::map<const Surface*, int>;

/// A body as glTF has it, in our axes: the node at the shape's origin (that of a plane: on it, facing along it) with the
/// motion, if it moves, and its collider; colliders that need a pose or a scale of their own are below it.
/// Materials are numbered as in the scene; the one after the last stands for bodies that name none.
gltf::PhysicsNode physicsNodeOf(const Scene& scene, int body, const BodyModel& model, const SurfaceMeshes& meshes);

/// All surfaces of hulls and meshes in a shape, parts of compounds too.
std::vector<const Surface*> surfacesOf(const Shape& shape);

/// Writes the document-wide parts of KHR_physics_rigid_bodies, KHR_implicit_shapes and OMI_physics_gravity, and the
/// extensions of nodes, which refer to them. Equal shapes are written once.
class PhysicsWriter {
 public:
  explicit PhysicsWriter(const Scene& scene) : scene_(scene) {}

  /// KHR_physics_rigid_bodies of a node.
  tinygltf::Value extensionOf(const gltf::PhysicsNode& node);
  /// To be called when all nodes are written.
  void finish(tinygltf::Model& model) const;

 private:
  int indexOf(const gltf::ColliderShape& shape);
  int indexOf(const CollisionFilter& filter);

  const Scene& scene_;
  std::vector<gltf::ColliderShape> shapes_;
  std::vector<CollisionFilter> filters_;
  std::map<std::vector<double>, int> known_;  // by kind and numbers
};

/// The scene document as a value, as writeDocument writes it for this scene: the words that importGltf takes bodies
/// from without loss. Surfaces are named by their meshes, as files "#/meshes/3". Throws InputError as writeDocument
/// does.
tinygltf::Value documentOf(const Document& document, const Scene& scene, const SurfaceMeshes& meshes);

/// The name by which the document in a file calls a mesh of that file.
std::string meshReference(int mesh);

}  // namespace carom
