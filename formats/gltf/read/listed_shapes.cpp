// SPDX-License-Identifier: MIT
// Shapes of a glTF document, and what colliders say beside them.
#include <algorithm>
#include <array>

#include "formats/gltf/axes.hpp"
#include "formats/gltf/read/parts.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::gltf {

using namespace formats_detail;

namespace {

double positiveOr(const JsonPlace& shape, const char* member, double otherwise) {
  const double value = shape.numberOr(member, otherwise);
  if (!(value > 0)) fail(shape.pointer + "/" + member, numberText(value), "a number > 0");
  return value;
}

ColliderShape readSphere(const JsonPlace& shape) { return Sphere{positiveOr(shape, "radius", 0.5)}; }

ColliderShape readBox(const JsonPlace& shape) {
  const Vec3 size = shape.findVector("size").value_or(Vec3::Ones());
  if (!(size.minCoeff() > 0)) fail(shape.pointer + "/size", "a size that is not positive", "numbers > 0");
  return Box{swappedSizes(size)};
}

ColliderShape readTapered(const JsonPlace& shape, bool capsule) {
  Tapered out;
  out.capsule = capsule;
  out.height = positiveOr(shape, "height", out.height);
  out.bottom = shape.numberOr("radiusBottom", out.bottom);
  out.top = shape.numberOr("radiusTop", out.top);
  if (!(out.bottom >= 0 && out.top >= 0 && out.bottom + out.top > 0))
    fail(shape.pointer, "radii " + numberText(out.bottom) + " and " + numberText(out.top), "numbers >= 0, one > 0");
  return out;
}

ColliderShape readCapsule(const JsonPlace& shape) { return readTapered(shape, true); }
ColliderShape readCylinder(const JsonPlace& shape) { return readTapered(shape, false); }

ColliderShape readPlane(const JsonPlace& shape) {
  Sheet out;
  out.size_x = shape.findNumber("sizeX");
  out.size_y = shape.findNumber("sizeZ");
  out.double_sided = shape.booleanOr("doubleSided", false);
  for (const auto& size : {out.size_x, out.size_y})
    if (size && !(*size > 0)) fail(shape.pointer, "a size of " + numberText(*size), "numbers > 0");
  return out;
}

struct Kind {
  const char* name;
  ColliderShape (*read)(const JsonPlace& shape);
};
constexpr std::array<Kind, 5> kKinds{{{"sphere", readSphere},
                                      {"box", readBox},
                                      {"capsule", readCapsule},
                                      {"cylinder", readCylinder},
                                      {"plane", readPlane}}};

/// Older files name the kind by the member alone.
std::string kindOfListed(const JsonPlace& shape) {
  if (const auto type = shape.find("type")) return type->text();
  for (const Kind& kind : kKinds)
    if (shape.find(kind.name)) return kind.name;
  for (const char* name : {"mesh", "convex", "trimesh"})
    if (shape.find(name)) return name;
  return shape.value.empty() ? "" : shape.value.begin().key();
}

}  // namespace

ShapeList::ShapeList(const JsonPlace& document) : document_(document) {
  for (const char* name : {"KHR_implicit_shapes", "KHR_collision_shapes"})
    if (const auto extension = extensionOf(document_, name); extension && !shapes_) {
      const auto list = extension->find("shapes");
      if (list) shapes_.emplace(*list);
    }
}

std::size_t ShapeList::countOf(const char* list) const {
  const auto found = document_.find(list);
  return found ? found->size() : 0;
}

std::optional<ColliderShape> ShapeList::read(const JsonPlace& geometry, const PhysicsNode& node,
                                             ImportReport& report) const {
  const bool convex = geometry.booleanOr("convexHull", false);
  MeshShape surface;
  surface.convex = convex;
  if (const auto mesh = geometry.find("mesh")) {
    surface.mesh = mesh->index(countOf("meshes"), "meshes");
    return surface;
  }
  if (const auto from = geometry.find("node")) {
    surface.node = from->index(countOf("nodes"), "nodes");
    return surface;
  }
  const JsonPlace index = geometry.require("shape");
  const auto i = static_cast<std::size_t>(index.index(shapes_ ? shapes_->size() : 0, "shapes"));
  return readListed(shapes_->at(i), convex, node, report);
}

std::optional<ColliderShape> ShapeList::readListed(const JsonPlace& shape, bool convex, const PhysicsNode& node,
                                                   ImportReport& report) const {
  const std::string name = kindOfListed(shape);
  const auto known = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return name == kind.name; });
  const auto content = name.empty() ? std::nullopt : shape.find(name.c_str());
  static const Json kDefaults = Json::object();
  if (known != kKinds.end()) return known->read(content ? *content : JsonPlace{kDefaults, shape.pointer});
  if (content && (name == "mesh" || name == "convex" || name == "trimesh")) {
    MeshShape surface;
    surface.mesh = content->require("mesh").index(countOf("meshes"), "meshes");
    const auto flags = extensionOf(shape, "KHR_physics_rigid_bodies");
    surface.convex = convex || name == "convex" || (flags && flags->booleanOr("convexHull", false));
    return surface;
  }
  report.warnings.push_back(node.label() + ": its collider is ignored: shapes of the type " + quotedText(name) + " (" +
                            shape.pointer + ") are not supported");
  return std::nullopt;
}

CollisionFilter readFilter(const JsonPlace& document, const JsonPlace& index) {
  const auto physics = extensionOf(document, "KHR_physics_rigid_bodies");
  const auto filters = physics ? physics->find("collisionFilters") : std::nullopt;
  const int chosen = index.index(filters ? filters->size() : 0, "collisionFilters");
  const JsonPlace filter = filters->at(static_cast<std::size_t>(chosen));
  const auto names = [&](const char* member) {
    std::vector<std::string> out;
    const auto list = filter.find(member);
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      const std::string& name = list->at(i).text();
      if (!name.empty() && std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    }
    return out;
  };
  return {names("collisionSystems"), names("collideWithSystems"), names("notCollideWithSystems")};
}

}  // namespace carom::gltf
