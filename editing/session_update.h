// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/sequence_changes.h"

namespace carom {

/// Where an update got to.
enum class SessionStage {
  kept,       ///< the motion before it is still the best that is known
  predicted,  ///< by one differential update, and simulated
  improved,   ///< by several, until the target was met or the work of one update was done
  solved,     ///< at the end of a gesture: nearest to where it began, as far as the solver tells
};
/// "kept", "predicted", "improved" or "solved".
const char* nameOf(SessionStage stage);

/// What stands between a motion and what was asked for, as far as first derivatives tell.
struct SessionObstacle {
  /// What it is.
  enum class Kind {
    none,                 ///< targets and nails are met
    no_control_moves_it,  ///< nothing that may vary brings it nearer, whatever nails and bounds
    nails,                ///< without the nails it could go on
    bounds,               ///< numbers that vary are at their bounds
    border,               ///< a step nearer leads to other impacts, and none that was tried goes on from there
    work,                 ///< the work of one update was done, or it was stopped
    clock,                ///< the safety stop ended it
  };
  Kind kind = Kind::none;              ///< what it is
  std::vector<std::string> at_bounds;  ///< names of the numbers at their bounds: "velocity.x of 'hat'"
  std::string sentence;                ///< for people; empty where there is none
};
/// "none", "no_control_moves_it", "nails", "bounds", "border", "work" or "clock".
const char* nameOf(SessionObstacle::Kind kind);

/// What the session holds after a call, and how far that is from what was asked for.
struct SessionUpdate {
  /// Never null. Simulated from scene(), over the whole duration of the session.
  std::shared_ptr<const Motion> motion;
  /// That it is the motion of.
  const Scene& scene() const { return *motion->scene; }

  SessionStage stage = SessionStage::kept;  ///< how far it got
  bool reached = true;         ///< target, and nails that are held, are met within SessionOptions::tolerance
  double distance = 0;         ///< m, from the grabbed point to its target; 0 without one
  double turn = 0;             ///< rad, from the grabbed body's orientation to its target; 0 without one
  double scaled_distance = 0;  ///< largest error of a number that the grab holds, dimensionless
  double nail_error = 0;       ///< largest error of a number that a nail holds, SI (m, m/s, rad, ... mixed)
  double scaled_nail_error = 0;  ///< the same, dimensionless

  int iterations = 0;   ///< steps that were taken
  int simulations = 0;  ///< motions that were tried: the unit in which work is limited
  double milliseconds = 0;    ///< that it took
  bool cut_by_clock = false;  ///< the safety stop ended it: on a faster machine it may have gone further
  bool stopped = false;       ///< its stop token ended it
  bool moved = false;         ///< the motion is another one than before the call

  bool sequence_changed = false;  ///< impacts that count are others than when the gesture began
  /// How they differ: `before` are events of the motion at the begin of the gesture, `after` of this one.
  std::vector<SequenceChange> sequence_changes;
  SessionObstacle obstacle;  ///< what stood in the way
  std::string message;       ///< what happened, in sentences: what stood in the way, how the impacts changed
};

}  // namespace carom
