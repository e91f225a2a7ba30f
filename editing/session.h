// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit.h"
#include "editing/session_history.h"
#include "editing/session_journal.h"
#include "editing/session_numbers.h"
#include "editing/session_snapshot.h"
#include "editing/session_update.h"

namespace carom {

/// State of a nail of a session in the current motion.
struct NailState {
  NailId id;                ///< which
  bool on = true;           ///< enforced by gestures, see EditSession::setNailOn
  bool soft = false;        ///< gives way to the others, and to the goal of a gesture: Constraint::soft
  bool available = true;    ///< can be evaluated; gestures ignore a nail whose impact or rest does not happen
  bool met = true;          ///< within SessionOptions::tolerance
  double time = 0;          ///< s, its current time, also of an n-th impact or rest; NaN if not available
  double error = 0;         ///< largest error of its rows, SI; NaN if not available
  double scaled_error = 0;  ///< the same, dimensionless
  std::string message;      ///< why it is not met, or not available; empty if met
};

/// State of a constraint in a motion, as of a nail that is on. `duration` is that of the simulation [s], `tolerance` as
/// SessionOptions::tolerance. Throws InputError for a constraint that is invalid for the scene.
NailState nailStateIn(const Motion& motion, const Constraint& constraint, double duration, double tolerance);
/// A duration is in seconds, no bool and no character.
template <NoTime T>
NailState nailStateIn(const Motion& motion, const Constraint& constraint, T duration, double tolerance) = delete;

/// Target of the nail left by a drag.
enum class NailAt {
  target,        ///< where it was dragged to
  where_it_got,  ///< where the body is
};

/// When a grab adds controls.
enum class AlsoVary {
  always,
  where_nothing_moves_it,  ///< if no existing control moves what is held, to first order
};

/// Direct manipulation of a motion: a body is grabbed at some moment of its motion and dragged, and the controls
/// follow, many times a second.
///
///   EditSession session(scene, contacts, 2.0);
///   session.vary(velocity("hat"), angularVelocity("hat"));
///   session.nail("hat", 0.4, {.position = {{0.8, 0, 1.7}}});
///   session.grab("hat", 1.4);
///   SessionUpdate u = session.dragTo({1.9, 0, 1.5});   // for each move of the mouse
///   session.release();                                 // one step for undo
///
/// A drag minimises the change of the controls from its start (1/2 sum (w_i z_i)^2 as in Edit), subject to the nails
/// and to the target of the grabbed body, or, if that is out of reach, the smallest distance from it. See
/// docs/session.md. The same calls give the same bits, on any machine with the same arithmetic, as long as no update
/// times out; the journal records time-outs, so that its replay is the same in any case.
///
/// Calls that solve take a stop token, which is polled where work is counted: then the best result so far is kept, as
/// after a time-out.
///
/// Misuse and invalid input throw InputError and leave the session unchanged. Not thread-safe: during a call other
/// threads may only use the stop source and motions.
class EditSession {
 public:
  /// The scene as written. Keeps `contacts` by reference and uses it for all simulations.
  EditSession(const Scene& scene, ContactSource& contacts, double duration, const SessionOptions& options = {});
  /// With initial controls and nails; nails need not be met yet.
  EditSession(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
              std::vector<Constraint> nails, const SessionOptions& options = {});
  /// A duration is in seconds, no bool and no character.
  template <NoTime T>
  EditSession(const Scene& scene, ContactSource& contacts, T duration, const SessionOptions& options = {}) = delete;
  /// The same.
  template <NoTime T>
  EditSession(const Scene& scene, ContactSource& contacts, T duration, std::vector<Control> controls,
              std::vector<Constraint> nails, const SessionOptions& options = {}) = delete;
  /// Resumes a session from its history: nothing is solved again, and all undo steps are there, to the same bits. The
  /// options are those of the journal; a session with MeasureFrom::start cannot be resumed.
  EditSession(const SessionHistory& history, ContactSource& contacts);
  ~EditSession();
  EditSession(EditSession&&) noexcept;             ///< the other can only be destroyed or assigned to
  EditSession& operator=(EditSession&&) noexcept;  ///< the same

  /// Adds controls. One undo step, as is setControls.
  template <class... Controls>
  void vary(Controls... more) {
    std::vector<Control> all = controls();
    (all.push_back(std::move(more)), ...);
    setControls(std::move(all));
  }
  /// Replaces all controls.
  void setControls(std::vector<Control> controls);

  /// Adds a nail, enforced until it is removed, and solves for it; last() has the outcome. One undo step. A nail that
  /// cannot be met stays, and is met as soon as possible.
  NailId nail(Constraint constraint, std::stop_token stop = {});
  /// The same from its parts.
  NailId nail(const std::string& body, When at, const NailTargets& targets) {
    return nail(nailConstraint(body, at, targets));
  }
  /// Nails the body as it is at that moment: position and orientation.
  NailId nailAsItIs(const std::string& body, When at);
  /// Changes targets, components or time of a nail, and solves for them if it is on. One undo step.
  void setNail(NailId id, Constraint constraint, std::stop_token stop = {});
  /// A nail that is off is kept, but not enforced. The motion does not change. One undo step.
  void setNailOn(NailId id, bool on);
  /// Switches all nails on and solves for those that are available. One undo step.
  SessionUpdate meetNails(std::stop_token stop = {});
  /// Removes a nail. The motion does not change. One undo step.
  void unnail(NailId id);

