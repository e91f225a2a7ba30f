// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "editing/session.h"
#include "editing/session/session_solver.hpp"

/// What an EditSession keeps. Internal to editing/.
namespace carom::editing_detail {

struct SessionNail {
  NailId id;
  Constraint constraint;
  bool on = true;
};

/// What the last gesture that solved asked for.
struct AskedFor {
  std::shared_ptr<const Scene> began;  ///< at its start
  std::optional<Constraint> goal = {};  ///< of a drag, at its last target
  NailId nail = {};                    ///< that it left there, or moved
};

/// All that undo brings back. The motion is simulated again, with the same bits.
struct SessionMoment {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Scene> reference;  ///< for MeasureFrom::start
  Eigen::VectorXd changes;                 ///< of the controls, from `reference` to `scene`
  std::vector<Control> controls;
  std::vector<SessionNail> nails;
  double duration = 0;
  std::optional<AskedFor> asked = {};  ///< until another content
  std::string step;  ///< in the lists of undo and redo: what leads from here to where the session was

  std::vector<Constraint> constraints() const;
  /// Other controls, from which changes are measured anew.
  void setControls(std::vector<Control> others);
  SessionNail* find(NailId id);
};

/// A grabbed body, or a grabbed nail, on its way.
struct SessionDrag {
  std::unique_ptr<SessionSolver> solver;
  SessionGesture record;
  SessionMoment began;  ///< brought back by cancel
  std::shared_ptr<const Motion> before;
  int body = -1, with = -1;
  int turn_target = -1;  ///< index of the goal's target that holds the orientation
  Vec3 place = Vec3::Zero();
  std::optional<Quat> orientation;
  Grip held;         ///< that of the record, with the components that are held now
  double sheet = 0;  ///< m, see sheetOf
  std::string left_out;  ///< a sentence about nails that cannot be evaluated
};

/// Nails that gestures hold.
struct ConstrainedNails {
  std::vector<Constraint> constraints;
  std::string left_out;  ///< a sentence about those that cannot be evaluated; empty if none
};

/// A step that solves for nails.
struct NailStep {
  SessionMoment next;  ///< but for the scene, which is solved for
  ConstrainedNails held;
  int goal = -1;  ///< index of the constraint that gives way to the others; -1: none
  std::string name;
  bool changes_nails = true;  ///< it is a step even where the motion stays
};

/// "drag of 'hat' at 0.6 s"
std::string stepName(const SessionDrag& drag);
/// What a grab holds, with its last target.
Constraint goalOf(const SessionDrag& drag);
/// The components of a place that a grip holds. Throws InputError for components that there are not.
std::vector<TargetNumber> constrainedPlace(const Vec3& place, const Grip& grip);
std::vector<TargetNumber> numbersOf(const Quat& q);
/// Puts a nail that was grabbed elsewhere; components that it leaves free stay free.
void putNail(Constraint& nail, const Vec3& place, const std::optional<Quat>& orientation);
/// A body at a moment of a motion. Throws InputError naming `where` when the motion does not have it.
BodyState stateAtMoment(const Motion& motion, const std::string& body, const When& at, const std::string& where);

// session_contact.cpp
/// Where that is in a motion which a gesture holds, m. Throws as stateAtMoment.
Vec3 placeConstrained(const Motion& motion, const SessionGesture& record, const std::string& where);
/// How far that is from the target of a drag, m, in what is held.
Vec3 awayFrom(const SessionDrag& drag, const Vec3& place);
/// m: how much a contact may be off the place at which the hand is in a component that it leaves to the surface. So it
/// is on that side of the body, not on another one with the same two coordinates.
double sheetOf(const Scene& scene, const SessionGesture& record);
/// Whether two components of a place are held, so that the third is on a sheet.
bool isOnSheet(const Grip& grip);
/// What a grip of a contact wants: two components exactly, and the third within the sheet; sheet 0: free.
Target contactTarget(const Vec3& place, const Grip& grip, double sheet);
/// Moves the ranges of a target there; their widths stay.
void recentre(Target& target, const Vec3& place);

double millisecondsSince(std::chrono::steady_clock::time_point start);

}  // namespace carom::editing_detail

namespace carom {

using namespace editing_detail;

struct EditSession::State {
  State(ContactSource& source, const SessionOptions& chosen);

  using Clock = std::chrono::steady_clock;
  using Better = std::function<void(const SessionUpdate&)>;

