// SPDX-License-Identifier: MIT
// Physics of nodes -> the extensions' JSON.
#include "formats/gltf/write/physics.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <string>
#include <variant>

#include "formats/documents/scene_reader.hpp"
#include "formats/gltf/axes.hpp"

namespace carom::formats_detail {
namespace {

using gltf::MeshShape;
using gltf::Sheet;
using gltf::Tapered;
using tinygltf::Value;
using Object = Value::Object;
using Array = Value::Array;

Value textOf(const std::string& text) { return Value(text); }
Value numbersOf(const Vec3& v) { return Value(Array{Value(v.x()), Value(v.y()), Value(v.z())}); }
Value vectorOf(const Vec3& v) { return numbersOf(gltf::yUp(v)); }
Value sizesOf(const Vec3& v) { return numbersOf(gltf::swappedSizes(v)); }
Value quaternionOf(const Quat& ours) {
  const Quat q = gltf::yUp(ours);
  return Value(Array{Value(q.x()), Value(q.y()), Value(q.z()), Value(q.w())});
}

const std::string& nameOf(Combine combine) { return combineWords()[static_cast<std::size_t>(combine)]; }

/// A listed shape: its word, and the members behind it.
struct Listed {
  const char* word;
  Object members;
};

struct ShapeWriter {
  Listed operator()(const Sphere& sphere) const { return {"sphere", {{"radius", Value(sphere.radius)}}}; }
  Listed operator()(const Box& box) const { return {"box", {{"size", sizesOf(box.size)}}}; }
  Listed operator()(const Tapered& s) const {
    return {s.capsule ? "capsule" : "cylinder",
            {{"height", Value(s.height)}, {"radiusBottom", Value(s.bottom)}, {"radiusTop", Value(s.top)}}};
  }
  // Without sizes it is the infinite plane through the node's origin, facing its +y.
  Listed operator()(const Sheet& s) const { return {"plane", {{"doubleSided", Value(s.double_sided)}}}; }
  Listed operator()(const MeshShape&) const { return {"", {}}; }  // not listed
};

Value listedOf(const gltf::ColliderShape& shape) {
  const Listed listed = std::visit(ShapeWriter{}, shape);
  return Value(Object{{"type", textOf(listed.word)}, {listed.word, Value(listed.members)}});
}

struct Numbers {
  std::vector<double> operator()(const Sphere& s) const { return {0, s.radius}; }
  std::vector<double> operator()(const Box& s) const { return {1, s.size.x(), s.size.y(), s.size.z()}; }
  std::vector<double> operator()(const Tapered& s) const { return {s.capsule ? 2.0 : 3.0, s.height, s.bottom, s.top}; }
  std::vector<double> operator()(const Sheet&) const { return {4}; }
  std::vector<double> operator()(const MeshShape&) const { return {}; }
};

Value materialValue(const Material& material, const Object& extras) {
  Object out{{"staticFriction", Value(material.friction)},
             {"dynamicFriction", Value(material.friction)},
             {"restitution", Value(material.elasticity)},
             {"frictionCombine", textOf(nameOf(material.combine_friction))},
             {"restitutionCombine", textOf(nameOf(material.combine_elasticity))},
             {"extras", Value(Object{{"carom", Value(extras)}})}};
  if (!material.name.empty()) out["name"] = textOf(material.name);
  return Value(out);
}

Value gravityOf(const Vec3& gravity) {
  Object out{{"gravity", Value(gravity.norm())}};
  const Vec3 down = gravity.normalized();  // (0, 0, 0) stays as it is; then the default direction will do
  if (gravity.norm() > 0) out["direction"] = vectorOf(down);
  return Value(out);
}

// Members of a kinematic body say nothing of its mass and inertia, which do not matter.
Value motionOf(const gltf::Moving& motion) {
  Object out{{"isKinematic", Value(motion.kinematic)},
             {"centerOfMass", vectorOf(*motion.center_of_mass)},
             {"linearVelocity", vectorOf(motion.linear)},
             {"angularVelocity", vectorOf(motion.angular)},
             {"gravityFactor", Value(motion.gravity_factor)}};
  if (motion.kinematic) return Value(out);
  out["mass"] = Value(*motion.mass);
  out["inertiaDiagonal"] = sizesOf(*motion.inertia_diagonal);
  out["inertiaOrientation"] = quaternionOf(motion.inertia_orientation);
  return Value(out);
}

// Without its empty lists, which may not stand in a file.
Value filterOf(const CollisionFilter& filter) {
  Object out;
  const auto add = [&](const char* member, const std::vector<std::string>& names) {
    Array list;
    for (const std::string& name : names) list.push_back(textOf(name));
    if (!list.empty()) out[member] = Value(list);
  };
  add("collisionSystems", filter.systems);
  add("collideWithSystems", filter.collide_with);
  add("notCollideWithSystems", filter.not_collide_with);
  return Value(out);
}

}  // namespace

Value surfaceExtrasOf(const gltf::PhysicsNode& node) {
  return Value(Object{{"carom", Value(Object{{"surface_velocity", vectorOf(node.surface_velocity)},
                                             {"surface_angular_velocity", vectorOf(node.surface_angular_velocity)}})}});
}

int PhysicsWriter::indexOf(const gltf::ColliderShape& shape) {
  const auto [entry, added] = known_.emplace(std::visit(Numbers{}, shape), static_cast<int>(shapes_.size()));
  if (added) shapes_.push_back(shape);
  return entry->second;
}

int PhysicsWriter::indexOf(const CollisionFilter& filter) {
  const auto known = std::find(filters_.begin(), filters_.end(), filter);
  if (known != filters_.end()) return static_cast<int>(known - filters_.begin());
  filters_.push_back(filter);
  return static_cast<int>(filters_.size()) - 1;
}

Value PhysicsWriter::extensionOf(const gltf::PhysicsNode& node) {
  Object out;
  if (node.motion) out["motion"] = motionOf(*node.motion);
  if (node.collider) {
    Object geometry;
    if (const auto* surface = std::get_if<MeshShape>(&node.collider->shape)) {
      geometry["mesh"] = Value(surface->mesh);
      geometry["convexHull"] = Value(surface->convex);
    } else {
      geometry["shape"] = Value(indexOf(node.collider->shape));
    }
    Object collider{{"geometry", Value(geometry)}, {"physicsMaterial", Value(node.collider->material)}};
    if (!node.collider->filter.empty()) collider["collisionFilter"] = Value(indexOf(node.collider->filter));
    out["collider"] = Value(collider);
  }
  return Value(out);
}

void PhysicsWriter::finish(tinygltf::Model& model) const {
  Array materials, shapes;
  for (const Material& material : scene_.materials)
    materials.push_back(materialValue(material, {{"tangential_elasticity", Value(material.tangential_elasticity)}}));
  materials.push_back(materialValue(Material{}, {{"none", Value(true)}}));
  for (const gltf::ColliderShape& shape : shapes_) shapes.push_back(listedOf(shape));
  Object physics{{"physicsMaterials", Value(materials)}};
  Array filters;
  for (const CollisionFilter& filter : filters_) filters.push_back(filterOf(filter));
  if (!filters.empty()) physics["collisionFilters"] = Value(filters);
  model.extensions["KHR_physics_rigid_bodies"] = Value(physics);
  model.extensionsUsed.push_back("KHR_physics_rigid_bodies");
  if (!shapes.empty()) {
    model.extensions["KHR_implicit_shapes"] = Value(Object{{"shapes", Value(shapes)}});
    model.extensionsUsed.push_back("KHR_implicit_shapes");
  }
  model.extensions["OMI_physics_gravity"] = gravityOf(scene_.gravity);
  model.extensionsUsed.push_back("OMI_physics_gravity");
}

}  // namespace carom::formats_detail