  /// Grabs a moving body at a time or an impact of the motion, or at rest. Everything up to `release` is one undo
  /// step; the controls `also_vary` are added in the same step, subject to their condition.
  SessionUpdate grab(const std::string& body, When at, const Grip& grip = {}, std::vector<Control> also_vary = {},
                     AlsoVary wanted = AlsoVary::always);
  /// Grabs a nail: its target position is dragged. It does not enforce that meanwhile, but its targets other than
  /// position and orientation. `release` leaves the target where the body got to, `cancel` restores it.
  SessionUpdate grabNail(NailId id);
  /// Moves the grabbed point (default: the shape's origin, see Grip::body_point) to a position in the world, or
  /// towards it.
  SessionUpdate dragTo(const Vec3& place, std::stop_token stop = {});
  /// The same with an orientation, shape to world; for grips that hold it.
  SessionUpdate dragTo(const Vec3& place, const Quat& orientation, std::stop_token stop = {});
  /// For grips of a contact (Grip::contact), over a surface: `components`, two of "x", "y", "z", are held from here on.
  /// Where the contact is along the third, across the surface, that tells: on the side at which the place is.
  SessionUpdate slideTo(const Vec3& place, const std::vector<std::string>& components, std::stop_token stop = {});
  /// Continues towards the same target, with SessionOptions::dwell_simulations and without a time limit. `better` is
  /// called with each better motion; it must not call the session.
  SessionUpdate dwell(std::stop_token stop = {}, const std::function<void(const SessionUpdate&)>& better = {});
  /// Ends the drag: minimises the change, or searches further for the target if it was not reached.
  SessionUpdate release(std::stop_token stop = {});
  /// The same, and leaves a nail: at the last target, or where the body got to. A grabbed nail is moved there.
  SessionUpdate releaseNailed(NailAt at = NailAt::target, std::stop_token stop = {});
  /// Ends the drag and restores the state before the grab.
  SessionUpdate cancel();
  bool isGrabbed() const;           ///< between grab and release, or cancel
  Vec3 grabbedPlace() const;        ///< m, position of the grabbed point
  Quat grabbedOrientation() const;  ///< of the grabbed body, shape to world

  /// From here on no gesture changes the impact sequence (SequencePolicy::stay), or any may if its target is not reached
  /// otherwise (prefer_start). Kept in the journal; no undo step.
  void keepSequence(bool keep);

  /// Replaces the whole content, under a name for undo: typed numbers, added or removed bodies, another duration.
  /// Simulates it and solves nothing. Rejected as a whole if invalid. One undo step.
  void setContent(const SessionContent& content, const std::string& name);
  /// The current content.
  SessionContent content() const;

  /// Undoes one step; within a gesture, cancels it. Does nothing if there is none.
  SessionUpdate undo();
  /// Redoes one step.
  SessionUpdate redo();
  bool canUndo() const;  ///< there is a step to undo
  std::size_t undoDepth() const;  ///< number of steps, outside of a gesture
  bool canRedo() const;  ///< there is a step to redo
  std::string undoName() const;  ///< of the step to undo: "drag of 'hat' at 0.6 s"; empty: none
  std::string redoName() const;  ///< of the step to redo

  const Scene& scene() const { return *motion().scene; }    ///< the current scene
  const Motion& motion() const { return *last().motion; }  ///< of that scene
  /// Outcome of the last call.
  const SessionUpdate& last() const;
  double duration() const;                       ///< s, of the motion
  const std::vector<Control>& controls() const;  ///< parameters that may vary
  std::vector<SessionNumber> numbers() const;    ///< all control parameters, see sessionNumbers
  /// All nails, and in a gesture the grab with its last target.
  std::vector<Constraint> constraints() const;
  std::vector<NailId> nails() const;  ///< all nails, oldest first
  /// Throws InputError for an unknown nail. A grabbed nail has its last target.
  const Constraint& constraintOf(NailId id) const;
  std::vector<NailState> nailStates() const;  ///< of all nails, oldest first, in the current motion
  const SessionOptions& options() const;  ///< as they were given, but for `sequence`, see keepSequence

  /// What the last gesture asked for and where it got to, see whyNot and alternativesTo. Not in a gesture.
  SessionSnapshot snapshot() const;
  /// The complete state, to resume the session later. Not in a gesture.
  SessionHistory history() const;

  /// All completed gestures, for saving (formats/documents/journal_json.h) and replay.
  const SessionJournal& journal() const;

 private:
  friend class SessionReplay;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom
