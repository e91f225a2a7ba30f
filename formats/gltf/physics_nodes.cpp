// SPDX-License-Identifier: MIT
// Bodies -> nodes with physics.
#include "formats/gltf/physics_nodes.hpp"

#include "formats/base/turn_from_z.hpp"
#include "formats/base/unit.hpp"
#include "formats/gltf/axes.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {
namespace {

using gltf::PhysicsNode;

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
                                  : unitQuaternion(Quat(Mat3(model.R_BG.transpose())));
  return out;
}

/// Of a node that lies at `away` and is turned to by `to_node` from where the velocities are written, and of those below it.
void setSurface(PhysicsNode& node, const Vec3& away, const Quat& to_node, const Vec3& velocity, const Vec3& spin) {
  node.surface_velocity = to_node * (velocity + spin.cross(away));
  node.surface_angular_velocity = to_node * spin;
  for (PhysicsNode& child : node.children)
    setSurface(child, child.translation, child.rotation.conjugate(), node.surface_velocity, node.surface_angular_velocity);
}

}  // namespace

void ColliderAdder::add(const Shape& shape) const { shapes::formatOf(shape).collider(*this, shape); }

void ColliderAdder::set(const gltf::ColliderShape& shape) const { node.collider = gltf::Collider{shape, material}; }

void ColliderAdder::setPlane(const Plane& s) const {
  node.translation += gltf::turned(node.rotation, s.offset * s.normal);
  node.rotation = gltf::product(node.rotation, turnFromZ(s.normal));
  set(gltf::Sheet{});
}

void ColliderAdder::setSurface(const Surface& surface, double scale, bool convex) const {
  PhysicsNode& owner = scale == 1 ? node : addChild("collider");
  owner.scale = Vec3::Constant(scale);
  owner.collider = gltf::Collider{gltf::MeshShape{meshes.at(&surface), -1, convex}, material};
}

PhysicsNode& ColliderAdder::addChild(const std::string& what) const {
  PhysicsNode& child = node.children.emplace_back();
  child.name = name + " " + what;
  return child;
}

gltf::PhysicsNode physicsNodeOf(const Scene& scene, int index, const BodyModel& model, const SurfaceMeshes& meshes) {
  const Body& body = scene.bodies[static_cast<std::size_t>(index)];
  PhysicsNode node;
  node.name = body.name;
  node.translation = body.position;
  node.rotation = body.orientation;
  if (!body.fixed) node.motion = movingOf(body, model);
  const int material =
      body.material.empty() ? static_cast<int>(scene.materials.size()) : materialIndex(scene, body.material);
  ColliderAdder{node, body.name, material, meshes}.add(body.shape);
  setFilter(node, body.collision_filter);
  if (body.surfaceMoves())  // an infinite plane's node lies elsewhere, and is turned
    setSurface(node, body.orientation.conjugate() * (node.translation - body.position), node.rotation.conjugate() * body.orientation,
               body.surface_velocity, body.surface_angular_velocity);
  return node;
}

}  // namespace carom::formats_detail
