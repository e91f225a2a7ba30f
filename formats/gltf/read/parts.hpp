// SPDX-License-Identifier: MIT
// Private to formats/*.cpp: the parts of readPhysics.
#pragma once

#include "formats/gltf/nodes.hpp"
#include "formats/json/json_place.hpp"

namespace carom::gltf {

/// The scene that is shown first; none when the document has no scenes.
std::optional<detail::JsonPlace> defaultScene(const detail::JsonPlace& document);

/// physicsMaterials. One friction here: the dynamic one; what differs is reported.
std::vector<FileMaterial> readMaterials(const detail::JsonPlace& document, ImportReport& report);

/// OMI_physics_gravity of the document, in its axes; 9.81 m/s^2 downwards without it.
Vec3 readGravity(const detail::JsonPlace& document);

/// The shapes of KHR_implicit_shapes, or of KHR_collision_shapes in older files.
class ShapeList {
 public:
  explicit ShapeList(const detail::JsonPlace& document);

  /// Shape of a `geometry` (shape, mesh or node, and convexHull) or of an older collider (shape). Reports a shape of a
  /// kind that is not supported and returns none.
  std::optional<ColliderShape> read(const detail::JsonPlace& geometry, const PhysicsNode& node,
                                    ImportReport& report) const;

 private:
  std::optional<ColliderShape> readListed(const detail::JsonPlace& shape, bool convex, const PhysicsNode& node,
                                          ImportReport& report) const;
  std::size_t countOf(const char* list) const;
  detail::JsonPlace document_;
  std::optional<detail::JsonPlace> shapes_;
};

/// An entry of `collisionFilters` of the document, by its index.
CollisionFilter readFilter(const detail::JsonPlace& document, const detail::JsonPlace& index);

}  // namespace carom::gltf
