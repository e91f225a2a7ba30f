// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <map>

#include "adjoint/motion/motion.h"
#include "formats/gltf/nodes.hpp"

namespace carom::formats_detail {

/// Where the surfaces of a scene are in a file: indices of meshes.
using SurfaceMeshes = std::map<const Surface*, int>;

/// Adds the collider of a shape to a node, or below it: parts have poses, and surfaces no scale but that of nodes.
struct ColliderAdder {
  gltf::PhysicsNode& node;
  const std::string& name;
  int material;
  const SurfaceMeshes& meshes;

  void add(const Shape& shape) const;

  // for the rows of shapes
  void set(const gltf::ColliderShape& shape) const;
  /// Moves the node onto the plane, facing along it.
  void setPlane(const Plane& plane) const;
  void setSurface(const Surface& surface, double scale, bool convex) const;
  gltf::PhysicsNode& addChild(const std::string& what) const;
};

/// A body as glTF has it, in our axes: the node at the shape's origin (that of a plane: on it, facing along it) with the
/// motion, if it moves, and its collider; colliders that need a pose or a scale of their own are below it.
/// Materials are numbered as in the scene; the one after the last stands for bodies that name none.
gltf::PhysicsNode physicsNodeOf(const Scene& scene, int body, const BodyModel& model, const SurfaceMeshes& meshes);

}  // namespace carom::formats_detail
