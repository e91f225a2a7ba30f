// SPDX-License-Identifier: MIT
#include "editing/strategy/nail_in_solid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "adjoint/base/errors.h"

namespace carom::editing_detail {
namespace {

const Target* find(const Constraint& constraint, const char* quantity) {
  for (const Target& target : constraint.targets)
    if (target.quantity == quantity) return &target;
  return nullptr;
}

/// Whether moving along the free components keeps the distance to the body.
bool runsAlong(const Body& solid, const std::vector<TargetNumber>& place) {
  const auto* plane = std::get_if<Plane>(&solid.shape);
  const Vec3 normal = plane ? Vec3(solid.orientation * plane->normal) : Vec3::Ones();
  for (int k = 0; k < 3; ++k)
    if (std::isnan(place[static_cast<std::size_t>(k)]) && normal[k] != 0) return false;
  return true;
}

bool moves(const EditProblem& problem, const Body& solid) {
  const auto& controls = problem.controls.controls();
  return std::any_of(controls.begin(), controls.end(), [&](const BoundControl& c) {
    const std::string& vary = c.control.vary;
    return c.control.body == solid.name && (vary == "position" || vary == "orientation" || vary == "size");
  });
}

/// The body at its nail, or the ball that it holds there.
std::optional<Body> atNail(const Body& body, const Constraint& constraint, const Target& place) {
  Body placed = body;
  for (int k = 0; k < 3; ++k) {
    const double x = place.value[static_cast<std::size_t>(k)];
    if (!std::isnan(x)) placed.position[k] = x;
  }
  if (const Target* turn = find(constraint, "orientation")) {
    placed.orientation = Quat(turn->value[0], turn->value[1], turn->value[2], turn->value[3]).normalized();
    return placed;
  }
  const double radius = kindOf(body.shape).innerRadius(body.shape);
  if (!(radius > 0)) return std::nullopt;
  placed.shape = Sphere{radius};
  placed.center_of_mass.reset();
  placed.inertia = {};
  return placed;
}

bool overlap(ContactSource& contacts, const Body& placed, const Body& solid) {
  if (!mayCollide(placed, solid)) return false;
  Scene scene;
  scene.bodies = {solid, placed};
  for (Body& body : scene.bodies) body.material.clear();
  try {
    validate(scene);
  } catch (const InputError&) {
    return false;
  }
  try {
    contacts.begin(scene);
  } catch (const InputError&) {
    return true;
  }
  return !contacts.overlaps().empty();  // accepted for the scene that the source was made for
}

}  // namespace

std::vector<WhyNot::Inside> nailsInSolids(const EditProblem& problem, const Scene& scene) {
  std::vector<WhyNot::Inside> found;
  const std::vector<Constraint>& constraints = problem.constraints.constraints();
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Constraint& constraint = constraints[i];
    const Target* place = find(constraint, "position");
    if (!place || !constraint.relative_to.empty()) continue;
    const Body& body = scene.bodies[static_cast<std::size_t>(bodyIndex(scene, constraint.body))];
    const auto placed = body.fixed ? std::nullopt : atNail(body, constraint, *place);
    if (!placed) continue;
    for (const Body& solid : scene.bodies) {
      if (!solid.fixed || moves(problem, solid) || !runsAlong(solid, place->value)) continue;
      if (!overlap(*problem.contacts, *placed, solid)) continue;
      found.push_back({static_cast<int>(i), problem.constraints.describeConstraint(static_cast<int>(i)), solid.name});
      break;
    }
  }
  return found;
}

std::string describeInside(const WhyNot::Inside& inside) {
  return "the nail of " + inside.name + " lies inside '" + inside.solid + "', which no motion can reach";
}

}  // namespace carom::editing_detail
