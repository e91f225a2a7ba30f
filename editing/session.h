// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit.h"
#include "editing/session_history.h"
#include "editing/session_journal.h"
#include "editing/session_numbers.h"
#include "editing/session_update.h"

namespace carom {

/// How a nail of a session stands in the motion.
struct NailState {
  NailId id;                ///< which
  bool on = true;           ///< held by gestures, see EditSession::setNailOn
  bool available = true;    ///< the motion has it: gestures leave out a nail whose impact or rest does not come
  bool met = true;          ///< within SessionOptions::tolerance
  double time = 0;          ///< s, where it is now, also of an n-th impact or rest; NaN where the motion lacks it
  double error = 0;         ///< largest error of its numbers, SI; NaN where the motion lacks it
  double scaled_error = 0;  ///< the same, dimensionless
  std::string message;      ///< why it is not met, or not there; empty where it is met
};

/// Where a nail is put at the end of a drag.
enum class NailAt {
  target,        ///< where it was dragged to
  where_it_got,  ///< where the body is, in reach
};

/// When a grab lets more vary.
enum class AlsoVary {
  always,
  where_nothing_moves_it,  ///< no control that there is moves what is held, to first order
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
/// Calls that solve take a stop token, which is asked where work is counted: then the best so far is kept, as where the
/// clock ends one.
///
/// Misuse and bad input throw InputError and leave the session as it was. Not for use from two threads at once: what
/// others may touch meanwhile are the token's source and motions.
class EditSession {
 public:
  /// The scene as written. Keeps `contacts` by reference and uses it for all simulations.
  EditSession(const Scene& scene, ContactSource& contacts, double duration, const SessionOptions& options = {});
  /// With controls and nails that are there from the start; nails need not be met yet.
  EditSession(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
              std::vector<Constraint> nails, const SessionOptions& options = {});
  /// Goes on from the history of a session: nothing is solved again, and all that undo led to is there, to the same
  /// bits. Its options are those of the journal; of a session that measures from its start it is refused.
  EditSession(const SessionHistory& history, ContactSource& contacts);
  ~EditSession();
  EditSession(EditSession&&) noexcept;             ///< the other can only be destroyed or assigned to
  EditSession& operator=(EditSession&&) noexcept;  ///< the same

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
  NailId nail(Constraint constraint, std::stop_token stop = {});
  /// The same from its parts.
  NailId nail(const std::string& body, When at, const Held& held) { return nail(heldConstraint(body, at, held)); }
  /// Holds the body as it is at that moment: place and orientation.
  NailId nailAsItIs(const std::string& body, When at);
  /// Other targets, components or another time for a nail that there is, and solves for them where it is on. One step.
  void setNail(NailId id, Constraint constraint, std::stop_token stop = {});
  /// A nail that is off is kept, but not held. The motion stays. One step for undo.
  void setNailOn(NailId id, bool on);
  /// Switches all nails on and solves for those that the motion has. One step.
  SessionUpdate meetNails(std::stop_token stop = {});
  /// Removes a nail. The motion stays. One step for undo.
  void unnail(NailId id);

  /// Takes hold of a moving body at a time or an impact of the motion, or at rest. From here to `release` is one step
  /// for undo; the controls `also_vary` are there from here on, in the same step, where they are wanted.
  SessionUpdate grab(const std::string& body, When at, const Grip& grip = {}, std::vector<Control> also_vary = {},
                     AlsoVary wanted = AlsoVary::always);
  /// Takes hold of a nail: what is dragged is the place that it holds the body to. It does not hold that meanwhile, but
  /// what it has besides place and orientation. `release` puts it where the body got to, `cancel` back.
  SessionUpdate grabNail(NailId id);
  /// Moves the grabbed point (without Grip::body_point: the shape's origin) to a place in the world, or towards it.
  SessionUpdate dragTo(const Vec3& place, std::stop_token stop = {});
  /// The same with an orientation, shape to world; for grips that hold it.
  SessionUpdate dragTo(const Vec3& place, const Quat& orientation, std::stop_token stop = {});
  /// The hand rests: on towards the same target, with SessionOptions::dwell_simulations and without a clock. `better`
  /// is called with each better motion on the way; it must not call the session.
  SessionUpdate dwell(std::stop_token stop = {}, const std::function<void(const SessionUpdate&)>& better = {});
  /// Lets go: minimises the change, or searches further for the target where it was not reached.
  SessionUpdate release(std::stop_token stop = {});
  /// The same, and the grabbed body stays nailed: to its last target, or where it got to. A grabbed nail is put there.
  SessionUpdate releaseNailed(NailAt at = NailAt::target, std::stop_token stop = {});
  /// Lets go and puts everything back as it was before the grab.
  SessionUpdate cancel();
  bool isGrabbed() const;           ///< between grab and release, or cancel
  Vec3 grabbedPlace() const;        ///< m, where the grabbed point is
  Quat grabbedOrientation() const;  ///< of the grabbed body, shape to world

  /// Puts other content in the place of all there is, under a name for undo: numbers that were typed, bodies that came
  /// or went, another duration. It is simulated, and nothing is solved. Refused whole where it makes no sense. One step.
  void setContent(const SessionContent& content, const std::string& name);
  /// As it is now.
  SessionContent content() const;

  /// Back by one step; within a gesture, cancels it. Nothing happens where there is none.
  SessionUpdate undo();
  /// Forward again by one step that was undone.
  SessionUpdate redo();
  bool canUndo() const;  ///< there is a step back
  std::size_t undoDepth() const;  ///< how many there are, outside of a gesture
  bool canRedo() const;  ///< there is a step that was undone
  std::string undoName() const;  ///< of the step that undo takes back: "drag of 'hat' at 0.6 s"; empty: none
  std::string redoName() const;  ///< of the one that redo brings back

  const Scene& scene() const { return *motion().scene; }    ///< as it is now
  const Motion& motion() const { return *last().motion; }  ///< of that scene
  /// What the last call came to.
  const SessionUpdate& last() const;
  double duration() const;                       ///< s, of the motion
  const std::vector<Control>& controls() const;  ///< what may vary
  std::vector<SessionNumber> numbers() const;    ///< all numbers of the controls, see sessionNumbers
  /// All nails, and in a gesture what is grabbed with its last target.
  std::vector<Constraint> constraints() const;
  std::vector<NailId> nails() const;  ///< those there are, oldest first
  /// Throws InputError for one that is not there. Of a grabbed nail it has the last target.
  const Constraint& constraintOf(NailId id) const;
  std::vector<NailState> nailStates() const;  ///< of all nails, oldest first, in the motion as it is
  const SessionOptions& options() const;  ///< as they were given

  /// All that it takes to go on elsewhere. Not in a gesture.
  SessionHistory history() const;

  /// All gestures that came to an end, for saving (formats/documents/journal_json.h) and replay.
  const SessionJournal& journal() const;

 private:
  friend class SessionReplay;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom
