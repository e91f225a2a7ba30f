// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit_options.h"

namespace carom {

/// The change of a drag is measured, and kept small, against:
enum class MeasureFrom {
  grab,   ///< what was there when the gesture began: what other gestures did stays as it is
  start,  ///< what was there when the session began, or its controls were set last: gestures do not add up
};

/// How a session works. Work is counted in simulations and iterations, so that it is the same on every machine. The
/// clock is a safety stop only.
struct SessionOptions {
  MeasureFrom measure_from = MeasureFrom::grab;
  SequencePolicy sequence = SequencePolicy::prefer_start;  ///< stay: no gesture changes which impacts happen
  double tolerance = 1e-9;                                 ///< of every number that is held, dimensionless
  /// At most, for one update. A motion of m bodies that move counts m / 5 where more than 5 move in the scene, m / all
  /// where fewer do: parts of the scene are simulated on their own where nothing else matters.
  int drag_simulations = 14;
  int release_iterations = 200;  ///< at most, when a gesture ends
  double drag_seconds = 0.25;
  double release_seconds = 2;
};

/// How a body is held while it is dragged.
struct Grip {
  std::optional<Vec3> body_point = {};  ///< this point, in the shape's axes; else the shape's origin
  bool orientation = false;             ///< its orientation as well: as it is, until dragTo gives another
  /// "x", "y", "z" of the place that count; empty: all. The others are free.
  std::vector<std::string> components = {};
};

/// What a nail holds; see Nail in edit.h.
struct Held {
  std::optional<Vec3> position = std::nullopt;          ///< m
  std::optional<Quat> orientation = std::nullopt;       ///< shape to world
  std::optional<Vec3> velocity = std::nullopt;          ///< m/s
  std::optional<Vec3> angular_velocity = std::nullopt;  ///< rad/s, world axes
  std::optional<double> time = std::nullopt;            ///< s, of an impact
};
Constraint heldConstraint(const std::string& body, const When& at, const Held& held);

/// One call of dragTo.
struct DragTarget {
  double milliseconds = 0;  ///< since the session began; for information
  Vec3 place = Vec3::Zero();
  std::optional<Quat> orientation;
  std::optional<int> cut_after;  ///< simulations after which the clock ended it
};

/// One gesture, and what it came to.
struct SessionGesture {
  enum class Kind { controls, nail, unnail, drag, undo, redo };
  enum class Ending { release, release_nailed, cancel };

  Kind kind = Kind::drag;
  double milliseconds = 0;               ///< since the session began, when it began; for information
  std::vector<Control> controls;         ///< controls: all of them, from then on
  std::optional<Constraint> constraint;  ///< nail; drag: what the grab holds, and where that was
  int nail = -1;                         ///< nail, unnail, release_nailed: the number of the nail

  std::string body;  ///< drag: from here on
  When at = 0.0;
  Grip grip;
  std::vector<DragTarget> targets;
  Ending ending = Ending::release;

  std::optional<int> cut_after;  ///< nail, drag: iterations after which the clock ended its last solve

  bool reached = true;          ///< the update at its end
  double distance = 0;          ///< m, likewise
  std::vector<double> numbers;  ///< after it; see sessionNumbers
};

/// A session as data: how it began, and every gesture. Played again (editing/session_replay.h) it gives the
/// same bits.
struct SessionJournal {
  Scene scene;
  double duration = 1;  ///< s
  std::vector<Control> controls;
  std::vector<Constraint> nails;  ///< there from the start, numbered from 0
  SessionOptions options;
  std::vector<SessionGesture> gestures;
};
const char* nameOf(SessionGesture::Kind kind);
const char* nameOf(SessionGesture::Ending ending);

}  // namespace carom
