// SPDX-License-Identifier: MIT
// Bodies -> nodes with physics.
#include "formats/gltf/frame.hpp"
#include "formats/gltf/write/physics.hpp"

namespace carom {
namespace {

using gltf::Collider;
using gltf::MeshShape;
using gltf::PhysicsNode;
using gltf::Sheet;
using gltf::Tapered;

/// Adds the collider of a shape to a node, or below it: parts have poses, and surfaces no scale but that of nodes. A
/// plane moves its node onto itself, facing along it.
struct ColliderAdder {
  PhysicsNode& node;
  const std::string& name;
  int material;
  const SurfaceMeshes& meshes;

  void operator()(const Sphere& s) const { node.collider = Collider{s, material}; }
  void operator()(const Box& s) const { node.collider = Collider{s, material}; }
  void operator()(const Capsule& s) const { node.collider = Collider{Tapered{true, s.height, s.radius, s.radius}, material}; }
  void operator()(const Cylinder& s) const { node.collider = Collider{Tapered{false, s.height, s.radius, s.radius}, material}; }
  void operator()(const Hull& s) const { scaled(s.surface.get(), s.scale, true); }
  void operator()(const Mesh& s) const { scaled(s.surface.get(), s.scale, false); }
  void operator()(const Plane& s) const {
    node.translation += gltf::turned(node.rotation, s.offset * s.normal);
    node.rotation = gltf::product(node.rotation, Quat::FromTwoVectors(Vec3::UnitZ(), s.normal));
    node.collider = Collider{Sheet{}, material};
  }
  void operator()(const Compound& s) const {
    for (std::size_t i = 0; i < s.parts.size(); ++i) {
      PhysicsNode& child = addChild("part " + std::to_string(i));
      child.translation = s.parts[i].position;
      child.rotation = s.parts[i].orientation;
      const std::string below = child.name;
      std::visit(ColliderAdder{child, below, material, meshes}, s.parts[i].shape);
    }
  }

  void scaled(const Surface* surface, double scale, bool convex) const {
    PhysicsNode& owner = scale == 1 ? node : addChild("collider");
    owner.scale = Vec3::Constant(scale);
    owner.collider = Collider{MeshShape{meshes.at(surface), -1, convex}, material};
  }
  PhysicsNode& addChild(const std::string& what) const {
    PhysicsNode& child = node.children.emplace_back();
    child.name = name + " " + what;
    return child;
  }
};

void setFilter(PhysicsNode& node, const CollisionFilter& filter) {
  if (node.collider) node.collider->filter = filter;
  for (PhysicsNode& child : node.children) setFilter(child, filter);
}

gltf::Moving movingOf(const Body& body, const BodyModel& model) {
  const Quat to_node = body.orientation.conjugate();
  gltf::Moving out;
  out.kinematic = body.kinematic;
  out.gravity_factor = body.gravity_factor;
  out.center_of_mass = model.center;
  out.linear = to_node * body.velocity;
  out.angular = to_node * body.angular_velocity;
  if (body.kinematic) return out;
  out.mass = model.mass;
  out.inertia_diagonal = model.inertia;
  if (model.has_offset)
    out.inertia_orientation = body.inertia.source == Inertia::Source::matrix
                                  ? body.inertia.axes
                                  : gltf::unitQuaternion(Quat(Mat3(model.R_BG.transpose())));
  return out;
}

}  // namespace

gltf::PhysicsNode physicsNodeOf(const Scene& scene, int index, const BodyModel& model, const SurfaceMeshes& meshes) {
  const Body& body = scene.bodies[static_cast<std::size_t>(index)];
  PhysicsNode node;
  node.name = body.name;
  node.translation = body.position;
  node.rotation = body.orientation;
  if (!body.fixed) node.motion = movingOf(body, model);
  const int material =
      body.material.empty() ? static_cast<int>(scene.materials.size()) : materialIndex(scene, body.material);
  std::visit(ColliderAdder{node, body.name, material, meshes}, body.shape);
  setFilter(node, body.collision_filter);
  return node;
}

std::vector<const Surface*> surfacesOf(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape)) return {hull->surface.get()};
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return {mesh->surface.get()};
  std::vector<const Surface*> all;
  if (const auto* compound = std::get_if<Compound>(&shape))
    for (const CompoundPart& part : compound->parts)
      for (const Surface* surface : surfacesOf(part.shape)) all.push_back(surface);
  return all;
}

}  // namespace carom
