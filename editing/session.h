// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit.h"
#include "editing/session_journal.h"

namespace carom {

/// A nail of a session. Keeps its meaning through undo and redo.
struct NailId {
  int value = -1;
  bool operator==(const NailId&) const = default;
};

/// Where an update got to.
enum class SessionStage {
  kept,       ///< the motion before it is still the best that is known
  predicted,  ///< by one differential update, and simulated
  improved,   ///< by several, until the target was met or the work of one update was done
  solved,     ///< at the end of a gesture: nearest to where it began, as far as the solver tells
};
const char* nameOf(SessionStage stage);

/// What the session holds after a call, and how far that is from what was asked for.
struct SessionUpdate {
  /// Never null. Simulated from scene(), over the whole duration of the session.
  std::shared_ptr<const Motion> motion;
  const Scene& scene() const { return *motion->scene; }

  SessionStage stage = SessionStage::kept;
  bool reached = true;         ///< target and nails are met within SessionOptions::tolerance
  double distance = 0;         ///< m, from the grabbed point to its target; 0 without one
  double turn = 0;             ///< rad, from the grabbed body's orientation to its target; 0 without one
  double scaled_distance = 0;  ///< largest error of a number that the grab holds, dimensionless
  double nail_error = 0;       ///< largest error of a number that a nail holds, SI (m, m/s, rad, ... mixed)
  double scaled_nail_error = 0;

  int iterations = 0;   ///< steps that were taken
  int simulations = 0;  ///< motions that were tried: the unit in which work is limited
  double milliseconds = 0;
  bool cut_by_clock = false;      ///< the safety stop ended it: on a faster machine it may have gone further
  bool sequence_changed = false;  ///< impacts that count are others than when the gesture began
  std::string message;            ///< what happened, in sentences: what stood in the way, how the impacts changed
};

/// Direct manipulation of a motion: a body is taken hold of at some moment of its flight and dragged, and the causes
/// that may vary follow, many times a second.
///
///   EditSession session(scene, contacts, 2.0);
///   session.vary(velocity("hat"), angularVelocity("hat"));
///   session.nail("hat", 0.4, {.position = {{0.8, 0, 1.7}}});
///   session.grab("hat", 1.4);
///   SessionUpdate u = session.dragTo({1.9, 0, 1.5});   // for each move of the mouse
///   session.release();                                 // one step for undo
///
/// A drag keeps the numbers that vary as near as possible (1/2 sum (w_i z_i)^2 as in Edit) to what they were when it
/// began, while nails hold and the grabbed body comes to its target; where it cannot, as near as possible to that. See
/// docs/session.md. The same calls give the same bits, on any machine with the same arithmetic, as long as no update is
/// cut by the clock; the journal remembers where that happened, so that its replay is the same in any case.
///
/// Misuse and bad input throw InputError and leave the session as it was. Not for use from two threads at once.
class EditSession {
 public:
  /// The scene as written. Keeps `contacts` by reference and uses it for all simulations.
  EditSession(const Scene& scene, ContactSource& contacts, double duration, const SessionOptions& options = {});
  /// With controls and nails that are there from the start; nails need not be met yet.
  EditSession(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
              std::vector<Constraint> nails, const SessionOptions& options = {});
  ~EditSession();
  EditSession(EditSession&&) noexcept;
  EditSession& operator=(EditSession&&) noexcept;

  /// Lets more numbers vary. One step for undo, as is setControls.
  template <class... Controls>
  void vary(Controls... more) {
    std::vector<Control> all = controls();
    (all.push_back(std::move(more)), ...);
    setControls(std::move(all));
  }
  /// In place of all controls there are.
  void setControls(std::vector<Control> controls);

  /// Adds a nail, which holds until it is removed, and solves for it; last() tells how that went. One step for undo. A
  /// nail that cannot be met stays, and is met as soon as it can be.
  NailId nail(Constraint constraint);
  NailId nail(const std::string& body, When at, const Held& held) { return nail(heldConstraint(body, at, held)); }
  /// Holds the body as it is at that moment: place and orientation.
  NailId nailAsItIs(const std::string& body, When at);
  /// Removes a nail. The motion stays. One step for undo.
  void unnail(NailId id);

  /// Takes hold of a moving body at a time or an impact of the motion. From here to `release` is one step for undo.
  SessionUpdate grab(const std::string& body, When at, const Grip& grip = {});
  /// Moves the grabbed point (without Grip::body_point: the shape's origin) to a place in the world, or towards it.
  SessionUpdate dragTo(const Vec3& place);
  /// The same with an orientation, shape to world; for grips that hold it.
  SessionUpdate dragTo(const Vec3& place, const Quat& orientation);
  /// Lets go: minimises the change, or searches further for the target where it was not reached.
  SessionUpdate release();
  /// The same, and the grabbed body stays nailed to its last target.
  SessionUpdate releaseNailed();
  /// Lets go and puts everything back as it was before the grab.
  SessionUpdate cancel();
  bool isGrabbed() const;
  /// Where the grabbed point is, and the orientation of the grabbed body.
  Vec3 grabbedPlace() const;
  Quat grabbedOrientation() const;

  /// Back by one step; within a gesture, cancels it. Nothing happens where there is none.
  SessionUpdate undo();
  SessionUpdate redo();
  bool canUndo() const;
  bool canRedo() const;

  const Scene& scene() const { return *motion().scene; }
  const Motion& motion() const { return *last().motion; }
  /// What the last call came to.
  const SessionUpdate& last() const;
  double duration() const;
  const std::vector<Control>& controls() const;
  /// The nails, and in a gesture what is grabbed with its last target.
  std::vector<Constraint> constraints() const;
  std::vector<NailId> nails() const;
  /// Throws InputError for one that is not there.
  const Constraint& constraintOf(NailId id) const;
  const SessionOptions& options() const;

  /// All gestures that came to an end, for saving (formats/documents/journal_json.h) and replay.
  const SessionJournal& journal() const;

 private:
  friend class SessionReplay;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom
