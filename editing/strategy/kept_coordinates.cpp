// SPDX-License-Identifier: MIT
#include "editing/strategy/kept_coordinates.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "adjoint/motion/plan.h"
#include "adjoint/scene/body_model.h"
#include "editing/detail/messages.hpp"
#include "editing/strategy/free_flight.hpp"

// Along an axis perpendicular to gravity the centre of mass of such a body is at x(t) = x_0 + v t with x_0 and v within the bounds of what varies:
// an interval whose ends are linear in t, so that what holds at two times holds between them.
namespace carom::editing_detail {
namespace {

constexpr double kAxisRounding = 1e-9;

struct Interval {
  double lower = 0, upper = 0;
};

/// A coordinate of the origin of a body over time.
struct KeptCoordinate {
  Interval at_start, speed;
  bool locked = false;  ///< the speed does not vary
  double offset = 0;    ///< at most, between the origin and the centre of mass

  Interval at(double t) const {
    if (t == 0) return {at_start.lower - offset, at_start.upper + offset};  // where speeds are unbounded, too
    return {at_start.lower + speed.lower * t - offset, at_start.upper + speed.upper * t + offset};
  }
};

struct Proof {
  const EditProblem& problem;
  const Scene& scene = problem.controls.startScene();

  /// Whether a control of the body, or of its material, varies what a word names.
  bool varies(const Body& body, const std::string& word, const std::string& component = "") const {
    for (const Variable& v : problem.controls.variables()) {
      const Control& control = problem.controls.controls()[static_cast<std::size_t>(v.control)].control;
      const bool own = control.body == body.name || (!control.material.empty() && control.material == body.material);
      if (own && control.vary == word && (component.empty() || v.component == component)) return true;
    }
    return false;
  }

  Interval rangeOf(const Body& body, const std::string& word, const std::string& component, double written) const {
    Interval range{written, written};
    for (const Variable& v : problem.controls.variables()) {
      const Control& control = problem.controls.controls()[static_cast<std::size_t>(v.control)].control;
      if (control.body == body.name && control.vary == word && v.component == component) range = {v.lower, v.upper};
    }
    return range;
  }

  bool slidesFreely(const Body& body, const Body& plane) const {
    return combine(materialOf(scene, body), materialOf(scene, plane)).friction == 0 && !varies(body, "friction") &&
           !varies(plane, "friction");
  }

  /// A uniform ball whose motion is its own mirror image in the plane perpendicular to an axis.
  bool isMirrored(const Body& body, Eigen::Index axis) const {
    const bool uniform = std::holds_alternative<Sphere>(body.shape) && !body.center_of_mass && body.inertia == Inertia{} && !varies(body, "inertia");
    if (!uniform || body.velocity[axis] != 0 || varies(body, "velocity", std::string(1, "xyz"[axis]))) return false;
    for (Eigen::Index k = 0; k < 3; ++k)
      if (k != axis && (body.angular_velocity[k] != 0 || varies(body, "angular_velocity", std::string(1, "xyz"[k])))) return false;
    return true;
  }

  /// Nothing where it is not proven to be kept. `until`: what follows after the first contact with this body does not matter.
  std::optional<KeptCoordinate> keptCoordinate(const Body& body, Eigen::Index axis, const Body* until) const {
    if (body.immovable() || !scene.tilts.empty()) return std::nullopt;
    for (const BoundControl& c : problem.controls.controls())
      if (c.kind->owner == OwnerKind::impact || c.kind->owner == OwnerKind::scene) return std::nullopt;
    if (scene.gravity[axis] != 0) return std::nullopt;
    const bool mirrored = isMirrored(body, axis);
    for (const Body& other : scene.bodies) {
      if (&other == &body || &other == until || !mayCollide(body, other)) continue;
      const auto* plane = std::get_if<Plane>(&other.shape);
      if (!plane || !other.fixed || varies(other, "orientation")) return std::nullopt;
      const bool parallel = (other.orientation * plane->normal)[axis] == 0;
      const bool still = !other.surfaceMoves() && !varies(other, "surface_velocity") && !varies(other, "surface_angular_velocity");
      if (!parallel || !((mirrored && still) || slidesFreely(body, other))) return std::nullopt;
    }
    const std::string word(1, "xyz"[axis]);
    KeptCoordinate kept;
    const double offset = centerOfMass(body).norm();
    if (offset > 0 && varies(body, "size")) return std::nullopt;
    kept.offset = 2 * offset;  // of the start, and of then
    kept.at_start = rangeOf(body, "position", word, body.position[axis]);
    kept.speed = rangeOf(body, "velocity", word, body.velocity[axis]);
    kept.locked = kept.speed.lower == kept.speed.upper;
    return kept;
  }

  /// A coordinate of a body up to its first contact with another: kept, or that of a fixed body.
  std::optional<KeptCoordinate> coordinate(const Body& body, Eigen::Index axis, const Body& until) const {
    if (!body.fixed) return keptCoordinate(body, axis, &until);
    if (kindOf(body.shape).endless) return std::nullopt;
    KeptCoordinate kept;
    kept.at_start = rangeOf(body, "position", std::string(1, "xyz"[axis]), body.position[axis]);
    return kept;
  }

  const Body& named(const std::string& name) const { return scene.bodies[static_cast<std::size_t>(bodyIndex(scene, name))]; }

