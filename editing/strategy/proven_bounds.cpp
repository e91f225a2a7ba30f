// SPDX-License-Identifier: MIT
#include "editing/strategy/proven_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "adjoint/scene/body_model.h"
#include "editing/detail/messages.hpp"
#include "editing/strategy/place_ranges.hpp"

namespace carom::editing_detail {
namespace {

constexpr double kBoundRounding = 1e-9;

std::string quoted(const Body& body) { return "'" + body.name + "'"; }

std::string neverMeet(const Body& a, const Body& b) {
  if (mayCollide(a, b)) return "";
  const std::string names = quoted(a) + " and " + quoted(b);
  if (a.immovable() && b.immovable()) return names + " never collide: neither of them is moved by anything.";
  return names + " never collide: their collision filters keep them apart.";
}

bool gravityVaries(const EditProblem& problem) {
  const auto& controls = problem.controls.controls();
  return std::any_of(controls.begin(), controls.end(), [](const BoundControl& c) { return c.control.vary == "gravity"; });
}

/// No point of the place is nearer to a fixed body than this.
double leastDistance(const PositionRange& place, const Body& solid) {
  if (const auto* plane = std::get_if<Plane>(&solid.shape)) {
    const Vec3 normal = solid.orientation * plane->normal.normalized();
    double distance = -plane->offset - normal.dot(solid.position);
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = normal[static_cast<Eigen::Index>(k)];
      if (n != 0) distance += n * (n > 0 ? place.lower[k] : place.upper[k]);
    }
    return distance;
  }
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = solid.position[static_cast<Eigen::Index>(k)];
    const double off = std::max({0.0, place.lower[k] - at, at - place.upper[k]});
    squares += off * off;
  }
  return std::sqrt(squares) - kindOf(solid.shape).boundingRadius(solid.shape);
}

/// The nearest of all that can bear a body, and its distance; null where something may that is not known.
std::optional<std::pair<std::string, double>> nearestBearing(const EditProblem& problem, const Body& body, const PositionRange& place) {
  std::pair<std::string, double> nearest{"", kInfinity};
  for (const Body& other : problem.controls.startScene().bodies) {
    if (other.name == body.name || !mayCollide(body, other)) continue;
    if (!other.fixed || varies(problem, other.name, {"position", "orientation", "size"})) return std::nullopt;
    const double distance = leastDistance(place, other);
    if (std::isnan(distance)) return std::nullopt;
    if (distance < nearest.second) nearest = {quoted(other), distance};
  }
  return nearest;
}

}  // namespace

std::string whyTheyNeverMeet(const EditProblem& problem) {
  const Scene& scene = problem.controls.startScene();
  const auto named = [&](const std::string& name) -> const Body& {
    return scene.bodies[static_cast<std::size_t>(bodyIndex(scene, name))];
  };
  for (const Constraint& constraint : problem.constraints.constraints()) {
    std::string why;
    if (constraint.hits) {
      why = neverMeet(named(constraint.body), named(constraint.hits->with));
    } else if (constraint.at.impact > 0 && !constraint.at.with.empty()) {
      why = neverMeet(named(constraint.body), named(constraint.at.with));
    }
    if (!why.empty()) return why;
  }
  return "";
}

std::string whyItCannotRest(const EditProblem& problem, double tolerance) {
  const ConstraintSet& set = problem.constraints;
  const Scene& scene = problem.controls.startScene();
  if (gravityVaries(problem) || !(scene.gravity.norm() > 0)) return "";
  for (std::size_t i = 0; i < set.constraints().size(); ++i) {
    const Constraint& constraint = set.constraints()[i];
    if (!constraint.at.rest || !constraint.relative_to.empty()) continue;
    const Body& body = scene.bodies[static_cast<std::size_t>(bodyIndex(scene, constraint.body))];
    const PositionRange place = placeOf(set, static_cast<int>(i), tolerance);
    if (!place.any || body.gravity_factor == 0 || varies(problem, body.name, {"size"})) continue;
    const double radius = kindOf(body.shape).boundingRadius(body.shape);
    const auto nearest = nearestBearing(problem, body, place);
    if (!nearest || !(nearest->second > radius * (1 + kBoundRounding))) continue;
    const std::string rest = quoted(body) + " cannot rest there: ";
    if (nearest->first.empty()) return rest + "there is nothing that it could rest on.";
    return rest + "it reaches " + brief(radius) + " m from its origin at most, and the nearest that can carry it, " +
           nearest->first + ", is " + brief(nearest->second) + " m away.";
  }
  return "";
}

}  // namespace carom::editing_detail
