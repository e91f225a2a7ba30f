// SPDX-License-Identifier: MIT
#include "editing/strategy/energy_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "adjoint/scene/body_model.h"
#include "editing/detail/messages.hpp"
#include "editing/strategy/place_ranges.hpp"

namespace carom::editing_detail {
namespace {

constexpr double kEnergyRounding = 1e-9;

/// Kinetic energy at the start, J, at the bounds of what varies.
double kineticBound(const EditProblem& problem, int body, const BodyModel& model) {
  const Body& of = problem.controls.startScene().bodies[static_cast<std::size_t>(body)];
  Vec3 v = of.velocity.cwiseAbs(), w = of.angular_velocity.cwiseAbs();
  for (const Variable& variable : problem.controls.variables()) {
    const Control& control = problem.controls.controls()[static_cast<std::size_t>(variable.control)].control;
    if (control.body != of.name) continue;
    const std::size_t k = std::string("xyz").find(variable.component);
    if (k > 2) return kInfinity;
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
  double lowest = -kInfinity;
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

/// m g f of a body that moves, N.
double weightOf(const Scene& scene, const Body& body, const BodyModel& model) {
  return -scene.gravity.z() * model.mass * body.gravity_factor;
}

/// What its height gives a body at most, J.
double potentialOf(const Scene& scene, const Body& body, const BodyModel& model) {
  const double weight = weightOf(scene, body, model), height = heightOfCenter(body, model);
  return weight > 0 ? weight * (height - lowestHeight(scene, body, model, height)) : 0;
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

/// Energy of all at the start, but for what the height of one body adds, J; infinite where it is not known.
double energyBeside(const EditProblem& problem, int body) {
  const Scene& scene = problem.controls.startScene();
  double energy = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& other = scene.bodies[b];
    if (other.immovable()) continue;
    const BodyModel model = modelOf(other);
    energy += kineticBound(problem, static_cast<int>(b), model);
    if (static_cast<int>(b) != body) energy += potentialOf(scene, other, model);
  }
  return energy;
}

/// A body whose number a row reads, and the most that energy allows.
struct Bounded {
  const Body& body;
  int index;
  BodyModel model;
};

std::optional<Bounded> movingBodyOf(const EditProblem& problem, const Row& row) {
  const Scene& scene = problem.controls.startScene();
  if (row.constraint < 0 || row.region >= 0 || !row.kind) return std::nullopt;
  const Constraint& constraint = problem.constraints.constraints()[static_cast<std::size_t>(row.constraint)];
  if (!constraint.relative_to.empty()) return std::nullopt;
  const int index = bodyIndex(scene, constraint.body);
  const Body& body = scene.bodies[static_cast<std::size_t>(index)];
  if (body.immovable()) return std::nullopt;
  return Bounded{body, index, modelOf(body)};
}

/// What a row asks for at least, and with its sign turned round what it asks for at most.
double askedAtLeast(const Row& row, bool downwards) {
  if (downwards) return -(row.isRange() ? row.upper : row.target);
  return row.isRange() ? row.lower : row.target;
}

bool isAbove(double asked, double most, double tolerance) {
  return asked - tolerance > most + kEnergyRounding * (std::abs(asked) + std::abs(most));
}

struct Fastest {
  double most;
  const char* unit;
};

/// The most that a row of a speed, a velocity, a spin or an energy can be, given the kinetic energy of its body.
std::optional<Fastest> fastestOf(const Row& row, const BodyModel& model, double kinetic) {
  const std::string word = row.kind->word;
  if (word == "speed" || word == "velocity") return Fastest{std::sqrt(2 * kinetic / model.mass), " m/s"};
  if (word == "angular_velocity") return Fastest{std::sqrt(2 * kinetic / model.inertia.minCoeff()), " rad/s"};
  if (word == "kinetic_energy") return Fastest{kinetic, " J"};
  return std::nullopt;
}

/// A place and when it is asked for: a constraint, or the start, -1.
struct Stop {
  int constraint;
  PositionRange place;
  double earliest, latest;
};

std::vector<Stop> stopsOf(const EditProblem& problem, const std::string& body, double tolerance) {
  const ConstraintSet& set = problem.constraints;
  const Scene& scene = problem.controls.startScene();
  const Vec3& p = scene.bodies[static_cast<std::size_t>(bodyIndex(scene, body))].position;
  PositionRange start{{p.x(), p.y(), p.z()}, {p.x(), p.y(), p.z()}, true};
  std::vector<Stop> stops{{-1, start, 0, 0}};
  for (std::size_t i = 0; i < set.constraints().size(); ++i) {
    const Constraint& c = set.constraints()[i];
    if (c.body != body || !c.relative_to.empty()) continue;
    const PositionRange place = placeOf(set, static_cast<int>(i), tolerance);
    if (!place.any) continue;
    if (c.at.isTime()) {
      stops.push_back({static_cast<int>(i), place, c.at.time, c.at.time});
    } else if (c.at.span) {
      stops.push_back({static_cast<int>(i), place, c.at.span->first, c.at.span->second});
    } else {
      stops.push_back({static_cast<int>(i), place, 0, problem.duration});
    }
  }
  return stops;
}

/// Between two stops the way is longest that begins with the first at its earliest, or with the second at its earliest.
std::string tooFar(const Body& body, double speed, double way, double asked, const Stop& a, const Stop& b) {
  const bool in_order = b.latest - a.earliest >= a.latest - b.earliest;
  const double from = in_order ? a.earliest : b.earliest, to = in_order ? b.latest : a.latest;
  const std::string leads = "'" + body.name + "' has energy for " + brief(speed) + " m/s at most, which takes it " +
                            briefBeside(way, asked) + " m ";
  if (a.constraint < 0) return leads + "by " + brief(to) + " s; the place that is asked for is " +
           briefBeside(asked, way) + " m from its start.";
  return leads + "from " + number(from) + " s to " + number(to) + " s; the places that are asked for are " +
         briefBeside(asked, way) + " m apart.";
}

}  // namespace

std::optional<CenterLimits> centerLimits(const EditProblem& problem, int body) {
  const Scene& scene = problem.controls.startScene();
  const Body& of = scene.bodies[static_cast<std::size_t>(body)];
  if (!energyOnlyFalls(problem) || of.immovable()) return std::nullopt;
  const BodyModel model = modelOf(of);
  const double weight = weightOf(scene, of, model), height = heightOfCenter(of, model),
               beside = energyBeside(problem, body);
  const double kinetic = beside + potentialOf(scene, of, model);
  if (!(weight > 0) || !std::isfinite(kinetic)) return std::nullopt;
  return CenterLimits{of.position + of.orientation * model.center, std::sqrt(2 * kinetic / model.mass),
                      lowestHeight(scene, of, model, height), height + beside / weight, model.center.norm()};
}

std::string whyItIsTooHigh(const EditProblem& problem, double tolerance) {
  const ConstraintSet& set = problem.constraints;
  if (!energyOnlyFalls(problem)) return "";
  for (int i = 0; i < set.size(); ++i) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    const auto of = movingBodyOf(problem, row);
    if (!of || !readsPosition(row) || row.component != 2) continue;
    const double weight = weightOf(problem.controls.startScene(), of->body, of->model);
    if (!(weight > 0)) continue;
    const double center = heightOfCenter(of->body, of->model) + energyBeside(problem, of->index) / weight;
    const double most = center + of->model.center.norm(), asked = askedAtLeast(row, false);
    if (!isAbove(asked, most, tolerance * row.scale)) continue;
    return "'" + of->body.name + "' has energy for a height of " + briefBeside(most, asked) + " m at most; " +
           (row.isRange() ? "at least " : "") + briefBeside(asked, most) + " m is asked (" + set.describeRow(i) + ").";
  }
  return "";
}

std::string whyItIsTooFast(const EditProblem& problem, double tolerance) {
  const ConstraintSet& set = problem.constraints;
  if (!energyOnlyFalls(problem)) return "";
  for (int i = 0; i < set.size(); ++i) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    const auto of = movingBodyOf(problem, row);
    if (!of || !fastestOf(row, of->model, 0)) continue;
    const double kinetic = energyBeside(problem, of->index) + potentialOf(problem.controls.startScene(), of->body, of->model);
    const Fastest fastest = *fastestOf(row, of->model, kinetic);
    for (const bool downwards : {false, true}) {
      const double asked = askedAtLeast(row, downwards);
      if (!isAbove(asked, fastest.most, tolerance * row.scale)) continue;
      const double value = downwards ? -asked : asked;
      return "'" + of->body.name + "' has energy for " + briefBeside(fastest.most, std::abs(value)) + fastest.unit + " at most; " +
             (row.isRange() ? (downwards ? "at most " : "at least ") : "") + briefBeside(value, fastest.most) + fastest.unit +
             " is asked (" + set.describeRow(i) + ").";
    }
  }
  return "";
}

std::string whyItIsTooFar(const EditProblem& problem, double tolerance) {
  if (!energyOnlyFalls(problem)) return "";
  const Scene& scene = problem.controls.startScene();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    if (body.immovable()) continue;
    const std::vector<Stop> stops = stopsOf(problem, body.name, tolerance);
    if (stops.size() < 2) continue;
    const BodyModel model = modelOf(body);
    const double kinetic = energyBeside(problem, static_cast<int>(b)) + potentialOf(scene, body, model);
    const double speed = std::sqrt(2 * kinetic / model.mass);
    for (std::size_t i = 0; i < stops.size(); ++i)
      for (std::size_t j = i + 1; j < stops.size(); ++j) {
        const Stop &from = stops[i], &to = stops[j];
        const double time = std::max(to.latest - from.earliest, from.latest - to.earliest);
        const double way = speed * time + 2 * model.center.norm(), asked = distanceOf(from.place, to.place);
        if (!isAbove(asked, way, 0)) continue;
        return tooFar(body, speed, way, asked, from, to);
      }
  }
  return "";
}

}  // namespace carom::editing_detail
