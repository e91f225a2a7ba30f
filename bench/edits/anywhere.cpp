// SPDX-License-Identifier: MIT
#include "bench/edits/anywhere.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "bench/edits/checks.h"
#include "bench/edits/dice.h"
#include "bench/edits/hidden_motions.h"
#include "bench/edits/tables.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace editing_detail;

namespace {

constexpr std::size_t kMostEvents = 200;
constexpr double kSmallestTurn = 0.01, kLargestTurn = 1.5;  // rad, of a velocity
constexpr double kSlower = 0.6, kFaster = 1.6;

// Another value of every number that varies: a velocity turned by any angle, another speed, another material.
void moveAway(Scene& scene, const Control& c, bool planar, Dice& dice) {
  if (c.vary == "elasticity") {
    double& e = scene.materials[static_cast<std::size_t>(materialIndex(scene, c.material))].elasticity;
    e = std::clamp(e + dice.in(-0.15, 0.15), 0.3, 0.99);
    return;
  }
  Body& body = scene.bodies[static_cast<std::size_t>(bodyIndex(scene, c.body))];
  if (c.vary == "velocity") {
    const double side = dice.chance(0.5) ? 1 : -1;
    const double angle = side * dice.logIn(kSmallestTurn, kLargestTurn);
    const Vec3 axis = planar ? Vec3(Vec3::UnitZ()) : dice.direction();
    const Vec3 before = body.velocity;
    body.velocity = dice.logIn(kSlower, kFaster) * (Eigen::AngleAxisd(angle, axis) * body.velocity);
    for (int i = 0; i < 3; ++i)
      if (!c.components.empty() &&
          std::find(c.components.begin(), c.components.end(), std::string(1, "xyz"[i])) == c.components.end())
        body.velocity[i] = before[i];
  } else if (c.vary == "position") {
    Vec3 by = 0.05 * dice.inCube(1);
    if (planar) by.z() = 0;
    body.position += by;
  } else if (c.vary == "angular_velocity") {
    body.angular_velocity += 2 * dice.inCube(1);
  } else if (c.vary == "mass" && body.mass) {
    *body.mass *= dice.logIn(0.5, 2);
  }
}

// Some numbers are kept within a range that holds start and hidden values with room to spare.
void bound(const Scene& start, const Eigen::VectorXd& hidden, std::vector<Control>& controls, Dice& dice) {
  int first = 0;
  for (Control& c : controls) {
    const ControlSet set(start, {c});
    if (dice.chance(0.2)) {
      for (int j = 0; j < set.size(); ++j) {
        const Variable& v = set.variables()[static_cast<std::size_t>(j)];
        const double a = std::min(v.start, hidden[first + j]), b = std::max(v.start, hidden[first + j]);
        const double room = 0.1 * (b - a) + 0.05 * std::abs(b);
        c.min.push_back(std::max(v.lower, a - dice.in(1, 3) * room));
        c.max.push_back(std::min(v.upper, b + dice.in(1, 3) * room));
      }
    }
    first += set.size();
  }
}

class DrawAnywhere {
 public:
  DrawAnywhere(std::uint64_t seed, int index, int attempt, const Wanted& wanted)
      : dice_(seed, static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(attempt)) {
    task_.seed = seed, task_.index = index, task_.wanted = wanted;
  }

  std::optional<Task> make() {
    const auto hidden = drawHiddenMotion(task_.wanted, dice_);
    if (!hidden) return std::nullopt;
    const ControlSet at_hidden(hidden->scene, hidden->controls);
    const Eigen::VectorXd values = at_hidden.startValues();
    task_.start = hidden->scene;
    for (const Control& c : hidden->controls) moveAway(task_.start, c, hidden->planar, dice_);
    task_.controls = hidden->controls, task_.constraints = hidden->constraints, task_.sequence = hidden->sequence;
    bound(task_.start, values, task_.controls, dice_);
    task_.duration = hidden->duration;
    OdeContacts contacts(task_.start);
    if (!contacts.overlaps().empty()) return std::nullopt;
    return isWanted(values, *hidden, contacts) ? std::optional(task_) : std::nullopt;
  }

 private:
  bool isWanted(const Eigen::VectorXd& values, const HiddenMotion& hidden, ContactSource& contacts) {
    const EditProblem problem(task_.start, contacts, task_.duration, task_.controls, task_.constraints);
    task_.numbers = problem.controls.size(), task_.rows = problem.constraints.size();
    if (static_cast<int>(problem.constraints.equations().size()) > task_.numbers) return false;
    const Motion motion = play(problem.controls.sceneAt(values), contacts), start = play(task_.start, contacts);
    const RowValues met = problem.constraints.evaluate(motion), missed = problem.constraints.evaluate(start);
    if (!met.available || !(largestMiss(met) <= 1e-10)) return false;
    if (!beginsWith(motion, task_.sequence)) return false;
    if (hidden.missed_at_start && missed.available) return false;
    if (missed.available && !(smallestMiss(problem.constraints, missed) >= TaskLimits::kSmallestMiss)) return false;
    task_.miss = missed.available ? largestMiss(missed) : std::numeric_limits<double>::infinity();
    const auto extent = problem.constraints.extentIn(motion);
    if (!isClear(motion, extent.events)) return false;
    task_.wanted.impacts = static_cast<int>(impactsIn(motion, extent.events));
    task_.wanted.other_sequence = !missed.available || motion.signature(extent.events) !=
                                                           start.signature(problem.constraints.extentIn(start).events);
    keepHidden(problem.controls, values);
    return isReachable(task_, values, contacts);
  }

  void keepHidden(const ControlSet& controls, const Eigen::VectorXd& values) {
    double distance = 0, objective = 0;
    for (int j = 0; j < controls.size(); ++j) {
      const Variable& v = controls.variables()[static_cast<std::size_t>(j)];
      const double y = changeOf(v, values[j]);
      const double weight = controls.controls()[static_cast<std::size_t>(v.control)].control.weight;
      objective += 0.5 * y * y, distance += y * y / (weight * weight);
    }
    task_.hidden_values = values, task_.hidden_distance = std::sqrt(distance), task_.hidden_objective = objective;
  }

  Motion play(const Scene& scene, ContactSource& contacts) const {
    return simulate(scene, contacts, task_.duration, {.impact_limit = kMostEvents, .asked = {}});
  }

  // Impacts that matter are single, and far from where derivatives stop; what else happens is free.
  static bool isClear(const Motion& motion, std::size_t count) {
    count = std::min(count, motion.events.size());
    return std::all_of(
        motion.events.begin(), motion.events.begin() + static_cast<std::ptrdiff_t>(count), [](const Event& e) {
          if (e.kind != EventKind::impact) return true;
          const auto counted = std::count_if(e.contacts.begin(), e.contacts.end(),
                                             [](const Contact& c) { return c.counted && !c.held; });
          return counted <= 1 && (e.contacts.size() > 1 || e.margins.smallest() >= TaskLimits::kSmallestMargin);
        });
  }

  static std::ptrdiff_t impactsIn(const Motion& motion, std::size_t count) {
    return std::count_if(motion.events.begin(),
                         motion.events.begin() + static_cast<std::ptrdiff_t>(std::min(count, motion.events.size())),
                         [](const Event& e) { return e.counts(); });
  }

  Dice dice_;
  Task task_;
};

}  // namespace

std::optional<Task> drawAnywhere(std::uint64_t seed, int index, int attempt, const Wanted& wanted) {
  return DrawAnywhere(seed, index, attempt, wanted).make();
}

}  // namespace carom::bench
