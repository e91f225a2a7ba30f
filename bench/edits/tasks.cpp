// SPDX-License-Identifier: MIT
#include "bench/edits/tasks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "bench/edits/anywhere.h"
#include "bench/edits/checks.h"
#include "bench/edits/dice.h"
#include "bench/edits/goals.h"
#include "bench/edits/throws.h"
#include "bench/edits/varied.h"
#include "editing/problem/edit_problem.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace editing_detail;

namespace {

constexpr int kMostAttempts = 20000;
constexpr int kThrowsAScene = 8;     // hidden throws that are tried before another scene is drawn
constexpr double kLongest = 6;       // s, in which the wanted impacts have to come
constexpr double kInside = 0.9;      // of the room that bounds leave to a number
constexpr double kTiltInside = 0.2;  // radius of the cone that hidden tilts keep to
constexpr double kSmallestValidity = 0.01;

struct Hidden {
  Eigen::VectorXd changes, values;
  double distance = 0;
};

// Changes of a random direction, some of them zero, as far as bounds allow.
std::optional<Hidden> drawHidden(const ControlSet& controls, const ValidityRows& validity, bool other_sequence,
                                 Dice& dice) {
  const double farthest = other_sequence ? TaskLimits::kFarthestOther : TaskLimits::kFarthestSame;
  const double wanted = dice.logIn(TaskLimits::kNearest, farthest);
  const bool sparse = dice.chance(0.3);
  Eigen::VectorXd z(controls.size());
  for (double& number : z) {
    number = dice.in(-1, 1);
    if (sparse && dice.chance(0.5)) number = 0;
  }
  if (z.norm() < 1e-3) return std::nullopt;
  z *= wanted / z.norm();
  const Eigen::VectorXd lower = controls.lowerChanges(), upper = controls.upperChanges();
  Hidden hidden;
  hidden.changes.resize(z.size());
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const BoundControl& control = controls.controls()[static_cast<std::size_t>(controls.variables()[j].control)];
    const double weight = control.control.weight;
    if (control.control.vary == "tilt") z[j] = std::clamp(z[j], -0.7 * kTiltInside, 0.7 * kTiltInside);
    hidden.changes[j] = std::clamp(weight * z[j], kInside * lower[j], kInside * upper[j]);
    z[j] = hidden.changes[j] / weight;
  }
  hidden.distance = z.norm();
  if (hidden.distance < TaskLimits::kNearest) return std::nullopt;
  hidden.values = controls.valuesOf(hidden.changes);
  const Eigen::VectorXd valid = validity.evaluate(controls, hidden.values);
  if (valid.size() > 0 && !(valid.minCoeff() >= kSmallestValidity)) return std::nullopt;
  return hidden;
}

// A scene with its controls, and the motions of start and hidden throw up to one impact more than wanted.
class Draw {
 public:
  Draw(std::uint64_t seed, int index, int attempt, const Wanted& wanted)
      : dice_(seed, static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(attempt)), wanted_(wanted) {
    task_.seed = seed, task_.index = index, task_.wanted = wanted;
  }

  std::optional<Task> make() {
    task_.start = drawThrow(wanted_.family, dice_);
    OdeContacts contacts(task_.start);
    if (!contacts.overlaps().empty()) return std::nullopt;
    const Motion start = play(task_.start, contacts);
    if (!isPlain(start, 1)) return std::nullopt;
    task_.controls = drawControls(task_.start, wanted_.impacts, dice_);
    const ControlSet controls(task_.start, task_.controls);
    const ValidityRows validity(controls);
    task_.numbers = controls.size();
    for (int i = 0; i < kThrowsAScene; ++i) {
      if (const auto hidden = drawHidden(controls, validity, wanted_.other_sequence, dice_)) {
        if (makeWith(*hidden, controls, start, contacts)) return task_;
      }
    }
    return std::nullopt;
  }

 private:
  Motion play(const Scene& scene, ContactSource& contacts) const {
    return simulate(scene, contacts, kLongest, {static_cast<std::size_t>(wanted_.impacts) + 2, {}});
  }

  bool makeWith(const Hidden& hidden, const ControlSet& controls, const Motion& start, ContactSource& contacts) {
    Motion motion;
    try {
      motion = play(controls.sceneAt(hidden.values), contacts);
    } catch (const InputError&) {
      return false;  // bodies overlap
    }
    const std::size_t impacts = static_cast<std::size_t>(wanted_.impacts);
    if (!isPlain(motion, impacts)) return false;
    if (wanted_.family == Family::meeting && !meets(motion, impacts, "thrown", "other")) return false;
    task_.constraints = drawGoal(motion, wanted_, dice_);
    if (task_.constraints.empty()) return false;

    const ConstraintSet constraints(task_.start, task_.constraints);
    task_.rows = constraints.size();
    const auto hidden_extent = constraints.extentIn(motion);
    if (hidden_extent.events != impacts || task_.rows > task_.numbers) return false;
    const RowValues rows = constraints.evaluate(start);
    if (!rows.available || smallestMiss(constraints, rows) < TaskLimits::kSmallestMiss) return false;
    const auto start_extent = constraints.extentIn(start);
    if (!isPlain(start, start_extent.events)) return false;
    const bool other = motion.signature(hidden_extent.events) != start.signature(start_extent.events);
    if (other != wanted_.other_sequence) return false;
    task_.duration = durationFor(task_.constraints, std::max(hidden_extent.time, start_extent.time));
    task_.miss = rows.scaled.cwiseAbs().maxCoeff();
    return endsWell(task_.start, contacts) && endsWell(controls.sceneAt(hidden.values), contacts) &&
           isReachable(hidden, contacts);
  }

  bool endsWell(const Scene& scene, ContactSource& contacts) const {
    return simulate(scene, contacts, task_.duration).status == MotionStatus::complete;
  }

  bool isReachable(const Hidden& hidden, ContactSource& contacts) {
    if (!bench::isReachable(task_, hidden.values, contacts)) return false;
    task_.hidden_values = hidden.values;
    task_.hidden_distance = hidden.distance;
    task_.hidden_objective = 0.5 * hidden.changes.squaredNorm();
    return true;
  }

  Dice dice_;
  Wanted wanted_;
  Task task_;
};

}  // namespace

Task makeTask(std::uint64_t seed, int index) {
  const Wanted wanted = wantedOf(index);
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    try {
      const bool near = index < kThrownTasks;
      if (std::optional<Task> task =
              near ? Draw(seed, index, attempt, wanted).make() : drawAnywhere(seed, index, attempt, wanted)) {
        task->attempts = attempt + 1;
        return *task;
      }
    } catch (const InputError&) {
      // Bodies overlap at the start, or a hull has no volume: another draw.
    }
  }
  throw std::runtime_error("no draw of task " + std::to_string(index) + " keeps to the limits");
}

}  // namespace carom::bench
