// SPDX-License-Identifier: MIT
// Private to formats/*.cpp: the parts of readPhysics.
#pragma once

#include "formats/gltf/nodes.hpp"
#include "formats/json/json_place.hpp"

namespace carom::gltf {

using namespace formats_detail;

/// The scene that is shown first; none when the document has no scenes.
std::optional<JsonPlace> defaultScene(const JsonPlace& document);

/// physicsMaterials. One friction here: the dynamic one; what differs is reported.
std::vector<FileMaterial> readMaterials(const JsonPlace& document, ImportReport& report);

/// OMI_physics_gravity of the document, in its axes; 9.81 m/s^2 downwards without it.
Vec3 readGravity(const JsonPlace& document);

/// The shapes of KHR_implicit_shapes, or of KHR_collision_shapes in older files.
class ShapeList {
 public:
  explicit ShapeList(const JsonPlace& document);

  /// Shape of a `geometry` (shape, mesh or node, and convexHull) or of an older collider (shape). Reports a shape of a
  /// kind that is not supported and returns none.
  std::optional<ColliderShape> read(const JsonPlace& geometry, const PhysicsNode& node, ImportReport& report) const;

 private:
  std::optional<ColliderShape> readListed(const JsonPlace& shape, bool convex, const PhysicsNode& node,
                                          ImportReport& report) const;
  std::size_t countOf(const char* list) const;
  JsonPlace document_;
  std::optional<JsonPlace> shapes_;
};

/// An entry of `collisionFilters` of the document, by its index.
CollisionFilter readFilter(const JsonPlace& document, const JsonPlace& index);

}  // namespace carom::gltf
