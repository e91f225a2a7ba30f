// SPDX-License-Identifier: MIT
// Whether nodes say the same, number by number.
#include <cmath>

#include "formats/gltf/nodes.hpp"

namespace carom::gltf {

using namespace formats_detail;

namespace {

/// What a node says about physics, as words and numbers; each number with the size that its rounding goes by.
struct Sayings {
  std::string words;
  std::vector<double> numbers, sizes;

  void word(const std::string& text) { words += text + '\n'; }
  void number(double value) { number(value, std::abs(value)); }
  void number(double value, double size) {
    numbers.push_back(value);
    sizes.push_back(size);
  }
  template <class Vector>
  void vector(const Vector& values) {
    const double size = values.cwiseAbs().maxCoeff();
    for (const double value : values.reshaped()) number(value, size);
  }
};

struct ShapeSayer {
  Sayings& out;
  void operator()(const Sphere& s) const {
    out.word("sphere");
    out.number(s.radius);
  }
  void operator()(const Box& s) const {
    out.word("box");
    for (const double size : s.size) out.number(size);
  }
  void operator()(const Tapered& s) const {
    out.word(s.capsule ? "capsule" : "cylinder");
    for (const double size : {s.height, s.bottom, s.top}) out.number(size);
  }
  void operator()(const Sheet& s) const {
    out.word(s.double_sided ? "double plane" : "plane");
    for (const auto& size : {s.size_x, s.size_y}) out.number(size.value_or(0));
  }
  void operator()(const MeshShape& s) const {
    out.word((s.convex ? "hull " : "mesh ") + std::to_string(s.mesh) + " " + std::to_string(s.node));
  }
};

bool isInfinitePlane(const PhysicsNode& node) {
  const Sheet* sheet = node.collider ? std::get_if<Sheet>(&node.collider->shape) : nullptr;
  return sheet != nullptr && !sheet->size_x && !sheet->size_y;
}

/// An infinite plane may lie anywhere in itself.
void sayPose(const PhysicsNode& node, Sayings& out) {
  if (isInfinitePlane(node) && node.children.empty()) {
    const Vec3 normal = node.rotation * Vec3::UnitZ();
    out.vector(normal);
    out.number(normal.dot(node.translation), node.translation.norm());
    return;
  }
  out.vector(node.translation);
  out.vector(node.rotation.toRotationMatrix());
  for (const double scale : node.scale) out.number(scale);
}

void sayMotion(const Moving& motion, Sayings& out) {
  out.word(motion.kinematic ? "kinematic" : "moving");
  out.number(motion.mass.value_or(-1));
  const Vec3 moments = motion.inertia_diagonal.value_or(-Vec3::Ones());
  const Vec3 center = motion.center_of_mass.value_or(Vec3::Zero());
  const double gyration = std::sqrt(moments.maxCoeff() / motion.mass.value_or(1));  // a length; NaN for no moments
  const double size = std::max(center.cwiseAbs().maxCoeff(), std::isfinite(gyration) ? gyration : 0);
  for (const double value : center) out.number(value, size);
  const Mat3 axes = motion.inertia_orientation.toRotationMatrix();  // moments may be ordered otherwise
  out.vector(Mat3(axes * moments.asDiagonal() * axes.transpose()));
  out.vector(motion.linear);
  out.vector(motion.angular);
  out.number(motion.gravity_factor);
}

void sayFilter(const CollisionFilter& filter, Sayings& out) {
  const auto say = [&](const char* what, const std::vector<std::string>& names) {
    out.word(what);
    for (const std::string& name : names) out.word("'" + name + "'");
  };
  if (filter.empty()) return;
  say("in", filter.systems);
  say("with", filter.collide_with);
  say("without", filter.not_collide_with);
}

bool hasPhysics(const PhysicsNode& node) {
  if (node.motion || node.collider) return true;
  for (const PhysicsNode& child : node.children)
    if (hasPhysics(child)) return true;
  return false;
}

/// Of an infinite plane, which may lie anywhere in itself, where it is nearest to the origin.
void saySurface(const PhysicsNode& node, Sayings& out) {
  const Vec3 &velocity = node.surface_velocity, &spin = node.surface_angular_velocity;
  Vec3 to = Vec3::Zero();
  if (isInfinitePlane(node)) {
    const Vec3 normal = node.rotation * Vec3::UnitZ();
    to = node.rotation.conjugate() * Vec3(normal.dot(node.translation) * normal - node.translation);
  }
  out.word("moving surface");
  const double size = velocity.cwiseAbs().maxCoeff() + spin.norm() * to.norm();
  for (const double value : Vec3(velocity + spin.cross(to))) out.number(value, size);
  out.vector(spin);
}

void say(const PhysicsNode& node, const std::vector<FileMaterial>& materials, Sayings& out) {
  if (node.motion) sayMotion(*node.motion, out);
  if (node.collider) {
    std::visit(ShapeSayer{out}, node.collider->shape);
    const int material = node.collider->material;
    const bool named = material >= 0 && !materials[static_cast<std::size_t>(material)].none;
    sayFilter(node.collider->filter, out);
    if (node.surfaceMoves()) saySurface(node, out);
    out.word(named ? "of " + materials[static_cast<std::size_t>(material)].material.name : "of none");
  }
  for (const PhysicsNode& child : node.children) {
    if (!hasPhysics(child)) continue;
    out.word("below");
    sayPose(child, out);
    say(child, materials, out);
    out.word("above");
  }
}

bool same(const Sayings& a, const Sayings& b) {
  if (a.words != b.words || a.numbers.size() != b.numbers.size()) return false;
  for (std::size_t i = 0; i < a.numbers.size(); ++i)
    if (!(std::abs(a.numbers[i] - b.numbers[i]) <= kSame * std::max(a.sizes[i], b.sizes[i]))) return false;
  return true;
}

}  // namespace

bool samePhysics(const PhysicsNode& a, const std::vector<FileMaterial>& materials_a, const PhysicsNode& b,
                 const std::vector<FileMaterial>& materials_b) {
  Sayings of_a, of_b;
  say(a, materials_a, of_a);
  say(b, materials_b, of_b);
  return same(of_a, of_b);
}

bool samePlace(const PhysicsNode& a, const PhysicsNode& b) {
  Sayings of_a, of_b;
  sayPose(a, of_a);
  sayPose(b, of_b);
  return same(of_a, of_b);
}

bool sameMaterial(const Material& a, const Material& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= kSame * std::max(std::abs(x), std::abs(y)); };
  return near(a.elasticity, b.elasticity) && near(a.friction, b.friction) &&
         near(a.tangential_elasticity, b.tangential_elasticity) && a.combine_elasticity == b.combine_elasticity &&
         a.combine_friction == b.combine_friction;
}

}  // namespace carom::gltf
