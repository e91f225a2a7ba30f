// SPDX-License-Identifier: MIT
#include "editing/strategy/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "adjoint/scene/body_model.h"

namespace carom::editing_detail {
namespace {

constexpr double kFlightRounding = 1e-9;

/// All flights of the centre of mass of a body: x0 in [lowest, highest], v in [slowest, fastest], and the acceleration.
struct Flights {
  Vec3 lowest, highest, slowest, fastest, acceleration = Vec3::Zero();
  double radius = 0;  ///< of a ball about the centre of mass that contains the body
};

/// The least of x + v t + a t^2 / 2 over [0, until], or a lower bound.
double leastOf(double x, double v, double a, double until) {
  const double straight = std::min(x, x + v * until);
  return a <= 0 ? std::min(x, x + v * until + 0.5 * a * until * until) : straight;
}

/// The least of n . x over a box.
double leastAlong(const Vec3& n, const Vec3& lower, const Vec3& upper) {
  double least = 0;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (n[k] != 0) least += n[k] * (n[k] > 0 ? lower[k] : upper[k]);
  return least;
}

class FlightProof {
 public:
  FlightProof(const EditProblem& problem, double until)
      : problem_(problem), scene_(problem.controls.startScene()), until_(until), flights_(scene_.bodies.size()) {}

  /// Whether what varies leaves flights as they are assumed.
  bool applies() const {
    const auto& controls = problem_.controls.controls();
    return std::none_of(controls.begin(), controls.end(), [&](const BoundControl& c) {
      const bool turns_solid = c.control.vary == "orientation" && bodyOf(c).immovable();
      return c.kind->owner == OwnerKind::scene || c.control.vary == "size" || turns_solid;
    });
  }

  /// Whether nothing that may reach the body meets anything before.
  bool isFree(std::size_t body) {
    std::vector<std::size_t> reach{body};
    std::vector<bool> seen(scene_.bodies.size(), false);
    seen[body] = true;
    for (std::size_t i = 0; i < reach.size(); ++i)
      for (std::size_t other = 0; other < scene_.bodies.size(); ++other) {
        if (other == reach[i] || !mayCollide(scene_.bodies[reach[i]], scene_.bodies[other])) continue;
        if (!apart(reach[i], other)) return false;
        const Body& next = scene_.bodies[other];
        if (seen[other] || next.fixed || next.kinematic) continue;  // nothing changes how a kinematic body moves
        seen[other] = true;
        reach.push_back(other);
      }
    return true;
  }

  const Flights& flightsOf(std::size_t body) {
    if (!flights_[body]) flights_[body] = boundsOf(scene_.bodies[body]);
    return *flights_[body];
  }

 private:
  const Body& bodyOf(const BoundControl& control) const {
    return scene_.bodies[static_cast<std::size_t>(bodyIndex(scene_, control.control.body))];
  }

  Flights boundsOf(const Body& body) const {
    Flights flights;
    const Vec3 center = body.fixed ? Vec3(Vec3::Zero()) : centerOfMass(body);  // a fixed body is bounded about its origin
    flights.lowest = flights.highest = body.position;
    flights.slowest = flights.fastest = body.velocity;
    for (const Variable& v : problem_.controls.variables()) {
      const Control& control = problem_.controls.controls()[static_cast<std::size_t>(v.control)].control;
      if (control.body != body.name) continue;
      const std::size_t k = std::string("xyz").find(v.component);
      if (k > 2) continue;
      const auto axis = static_cast<Eigen::Index>(k);
      if (control.vary == "position") flights.lowest[axis] = v.lower, flights.highest[axis] = v.upper;
      if (control.vary == "velocity") flights.slowest[axis] = v.lower, flights.fastest[axis] = v.upper;
    }
    flights.lowest -= Vec3::Constant(center.norm());  // whatever its orientation
    flights.highest += Vec3::Constant(center.norm());
    if (!body.fixed && !body.kinematic) flights.acceleration = scene_.gravity * body.gravity_factor;
    const ShapeKind& kind = kindOf(body.shape);
    flights.radius = kind.endless ? kInfinity : kind.boundingRadius(body.shape) + center.norm();
    return flights;
  }

  /// Whether two bodies are apart all the time, however they fly.
  bool apart(std::size_t a, std::size_t b) {
    const Flights &of_a = flightsOf(a), &of_b = flightsOf(b);
    if (const auto* plane = std::get_if<Plane>(&scene_.bodies[b].shape)) {
      const Vec3 n = scene_.bodies[b].orientation * plane->normal.normalized();
      const double x = leastAlong(n, of_a.lowest, of_a.highest) - plane->offset + leastAlong(-n, of_b.lowest, of_b.highest);
      return clear(leastOf(x, leastAlong(n, of_a.slowest, of_a.fastest), n.dot(of_a.acceleration), until_), of_a.radius);
    }
    const Vec3 a_b = of_a.acceleration - of_b.acceleration;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double above = leastOf(of_a.lowest[k] - of_b.highest[k], of_a.slowest[k] - of_b.fastest[k], a_b[k], until_);
      const double below = leastOf(of_b.lowest[k] - of_a.highest[k], of_b.slowest[k] - of_a.fastest[k], -a_b[k], until_);
      if (clear(std::max(above, below), of_a.radius + of_b.radius)) return true;
    }
    return false;
  }

  static bool clear(double distance, double extent) { return distance > extent + kFlightRounding * (1 + std::abs(distance)); }

  const EditProblem& problem_;
  const Scene& scene_;
  double until_;
  std::vector<std::optional<Flights>> flights_;
};

}  // namespace

std::optional<FreeFlight> freeFlightUntil(const EditProblem& problem, int body, double t) {
  FlightProof proof(problem, t);
  const auto index = static_cast<std::size_t>(body);
  if (!(t > 0) || !proof.applies() || !proof.isFree(index)) return std::nullopt;
  const Flights& flights = proof.flightsOf(index);
  const Vec3 offset = Vec3::Constant(centerOfMass(problem.controls.startScene().bodies[index]).norm());
  const Vec3 falls = 0.5 * t * t * flights.acceleration;
  FreeFlight at;
  at.lowest = flights.lowest + t * flights.slowest + falls - offset;
  at.highest = flights.highest + t * flights.fastest + falls + offset;
  at.slowest = flights.slowest + t * flights.acceleration;
  at.fastest = flights.fastest + t * flights.acceleration;
  return at;
}

}  // namespace carom::editing_detail