  ContactSource& contacts;
  SessionOptions options;
  SessionMoment now;  ///< in a drag with what the grab changed
  std::vector<SessionMoment> past, future;
  int next_nail = 0;
  SessionUpdate last;
  SessionJournal journal;
  std::optional<SessionDrag> drag;
  Clock::time_point started = Clock::now();
  /// Set by a replay: no clock, but what ended things when this was recorded.
  bool replays = false;
  std::optional<int> replayed_cut;

  double millisecondsSinceStart() const;
  SessionGesture newGesture(SessionGesture::Kind kind) const;  ///< of now
  Budget budget(int limit, double seconds, std::stop_token stop) const;
  void requireNoDrag(const char* call) const;

  // session.cpp
  void begin(const Scene& scene, double duration, std::vector<Control> controls, std::vector<Constraint> nails);
  void resume(const SessionHistory& history);  // session_resume.cpp

  // session_history.cpp
  /// A step for undo from `before` to now.
  void remember(SessionMoment before, std::string step);
  /// Ends a gesture: its record goes to the journal with what came of it.
  void record(SessionGesture gesture);
  SessionUpdate goTo(std::vector<SessionMoment>& from, std::vector<SessionMoment>& to, SessionGesture::Kind kind);
  /// Without solving: how the motion stands; `shown` is the one of before.
  SessionUpdate stay(const std::string& message, const std::shared_ptr<const Motion>& shown);

  // session_gesture.cpp
  std::unique_ptr<SessionSolver> solverFor(const SessionMoment& moment, const std::vector<Constraint>& constraints,
                                           int goal) const;
  void grab(const std::string& body, const When& at, const Grip& grip, std::vector<Control> also_vary, AlsoVary wanted);
  void grabNail(NailId id);
  /// `solver`: of just that, where there is one.
  void beginDrag(SessionDrag next, SessionMoment moment, std::vector<Constraint> held,
                 std::unique_ptr<SessionSolver> solver = nullptr);
  SessionUpdate dragTo(const Vec3& place, const std::optional<Quat>& orientation, std::stop_token stop);
  void slide(const Vec3& place, const std::vector<std::string>& components);
  SessionUpdate dwell(std::stop_token stop, const Better& better);
  SessionUpdate follow(DragTarget target, Budget budget, const Better& better);

  // session_release.cpp
  SessionUpdate endDrag(SessionGesture::Ending ending, std::stop_token stop);
  SessionUpdate cancelDrag();
  SessionUpdate finishDrag(std::stop_token stop);
  /// The nail that a drag leaves: a new one, or the one that was grabbed.
  void leaveNail(SessionDrag& ended, const SessionUpdate& update);
  Constraint askedBy(const SessionDrag& ended);  // session_snapshot.cpp

  // session_nails.cpp
  /// Throws InputError for one that is not there.
  SessionNail& nailOf(NailId id);
  ConstrainedNails constrainedNails(const std::vector<SessionNail>& nails) const;
  NailState stateOf(const SessionNail& nail, const Motion& motion) const;
  SessionUpdate solveStep(NailStep step, SessionGesture gesture, std::stop_token stop);
  NailId addNail(Constraint constraint, std::stop_token stop);
  void setNail(NailId id, Constraint constraint, std::stop_token stop);
  SessionUpdate meetNails(std::stop_token stop);

  // session_content.cpp
  SessionMoment momentOf(const SessionContent& content, int& next_free_nail);

  // session_update.cpp
  std::shared_ptr<const Motion> simulated(const std::shared_ptr<const Scene>& scene, double duration) const;
  /// The motion of where a solver got to, over the whole duration.
  std::shared_ptr<const Motion> motionOf(const SessionSolver& solver) const;
  void measureNails(SessionUpdate& update) const;
  void measureGoal(const SessionSolver& solver, SessionUpdate& update) const;
  void measureDrag(SessionUpdate& update) const;
  /// How the impacts that count for a gesture changed since it began.
  void compareImpacts(const SessionSolver& solver, const Motion& before, SessionUpdate& update) const;
  void putEnd(const Budget& budget, SessionUpdate& update) const;
  void describe(SessionSolver& solver, const Motion& before, const std::string& left_out, SessionUpdate& update) const;
  void takeOver(const SessionSolver& solver, const SessionUpdate& update);
};

}  // namespace carom
