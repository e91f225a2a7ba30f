// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/sequence_changes.h"

namespace carom {

/// Stage that an update reached.
enum class SessionStage {
  kept,       ///< the previous motion is still the best
  predicted,  ///< one linearised step, simulated
  improved,   ///< several steps, until the target was met or the work limit was reached
  solved,     ///< at the end of a gesture: the change is minimal to the tolerance of the solver
};
/// "kept", "predicted", "improved" or "solved".
const char* nameOf(SessionStage stage);

/// What prevents a motion from meeting its targets, to first order.
struct SessionObstacle {
  /// Kind of obstacle.
  enum class Kind {
    none,                 ///< targets and nails are met
    no_control_moves_it,  ///< no control brings it nearer, even without nails and bounds
    nails,                ///< it could get nearer without the nails
    bounds,               ///< active bounds
    border,               ///< a boundary of the impact sequence: a step nearer leads to other impacts, and no trial continues from there
    work,                 ///< the work limit of one update, or it was stopped
    clock, ///< the time limit
  };
  Kind kind = Kind::none; ///< kind of obstacle
  std::vector<std::string> at_bounds;  ///< names of the parameters at active bounds: "velocity.x of 'hat'"
  std::string sentence;                ///< as text; empty if none
};
/// "none", "no_control_moves_it", "nails", "bounds", "border", "work" or "clock".
const char* nameOf(SessionObstacle::Kind kind);

/// State of the session after a call, and its distance from the targets.
struct SessionUpdate {
  /// Never null. Simulated from scene(), over the whole duration of the session.
  std::shared_ptr<const Motion> motion;
  /// The scene of that motion.
  const Scene& scene() const { return *motion->scene; }

  SessionStage stage = SessionStage::kept;  ///< stage reached
  bool reached = true;         ///< target and enforced nails are met within SessionOptions::tolerance
  double distance = 0;         ///< m, from the grabbed point to its target; 0 without a target
  double turn = 0;             ///< rad, from the grabbed body's orientation to its target; 0 without a target
  double scaled_distance = 0;  ///< largest error of a row of the grab, dimensionless
  double nail_error = 0;       ///< largest error of a row of a nail, SI (mixed units: m, m/s, rad, ...)
  double scaled_nail_error = 0;  ///< the same, dimensionless

  int iterations = 0;   ///< steps taken
  int simulations = 0;  ///< simulations: the unit in which work is limited
  double milliseconds = 0;    ///< wall time
  bool cut_by_clock = false;  ///< timed out: a faster machine may get further
  bool stopped = false;       ///< its stop token ended it
  bool moved = false;         ///< the motion differs from the one before the call

  bool sequence_changed = false;  ///< reported impacts differ from those at the start of the gesture
  /// The differences: `before` are events of the motion at the start of the gesture, `after` of this one.
  std::vector<SequenceChange> sequence_changes;
  SessionObstacle obstacle;  ///< what prevents reaching the target
  std::string message;       ///< what happened, in sentences: the obstacle, changes of the impacts
};

}  // namespace carom