  /// "velocity.x of 'ball' lies between 0 and 2 m/s".
  std::string speedOf(const Body& body, Eigen::Index axis, const Interval& speed) const {
    const std::string name = std::string("velocity.") + "xyz"[axis] + " of '" + body.name + "'";
    if (speed.lower == speed.upper) return name + " is locked at " + brief(speed.lower) + " m/s";
    return name + " lies between " + brief(speed.lower) + " and " + brief(speed.upper) + " m/s";
  }

  std::string why(const Body& body, Eigen::Index axis, const KeptCoordinate& kept) const {
    return speedOf(body, axis, kept.speed) + ", and nothing that it meets " +
           (kept.locked && kept.speed.lower == 0 ? "turns it aside" : "changes it");
  }

  /// What a number can come to, and why.
  struct Reach {
    Interval values;
    std::string why;
  };

  /// Of a component of a position, or of a velocity; nothing where no bounds are proven.
  std::optional<Reach> reachOf(const Body& body, Eigen::Index axis, bool of_velocity, const When& at) const {
    if (const auto kept = keptCoordinate(body, axis, nullptr)) {
      double from = 0, to = problem.duration;
      if (at.isTime()) from = to = at.time;
      if (at.span) from = at.span->first, to = at.span->second;
      const Interval a = kept->at(from), b = kept->at(to);
      const Interval place{std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
      return Reach{of_velocity ? kept->speed : place, why(body, axis, *kept)};
    }
    if (!at.isTime()) return std::nullopt;
    const auto flight = freeFlightUntil(problem, bodyIndex(scene, body.name), at.time);
    if (!flight) return std::nullopt;
    const Interval speed = rangeOf(body, "velocity", std::string(1, "xyz"[axis]), body.velocity[axis]);
    const Interval values = of_velocity ? Interval{flight->slowest[axis], flight->fastest[axis]}
                                        : Interval{flight->lowest[axis], flight->highest[axis]};
    return Reach{values, speedOf(body, axis, speed) + ", and it meets nothing before"};
  }

  /// Of a row of a position or a velocity: why it is out of reach.
  std::string outOfReach(int index, double tolerance) const {
    const ConstraintSet& set = problem.constraints;
    const Row& row = set.rows()[static_cast<std::size_t>(index)];
    if (row.constraint < 0 || row.region >= 0 || !row.kind) return "";
    const std::string word = row.kind->word;
    const Constraint& constraint = set.constraints()[static_cast<std::size_t>(row.constraint)];
    if ((word != "position" && word != "velocity") || !constraint.relative_to.empty()) return "";
    const auto reach = reachOf(named(constraint.body), row.component, word == "velocity", constraint.at);
    if (!reach) return "";
    const double lower = row.isRange() ? row.lower : row.target, upper = row.isRange() ? row.upper : row.target;
    const auto beyond = [&](double wanted, double most) {
      return wanted - most > tolerance * row.scale + kAxisRounding * (1 + std::abs(wanted) + std::abs(most));
    };
    const bool above = beyond(lower, reach->values.upper), below = beyond(-upper, -reach->values.lower);
    if (!above && !below) return "";
    std::string row_name = set.describeRow(index);
    row_name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(row_name[0])));
    const char* unit = word == "velocity" ? " m/s" : " m";
    const double most = above ? reach->values.upper : reach->values.lower, asked = above ? lower : upper;
    return row_name + " comes to " + briefBeside(most, asked) + unit + " at " + (above ? "most" : "least") + "; " +
           briefBeside(asked, most) + unit + " is asked: " + reach->why + ".";
  }

  /// Why two bodies never meet.
  std::string apart(const std::string& of, const std::string& with) const {
    const Body &a = named(of), &b = named(with);
    if (varies(a, "size") || varies(b, "size")) return "";
    const double both = kindOf(a.shape).boundingRadius(a.shape) + kindOf(b.shape).boundingRadius(b.shape);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto of_a = coordinate(a, axis, b), of_b = coordinate(b, axis, a);
      if (!of_a || !of_b) continue;
      const auto gap = [&](double t) {
        const Interval x = of_a->at(t), y = of_b->at(t);
        return std::pair{y.lower - x.upper, x.lower - y.upper};
      };
      const auto [above_0, below_0] = gap(0);
      const auto [above_1, below_1] = gap(problem.duration);
      const double least = std::max(std::min(above_0, above_1), std::min(below_0, below_1));
      if (!(least > both + kAxisRounding * (1 + std::abs(least)))) continue;
      std::string reasons = why(a, axis, *of_a);
      if (!b.fixed) reasons += "; " + why(b, axis, *of_b);
      return "'" + a.name + "' and '" + b.name + "' never meet: along " + "xyz"[axis] + " they stay " + briefBeside(least, both) +
             " m apart, and would have to come within " + briefBeside(both, least) + " m. " + sentence(reasons);
    }
    return "";
  }
};

}  // namespace

std::string whyItStaysAway(const EditProblem& problem, double tolerance) {
  const Proof proof{problem};
  for (const Constraint& constraint : problem.constraints.constraints()) {
    const bool counted = constraint.at.impact > 0 && !constraint.at.with.empty() && !constraint.targets.empty();
    const std::string with = constraint.hits ? constraint.hits->with : counted ? constraint.at.with : "";
    if (with.empty()) continue;
    if (const std::string why = proof.apart(constraint.body, with); !why.empty()) return why;
  }
  for (int i = 0; i < problem.constraints.size(); ++i)
    if (const std::string why = proof.outOfReach(i, tolerance); !why.empty()) return why;
  return "";
}

}  // namespace carom::editing_detail
