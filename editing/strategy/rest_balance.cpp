// SPDX-License-Identifier: MIT
#include "editing/strategy/rest_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/scene/body_model.h"
#include "editing/detail/messages.hpp"
#include "editing/strategy/place_ranges.hpp"

namespace carom::editing_detail {
namespace {

constexpr int kDirections = 64;
constexpr double kLean = 1e-3;  // of a direction from the normal: finds the farthest point of what touches
// Of the bounding radius; a turn by 1e-6 rad moves what is found by 1e-6 / kLean of the diameter.
constexpr double kSlack = 5e-3;

bool variesOnlyThrow(const EditProblem& problem, const std::string& body) {
  const auto& controls = problem.controls.controls();
  return std::all_of(controls.begin(), controls.end(), [&](const BoundControl& c) {
    const std::string& vary = c.control.vary;
    return c.kind->owner == OwnerKind::material || (vary == "velocity" || vary == "angular_velocity") ||
           (c.control.body == body && (vary == "position" || vary == "orientation" || vary == "mass"));
  });
}

/// The only body that one can touch, a fixed plane; null if there are others.
const Body* onlyPlane(const Scene& scene, const Body& body) {
  const Body* only = nullptr;
  for (const Body& other : scene.bodies) {
    if (other.name == body.name || !mayCollide(body, other)) continue;
    if (only || !other.fixed || !std::holds_alternative<Plane>(other.shape)) return nullptr;
    only = &other;
  }
  return only;
}

std::optional<Quat> orientationOf(const Constraint& constraint) {
  for (const Target& target : constraint.targets) {
    if (target.quantity != "orientation" || target.value.size() != 4) continue;
    const Quat q(target.value[0], target.value[1], target.value[2], target.value[3]);
    if (q.norm() > 0) return q.normalized();
  }
  return std::nullopt;
}

/// By how much the point below the centre of mass lies outside of what the body would stand on, m; 0 or less: not
/// proven.
double besideSupport(const Body& body, const Quat& orientation, const Vec3& normal, const Vec3& gravity) {
  const double falls = -normal.dot(gravity);
  if (!(falls > 0.1 * gravity.norm())) return 0;
  const ShapeKind& kind = kindOf(body.shape);
  const auto farthest = [&](const Vec3& n) -> Vec3 {
    const Vec3 local = orientation.conjugate() * n.normalized();
    return orientation * kind.farthest(body.shape, local).point(local);
  };
  const Vec3 center = orientation * centerOfMass(body);
  const Vec3 below = center + normal.dot(center - farthest(-normal)) / falls * gravity;
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  double most = 0;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * std::numbers::pi * k / kDirections;
    const Vec3 u = elementary::cos(angle) * x + elementary::sin(angle) * y;
    most = std::max(most, u.dot(below - farthest(-normal + kLean * u)));
  }
  return most - kSlack * kind.boundingRadius(body.shape);
}

}  // namespace

std::string whyItCannotBalance(const EditProblem& problem, double tolerance) {
  const Scene& scene = problem.controls.startScene();
  if (!(tolerance <= 1e-6) || !scene.tilts.empty()) return "";
  for (const Constraint& constraint : problem.constraints.constraints()) {
    if (!constraint.at.rest || !constraint.relative_to.empty()) continue;
    const Body& body = scene.bodies[static_cast<std::size_t>(bodyIndex(scene, constraint.body))];
    const std::optional<Quat> orientation = orientationOf(constraint);
    const Body* plane = onlyPlane(scene, body);
    if (!orientation || !plane || body.immovable() || !variesOnlyThrow(problem, body.name)) continue;
    const Vec3 normal = plane->orientation * std::get<Plane>(plane->shape).normal.normalized();
    const double beside = besideSupport(body, *orientation, normal, scene.gravity * body.gravity_factor);
    if (!(beside > 0)) continue;
    return "'" + body.name + "' cannot rest in that orientation: its centre of mass would be " + brief(beside) +
           " m beside all that it stands on, and it would topple.";
  }
  return "";
}

}  // namespace carom::editing_detail
