// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit_options.h"

namespace carom {

/// A nail of a session. Keeps its meaning through undo and redo.
struct NailId {
  int value = -1;                                  ///< counted from 0
  bool operator==(const NailId&) const = default;  ///< the same nail
};

/// The change of a drag is measured, and kept small, against:
enum class MeasureFrom {
  grab,   ///< what was there when the gesture began: what other gestures did stays as it is
  start,  ///< what was there when the session began, or its controls were set last: gestures do not add up
};

/// How a session works. Work is counted in simulations and iterations, so that it is the same on every machine. The
/// clock is a safety stop only.
struct SessionOptions {
  MeasureFrom measure_from = MeasureFrom::grab;            ///< what a change is measured from
  SequencePolicy sequence = SequencePolicy::prefer_start;  ///< stay: no gesture changes which impacts happen
  double tolerance = 1e-9;                                 ///< of every number that is held, dimensionless
  /// At most, for one update. A motion of m bodies that move counts m / 5 where more than 5 move in the scene, m / all
  /// where fewer do: parts of the scene are simulated on their own where nothing else matters.
  int drag_simulations = 28;
  int dwell_simulations = 60;    ///< at most, for one call of EditSession::dwell, which has no clock
  int release_iterations = 200;  ///< at most, when a gesture ends
  double drag_seconds = 0.25;    ///< of the clock, for one update
  double release_seconds = 2;    ///< of the clock, when a gesture ends
  /// Steps of simulations (SimulateOptions::step_limit): where motions take many, an update makes fewer of them, so that
  /// it takes about so many steps; three of them in any case.
  double drag_steps = std::numeric_limits<double>::infinity();
  /// Steps after which the search at the end of a gesture begins no more.
  double release_steps = std::numeric_limits<double>::infinity();
  /// Nails from the start of the session that its motion does not meet are off, so that nothing moves by itself:
  /// EditSession::meetNails switches them on.
  bool unmet_nails_off = false;
};

/// How a body is held while it is dragged.
struct Grip {
  std::optional<Vec3> body_point = {};  ///< this point, in the shape's axes; else the shape's origin
  bool orientation = false;             ///< its orientation as well: as it is, until dragTo gives another
  /// "x", "y", "z" of the place that count; empty: all. The others are free.
  std::vector<std::string> components = {};
  bool place = true;  ///< false: the orientation alone, which has to be held then; the place goes where it likes
};

/// What a nail holds; see Nail in edit.h.
struct Held {
  std::optional<Vec3> position = std::nullopt;          ///< m
  std::optional<Quat> orientation = std::nullopt;       ///< shape to world
  std::optional<Vec3> velocity = std::nullopt;          ///< m/s
  std::optional<Vec3> angular_velocity = std::nullopt;  ///< rad/s, world axes
  std::optional<double> time = std::nullopt;            ///< s, of an impact
};
/// The constraint that a nail of a session stands for.
Constraint heldConstraint(const std::string& body, const When& at, const Held& held);

/// All that a session is about, see EditSession::setContent.
struct SessionContent {
  Scene scene;                    ///< as it shall be
  double duration = 1;            ///< s
  std::vector<Control> controls;  ///< what may vary
  /// Nails that there are keep their number; NailId(): a new one.
  std::vector<std::pair<NailId, Constraint>> nails;
};

/// One call of dragTo or dwell.
struct DragTarget {
  double milliseconds = 0;  ///< since the session began; for information
  Vec3 place = Vec3::Zero();          ///< m
  std::optional<Quat> orientation;    ///< shape to world
  std::optional<int> cut_after = {};  ///< simulations after which the clock or a stop ended it
  bool dwell = false;                 ///< the hand rested there
};

/// One gesture, and what it came to.
struct SessionGesture {
  /// What was done.
  enum class Kind { controls, nail, unnail, drag, undo, redo, set_nail, nail_on, meet_nails, content };
  /// How a drag ended.
  enum class Ending { release, release_nailed, cancel, release_nailed_where_it_got };

  Kind kind = Kind::drag;                ///< what was done
  double milliseconds = 0;               ///< since the session began, when it began; for information
  std::vector<Control> controls;         ///< controls: all of them, from then on; drag: those that vary as well
  std::optional<Constraint> constraint;  ///< nail, set_nail; drag: what the grab holds, and where that was
  int nail = -1;    ///< nail, unnail, set_nail, nail_on, and a drag that ended as a new one: the number of the nail
  bool on = false;  ///< nail_on
  std::optional<SessionContent> content = {};  ///< content
  std::string name = {};                       ///< content: for people

  std::string body;  ///< drag: from here on
  When at = 0.0;                     ///< drag: when it was taken hold of
  Grip grip;                         ///< drag: how
  std::optional<int> grabbed_nail = {};  ///< drag: the number of the nail that was taken hold of
  std::vector<DragTarget> targets;   ///< drag: one a call of dragTo or dwell
  Ending ending = Ending::release;   ///< drag: how it ended

  /// Where it solves at its end: units of work after which the clock or a stop ended that.
  std::optional<int> cut_after;

  bool reached = true;          ///< the update at its end
  double distance = 0;          ///< m, likewise
  std::vector<double> numbers;  ///< after it; see sessionNumbers
};

/// A session as data: how it began, and every gesture. Played again (editing/session_replay.h) it gives the
/// same bits.
struct SessionJournal {
  Scene scene;                    ///< as it was at the start
  double duration = 1;  ///< s
  std::vector<Control> controls;  ///< there from the start
  std::vector<Constraint> nails;  ///< there from the start, numbered from 0
  SessionOptions options;                ///< how it works
  std::vector<SessionGesture> gestures;  ///< in order
};
/// The word of the journal: "drag", "nail", ...
const char* nameOf(SessionGesture::Kind kind);
/// The word of the journal: "release", ...
const char* nameOf(SessionGesture::Ending ending);

}  // namespace carom
