// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "adjoint/flight/trajectory.hpp"
#include "adjoint/constrained/constrained_guards.hpp"
#include "adjoint/constrained/constrained_step.hpp"
#include "adjoint/constrained/path_ending.hpp"
#include "adjoint/motion/rim_geometry.hpp"

namespace carom::adjoint_detail {

/// The path of a body that contacts hold to bodies which stand still, or move as they are given to, at frozen features and in
/// frozen modes: as many steps as somebody has looked at, up to the first guard that falls to 0.
class ConstrainedPath final : public Trajectory {
 public:
  using Ending = PathEnding;

  /// `until`: nothing later is asked for. `stopped`: see constrainedStart. Throws NotComputable where not even a first step can be made.
  ConstrainedPath(ConstrainedScene scene, std::vector<PersistentContact> contacts, bool redundant, std::vector<ConstrainedGuard> guards,
           const State& start, double time, double until, std::vector<Vec3> stopped = {});

  ArcKind kind() const override;
  State stateAt(const Arc&, double t) const override { return stateAt(t); }
  Vec3 positionAt(const Arc&, double t) const override { return stateAt(t).x; }
  Vec3 velocityAt(const Arc&, double t) const override;
  StateDerivative rateAt(const Arc&, double t, const State&) const override { return rateAt(t); }
  TrajectoryBounds bounds(const Arc&) const override { return bounds_; }
  void extendTo(const Arc& arc, double t) override;
  double availableUntil(const Arc&) const override { return ended() ? kInfinity : known_; }
  double knownUntil() const override { return known_; }
  bool isIntegrated() const override { return true; }
  std::size_t series() const override { return steps_.size(); }
  TrajectoryEnd end() const override;
  std::shared_ptr<Trajectory> fork() const override { return std::make_shared<ConstrainedPath>(*this); }
  std::shared_ptr<const TrajectoryLinearization> linearise(const Motion& motion, int body, int k, double t) const override;
  std::shared_ptr<const PathGuard> guardOfEnd(const Motion& motion, const Event& event) const override;
  std::shared_ptr<const PathStart> mapOfStart(const Motion& motion, int participant) const override;
  const ConstrainedPath* constrained() const override { return this; }

  State stateAt(double t) const;
  StateDerivative rateAt(double t) const;
  /// Nothing of it comes later than what is known.
  bool ended() const { return end_ || known_ >= until_; }

  /// Whether a contact slips on it.
  bool slides() const;

  /// One step more.
  void extend();
  /// Where it goes on otherwise, once that is known.
  const std::optional<Ending>& ending() const { return end_; }

  const ConstrainedScene& scene() const { return scene_; }
  const std::vector<PersistentContact>& contacts() const { return contacts_; }
  const std::vector<ConstrainedGuard>& guards() const { return guards_; }
  bool redundant() const { return redundant_; }
  const ConstrainedSteps& allSteps() const { return steps_; }
  /// It ends where a rim lies flat: the guard is `leaves`, without a limit.
  bool endsFlat() const { return end_ && end_->guard.cause == TransitionCause::leaves && end_->guard.limit < 0; }
  /// It begins where a rim lies flat, and tilts about its lowest point.
  bool beginsFlat() const;
  /// Of two steps that meet at t the one before.
  const ConstrainedStep& stepAt(double t) const { return steps_.at(t, known_); }
  double start() const { return start_; }
  /// The impulses, N s, by which the contacts took away what was left of speeds at its start; empty: none.
  const std::vector<Vec3>& stopped() const { return stopped_; }
  /// Whether what its start took away of speeds is more than rounding.
  bool stopsSpeeds() const;
  /// Where it ends as a contact slips or lifts: the state a little later, and when, in the same modes, in which that contact's force
  /// has clearly left its cone; none where it hardly does.
  std::optional<std::pair<State, double>> beyondEnd() const;
  /// That whose slip ends it.
  std::optional<std::size_t> contactThatStops() const;
  /// The body and its contacts; where a slip is too slow to have a direction of its own, that of the step, and at its end
  /// that of its acceleration.
  ConstrainedInstant instantAt(double t) const;

  /// J: what supports that move do on the body from the start of the path to t, the sum of f.u over their contacts, u the velocity of
  /// their material there.
  double supportWork(double t) const;

  /// The nearest, up to a time, of those that the nodes of steps show.
  PathNearMiss nearestMiss(double until) const;

 private:
  struct Values;
  // A rim that comes to lie flat, about an axis that stays.
  struct FlatAhead {
    std::size_t contact;
    Vec3 axis;          // unit, about which it tilts
    double time;        // s, from the end of what is known
  };
  struct Tilt {
    Vec3 x, rate;       // d x N, and d/dt of it
  };
  void findRims();
  Tilt tiltOf(std::size_t contact, const State& state) const;
  std::optional<FlatAhead> flatAhead(const ConstrainedStepper::Start& start) const;
  std::optional<ConstrainedStep> stepToFlat(ConstrainedStepper& stepper, const ConstrainedStepper::Start& start, const FlatAhead& ahead) const;
  bool passesFlat(const ConstrainedStep& step) const;
  ConstrainedStep nextStep();
  std::vector<Vec3> slipAfter() const;
  void alignStop(ConstrainedInstant& now) const;
  double lookAtSlips(ConstrainedStepper::Start& start) const;
  double shorterLength(double length, double error, const std::optional<Ending>& end) const;
  std::optional<Ending> firstEnd(const ConstrainedStep& step, bool nodes_alone = false) const;
  bool endAt(ConstrainedStepper& stepper, const ConstrainedStepper::Start& start, ConstrainedStep& step, Ending& end) const;
  bool passesBy(const ConstrainedStep& step, const Ending& end) const;
  std::string tooManySteps() const;
  std::string jamAt(const ConstrainedStepper::Start& start) const;
  State stayingOn(const State& state, double t) const;
  void take(ConstrainedStep step);
  bool goesWithSupport(const ConstrainedInstant& now) const;

  ConstrainedScene scene_;
  std::vector<PersistentContact> contacts_;
  bool redundant_;
  std::vector<ConstrainedGuard> guards_;
  std::vector<std::optional<RimOnFace>> rims_;  // of contacts that have one
  State start_state_, last_;
  double start_, until_, known_, next_length_;
  std::vector<Vec3> stopped_;
  ConstrainedSteps steps_;
  std::optional<Ending> end_;
  TrajectoryBounds bounds_;
  bool rolls_ = false, rides_ = false;
};

}  // namespace carom::adjoint_detail
