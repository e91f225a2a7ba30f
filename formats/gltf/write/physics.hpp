// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <map>
#include <vector>

#include "formats/gltf/nodes.hpp"

namespace tinygltf {
class Model;
class Value;
}  // namespace tinygltf

namespace carom::formats_detail {

/// The extras of a node whose surface moves, for which the extensions have no words.
tinygltf::Value surfaceExtrasOf(const gltf::PhysicsNode& node);

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

}  // namespace carom::formats_detail
