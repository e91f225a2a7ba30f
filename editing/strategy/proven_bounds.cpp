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

namespace carom::editing_detail {
namespace {

const double unlimited = std::numeric_limits<double>::infinity();
constexpr double kBoundRounding = 1e-9;

std::string quoted(const Body& body) { return "'" + body.name + "'"; }

std::string neverMeet(const Body& a, const Body& b) {
  if (mayCollide(a, b)) return "";
  const std::string names = quoted(a) + " and " + quoted(b);
  if (a.immovable() && b.immovable()) return names + " never collide: neither of them is moved by anything.";
  return names + " never collide: their collision filters keep them apart.";
}

bool varies(const EditProblem& problem, const std::string& body, std::initializer_list<const char*> words) {
  const auto& controls = problem.controls.controls();
  return std::any_of(controls.begin(), controls.end(), [&](const BoundControl& c) {
    return c.control.body == body && std::find(words.begin(), words.end(), c.control.vary) != words.end();
  });
}

bool gravityVaries(const EditProblem& problem) {
  const auto& controls = problem.controls.controls();
  return std::any_of(controls.begin(), controls.end(), [](const BoundControl& c) { return c.control.vary == "gravity"; });
}

/// Where the origin of a shape is to be: from `lower` to `upper`, which may be infinite.
struct PositionRange {
  std::array<double, 3> lower{-unlimited, -unlimited, -unlimited}, upper{unlimited, unlimited, unlimited};
  bool any = false;
};

bool readsPosition(const Row& row) { return row.kind && std::string(row.kind->word) == "position" && row.region < 0 && row.own < 0; }

PositionRange placeOf(const ConstraintSet& set, int constraint, double tolerance) {
  PositionRange place;
  for (const Row& row : set.rows()) {
    if (row.constraint != constraint || !readsPosition(row)) continue;
    const auto k = static_cast<std::size_t>(row.component);
    const bool range = row.isRange();
    place.lower[k] = (range ? row.lower : row.target) - tolerance * row.scale;
    place.upper[k] = (range ? row.upper : row.target) + tolerance * row.scale;
    place.any = true;
  }
  return place;
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
  std::pair<std::string, double> nearest{"", unlimited};
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
    const std::string rest = quoted(body) + " cannot rest where it is to: ";
    if (nearest->first.empty()) return rest + "there is nothing that it could rest on.";
    return rest + "it extends no further than " + brief(radius) + " m from its origin, and the nearest that can bear it, " +
           nearest->first + ", is " + brief(nearest->second) + " m away.";
  }
  return "";
}

namespace {

/// Kinetic energy at the start, J, at the bounds of what varies.
double kineticBound(const EditProblem& problem, int body, const BodyModel& model) {
  const Body& of = problem.controls.startScene().bodies[static_cast<std::size_t>(body)];
  Vec3 v = of.velocity.cwiseAbs(), w = of.angular_velocity.cwiseAbs();
  for (const Variable& variable : problem.controls.variables()) {
    const Control& control = problem.controls.controls()[static_cast<std::size_t>(variable.control)].control;
    if (control.body != of.name) continue;
    const std::size_t k = std::string("xyz").find(variable.component);
    if (k > 2) return unlimited;
    (control.vary == "velocity" ? v : w)[static_cast<Eigen::Index>(k)] = std::max(std::abs(variable.lower), std::abs(variable.upper));
  }
  return 0.5 * model.mass * v.squaredNorm() + 0.5 * model.inertia.maxCoeff() * w.squaredNorm();
}

double heightOfCenter(const Body& body, const BodyModel& model) {
  return (body.position + body.orientation * model.center).z();
}

/// How low the centre of mass of a body may come: to the top of the highest fixed horizontal plane below its start that it
/// collides with, and below that by no more than a centre of mass that is written may lie outside the shape. Infinitely low where
/// there is no such plane.
double lowestHeight(const Scene& scene, const Body& body, const BodyModel& model, double height) {
  double lowest = -unlimited;
  for (const Body& solid : scene.bodies) {
    const auto* plane = std::get_if<Plane>(&solid.shape);
    if (!plane || !solid.fixed || !mayCollide(body, solid)) continue;
    const Vec3 normal = solid.orientation * plane->normal.normalized();
    if (!(normal.z() > 0) || normal.head<2>().norm() > 0) continue;
    const double top = plane->offset + solid.position.z();
    if (top <= height) lowest = std::max(lowest, top);
  }
  const double outside = body.center_of_mass ? kindOf(body.shape).boundingRadius(body.shape) + model.center.norm() : 0;
  return lowest - outside;
}

/// What makes the bound of energy one.
bool energyOnlyFalls(const EditProblem& problem) {
  const Scene& scene = problem.controls.startScene();
  if (!(scene.gravity.z() < 0) || scene.gravity.head<2>().norm() > 0 || !scene.tilts.empty()) return false;
  for (const BoundControl& c : problem.controls.controls()) {
    const std::string& vary = c.control.vary;
    const bool speed = vary == "velocity" || vary == "angular_velocity";
    if (!speed && c.kind->owner != OwnerKind::material) return false;
  }
  return std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) {
    const bool moves = !b.velocity.isZero(0) || !b.angular_velocity.isZero(0) || varies(problem, b.name, {"velocity", "angular_velocity"});
    return (b.kinematic && moves) || b.surfaceMoves() || (!b.immovable() && b.gravity_factor < 0);
  });
}

/// The greatest height that the centre of mass of a body can come to, m; infinite where it is not known.
double greatestHeight(const EditProblem& problem, int body) {
  const Scene& scene = problem.controls.startScene();
  const double g = -scene.gravity.z();
  double energy = 0, weight = 0, from = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& other = scene.bodies[b];
    if (other.immovable()) continue;
    const BodyModel model = modelOf(other);
    const double height = heightOfCenter(other, model), own = model.mass * g * other.gravity_factor;
    energy += kineticBound(problem, static_cast<int>(b), model);
    if (static_cast<int>(b) == body) {
      weight = own, from = height;
    } else if (own > 0) {
      energy += own * (height - lowestHeight(scene, other, model, height));
    }
  }
  return weight > 0 ? from + energy / weight : unlimited;
}

}  // namespace

std::string whyItIsTooHigh(const EditProblem& problem, double tolerance) {
  const ConstraintSet& set = problem.constraints;
  if (!energyOnlyFalls(problem)) return "";
  const Scene& scene = problem.controls.startScene();
  for (int i = 0; i < set.size(); ++i) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    if (row.constraint < 0 || !readsPosition(row) || row.component != 2) continue;
    const Constraint& constraint = set.constraints()[static_cast<std::size_t>(row.constraint)];
    const int index = bodyIndex(scene, constraint.body);
    const Body& body = scene.bodies[static_cast<std::size_t>(index)];
    if (!constraint.relative_to.empty() || body.immovable()) continue;
    const double asked = (row.isRange() ? row.lower : row.target) - tolerance * row.scale;
    const double most = greatestHeight(problem, index) + modelOf(body).center.norm();
    if (!(asked > most + kBoundRounding * (std::abs(asked) + std::abs(most)))) continue;
    return "All the energy that there is lifts " + quoted(body) + " to " + brief(most) + " m at most; " + set.describeRow(i) +
           " is to be " + (row.isRange() ? "at least " : "") + brief(row.isRange() ? row.lower : row.target) + " m.";
  }
  return "";
}

}  // namespace carom::editing_detail
