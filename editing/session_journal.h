// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit_options.h"
#include "editing/wanted.h"

namespace carom {

/// Id of a nail of a session. Stable through undo and redo.
struct NailId {
  int value = -1;                                  ///< counted from 0
  bool operator==(const NailId&) const = default;  ///< the same nail
};

/// Reference from which the change of a drag is measured and minimised.
enum class MeasureFrom {
  grab,   ///< the start of the gesture: earlier gestures are kept
  start,  ///< the start of the session, or the last setControls: gestures do not accumulate
};

/// Options of a session. Work is limited in counted simulations and iterations, so that it is the same on every
/// machine. Time limits are a safety stop only.
struct SessionOptions {
  MeasureFrom measure_from = MeasureFrom::grab;            ///< reference of the change
  SequencePolicy sequence = SequencePolicy::prefer_start;  ///< stay: no gesture changes the impact sequence
  double tolerance = 1e-9;                                 ///< of every row, dimensionless
  /// At most, for one update. A motion of m moving bodies counts m / 5 if more than 5 move in the scene, otherwise m
  /// / all: parts of the scene are simulated by themselves if the rest is not involved.
  int drag_simulations = 28;
  int dwell_simulations = 60;    ///< at most, for one call of EditSession::dwell, which has no time limit
  int release_iterations = 200;  ///< at most, per release
  Seconds drag_seconds = 0.25;    ///< time limit of one update
  Seconds release_seconds = 2;    ///< time limit of a release
  /// Work limit of an update in simulation steps (SimulateOptions::step_limit): for slow motions it does fewer
  /// simulations, but at least three.
  double drag_steps = std::numeric_limits<double>::infinity();
  /// Simulation steps after which the search of a release starts no further simulation.
  double release_steps = std::numeric_limits<double>::infinity();
  /// Initial nails that the motion does not meet start switched off, so that nothing moves by itself;
  /// EditSession::meetNails switches them on.
  bool unmet_nails_off = false;
};

/// What a grab holds of a body.
struct Grip {
  std::optional<Vec3> body_point = {};  ///< a point in the shape's axes; default: the shape's origin
  /// At an impact: the mean of its contacts with other bodies, in place of a point of the body.
  bool contact = false;
  bool orientation = false;             ///< its orientation as well: the current one, until dragTo gives another
  /// The components of the position that are held, "x", "y", "z"; empty: all. The others are free.
  std::vector<std::string> components = {};
  bool place = true;  ///< false: only the orientation, which must then be held; the position is free
};

/// Targets of a nail; see Nail in edit.h.
struct NailTargets {
  std::optional<WantedVector> position = std::nullopt;          ///< m: {5, any, 0.3}
  std::optional<Quat> orientation = std::nullopt;       ///< shape to world
  std::optional<WantedVector> velocity = std::nullopt;          ///< m/s
  std::optional<WantedVector> angular_velocity = std::nullopt;  ///< rad/s, world axes
  std::optional<Seconds> time = std::nullopt;            ///< s, of an impact
};
/// The constraint of a nail of a session.
Constraint nailConstraint(const std::string& body, const When& at, const NailTargets& targets);

/// The whole content of a session, see EditSession::setContent.
struct SessionContent {
  Scene scene;                    ///< the new scene
  Seconds duration = 1;           ///< s
  std::vector<Control> controls;  ///< what may vary
  /// Existing nails keep their ids; NailId(): a new one.
  std::vector<std::pair<NailId, Constraint>> nails;
};

/// One call of dragTo, slideTo or dwell.
struct DragTarget {
  double milliseconds = 0;  ///< since the session began; for information
  Vec3 place = Vec3::Zero();          ///< m
  std::optional<Quat> orientation;    ///< shape to world
  /// Of a slideTo: those held from here on, see Grip::components.
  std::vector<std::string> components = {};
  std::optional<int> cut_after = {};  ///< simulations after which a time-out or a stop ended it
  bool dwell = false;                 ///< a call of dwell
};

/// One gesture and its outcome.
struct SessionGesture {
  /// Kind of gesture.
  enum class Kind { controls, nail, unnail, drag, undo, redo, set_nail, nail_on, meet_nails, content, keep_sequence };
  /// How a drag ended.
  enum class Ending { release, release_nailed, cancel, release_nailed_where_it_got };

  Kind kind = Kind::drag;                ///< what was done
  double milliseconds = 0;               ///< since the session began, when it began; for information
  std::vector<Control> controls;         ///< controls: all of them from then on; drag: those added
  std::optional<Constraint> constraint;  ///< nail, set_nail; drag: the grab as a constraint at its start
  int nail = -1;    ///< nail, unnail, set_nail, nail_on, and a drag that left a nail: id of the nail
  bool on = false;  ///< nail_on, keep_sequence
  std::optional<SessionContent> content = {};  ///< content
  std::string name = {};                       ///< content: its name for undo

  std::string body;  ///< drag: from here on
  When at = 0.0;                     ///< drag: time of the grab
  Grip grip; ///< drag: what is held
  std::optional<int> grabbed_nail = {};  ///< drag: id of the grabbed nail
  std::vector<DragTarget> targets;   ///< drag: one per call of dragTo, slideTo or dwell
  Ending ending = Ending::release;   ///< drag: how it ended

  /// If it solves at its end: units of work after which a time-out or a stop ended that.
  std::optional<int> cut_after;

  bool reached = true;          ///< in the update at its end
  double distance = 0;          ///< m, likewise
  std::vector<double> numbers;  ///< after it; see sessionNumbers
};

/// A session as data: its initial state and every gesture. Replayed (editing/session_replay.h) it gives the same
/// bits.
struct SessionJournal {
  Scene scene;                    ///< initial scene
  double duration = 1;  ///< s
  std::vector<Control> controls; ///< initial controls
  std::vector<Constraint> nails;  ///< initial nails, with ids from 0
  SessionOptions options;                ///< its options
  std::vector<SessionGesture> gestures;  ///< in order
};
/// The word of the journal: "drag", "nail", ...
const char* nameOf(SessionGesture::Kind kind);
/// The word of the journal: "release", ...
const char* nameOf(SessionGesture::Ending ending);

}  // namespace carom
