// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "editing/session.h"
#include "editing/session/session_solver.hpp"

/// What an EditSession keeps. Internal to editing/.
namespace carom::editing_detail {

struct SessionNail {
  NailId id;
  Constraint constraint;
};

/// All that undo brings back. The motion is simulated again, with the same bits.
struct SessionMoment {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Scene> reference;  ///< for MeasureFrom::start
  Eigen::VectorXd changes;                 ///< of the controls, from `reference` to `scene`
  std::vector<Control> controls;
  std::vector<SessionNail> nails;

  std::vector<Constraint> constraints() const;
};

/// A grabbed body on its way.
struct SessionDrag {
  std::unique_ptr<SessionSolver> solver;
  SessionGesture record;
  std::shared_ptr<const Motion> before;
  int body = -1, with = -1;
  int turn_target = -1;  ///< index of the target that holds the orientation
  Vec3 place = Vec3::Zero();
  std::optional<Quat> orientation;
};

/// Why a motion ends before its duration: a sentence; empty for one that does not.
std::string earlyEnd(const Motion& motion);
/// A body at a moment of a motion. Throws InputError naming `where` when the motion does not have it.
BodyState stateAtMoment(const Motion& motion, const std::string& body, const When& at, const std::string& where);

}  // namespace carom::editing_detail

namespace carom {

using namespace editing_detail;

struct EditSession::State {
  State(ContactSource& source, double length, const SessionOptions& chosen);

  ContactSource& contacts;
  double duration;
  SessionOptions options;
  SessionMoment now;
  std::vector<SessionMoment> past, future;
  int next_nail = 0;
  SessionUpdate last;
  SessionJournal journal;
  std::optional<SessionDrag> drag;
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
  /// Set by a replay: no clock, but what it did when this was recorded.
  bool replays = false;
  std::optional<int> replayed_cut;

  double millisecondsSinceStart() const;
  SessionGesture newGesture(SessionGesture::Kind kind) const;  ///< of now
  Budget budget(int limit, double seconds) const;
  void requireNoDrag(const char* call) const;

  // session.cpp
  void begin(const Scene& scene, std::vector<Control> controls, std::vector<Constraint> nails);
  void remember(SessionMoment before);
  /// Ends a gesture: its record goes to the journal with what came of it.
  void record(SessionGesture gesture);
  SessionUpdate goTo(std::vector<SessionMoment>& from, std::vector<SessionMoment>& to, SessionGesture::Kind kind);
  SessionUpdate stay(const std::string& message);

  // session_gesture.cpp
  std::unique_ptr<SessionSolver> solverFor(const std::vector<Constraint>& constraints, int goal) const;
  void grab(const std::string& body, const When& at, const Grip& grip);
  SessionUpdate dragTo(const Vec3& place, const std::optional<Quat>& orientation);
  SessionUpdate endDrag(SessionGesture::Ending ending);
  NailId addNail(Constraint constraint);

  // session_update.cpp
  std::shared_ptr<const Motion> simulated(const std::shared_ptr<const Scene>& scene) const;
  /// The motion of where a solver got to, over the whole duration.
  std::shared_ptr<const Motion> motionOf(const SessionSolver& solver) const;
  void measureNails(SessionUpdate& update) const;
  void measureGoal(const SessionSolver& solver, SessionUpdate& update) const;
  void measureDrag(SessionUpdate& update) const;
  void describe(SessionSolver& solver, SessionUpdate& update) const;
  void takeOver(const SessionSolver& solver, const SessionUpdate& update);
};

}  // namespace carom
