// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "adjoint/constrained/path_ending.hpp"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/group/group_step.hpp"

namespace carom::adjoint_detail {

/// How bodies move together in lasting contact with each other, at frozen features and in frozen modes (docs/equations.md, 11.34): a slot a
/// member. As many steps as somebody has looked at, up to the first guard that falls to 0.
class GroupPath final : public Trajectory {
 public:
  using Ending = PathEnding;

  /// Which guards may end it; empty: all.
  using Ends = std::function<bool(const ConstrainedGuard&)>;

  /// `until`: nothing later is asked for. Throws NotComputable where not even a first step can be made.
  GroupPath(GroupScene scene, std::vector<GroupContact> contacts, bool redundant, std::vector<State> start, double until, const Ends& ends = {});

  ArcKind kind() const override { return ArcKind::slide; }
  ArcKind kindOf(const Arc& arc) const override { return kinds_[slotOf(arc)]; }
  State stateAt(const Arc& arc, double t) const override { return stateAt(slotOf(arc), t); }
  Vec3 positionAt(const Arc& arc, double t) const override { return stateAt(slotOf(arc), t).x; }
  Vec3 velocityAt(const Arc& arc, double t) const override { return stateAt(slotOf(arc), t).v; }
  StateDerivative rateAt(const Arc& arc, double t, const State& state) const override;
  TrajectoryBounds bounds(const Arc& arc) const override { return bounds_[slotOf(arc)]; }
  void extendTo(const Arc& arc, double t) override;
  double availableUntil(const Arc&) const override { return ended() ? kInfinity : known_; }
  double knownUntil() const override { return known_; }
  bool isIntegrated() const override { return true; }
  std::size_t series() const override { return steps_.size(); }
  TrajectoryEnd end() const override;
  std::shared_ptr<Trajectory> fork() const override { return std::make_shared<GroupPath>(*this); }
  std::shared_ptr<const TrajectoryLinearization> linearise(const Motion&, int, int, double) const override { return nullptr; }
  std::shared_ptr<const SharedLinearization> lineariseShared(const Motion& motion, double t) const override;
  std::shared_ptr<const PathGuard> guardOfEnd(const Motion& motion, const Event& event) const override;
  const GroupPath* group() const override { return this; }

  /// The same path where no other guards may end it.
  std::shared_ptr<GroupPath> endedBy(const Ends& ends) const;

  State stateAt(std::size_t member, double t) const;
  std::vector<State> statesAt(double t) const;
  const GroupScene& scene() const { return scene_; }
  const std::vector<GroupContact>& contacts() const { return contacts_; }
  const std::vector<State>& startStates() const { return start_; }
  /// That a step counts for: forces are solved for all contacts at once.
  std::size_t workOfStep() const { return kConstrainedStep * std::max<std::size_t>(1, contacts_.size() * contacts_.size() / 4); }
  bool redundant() const { return redundant_; }
  double start() const { return start_time_; }
  const PathSteps<GroupStep>& allSteps() const { return steps_; }
  const GroupStep& stepAt(double t) const { return steps_.at(t, known_); }
  /// The contact whose slip comes to 0 as it ends, if one does.
  std::optional<std::size_t> contactThatStops() const;
  /// The group at time t, with the directions of its slips.
  GroupInstant instantAt(double t) const;
  /// d/dt of (x, theta, v, L) of all members there, 12 rows each.
  Eigen::VectorXd ratesAt(double t) const;
  /// Where a guard comes nearest to 0 and turns away from it, up to a time.
  PathNearMiss nearestMiss(double until) const;
  /// Bodies and arcs of a motion that share the path, by slot. Throws NotComputable where one has none any more.
  std::vector<SharedLinearization::Member> membersIn(const Motion& motion) const;
  bool ended() const { return end_ || known_ >= until_; }
  const std::optional<Ending>& ending() const { return end_; }
  /// Where it ends as a contact slips or lifts: the states a little later, and when, in the same modes.
  std::optional<std::pair<std::vector<State>, double>> beyondEnd() const;

 private:
  static std::size_t slotOf(const Arc& arc) { return static_cast<std::size_t>(arc.slot()); }
  void extend();
  GroupStep nextStep();
  std::string jamAt(const GroupStepper::Start& start) const;
  std::vector<Vec3> slipAfter() const;
  double lookAtSlips(GroupStepper::Start& start) const;
  void alignStop(GroupInstant& now) const;
  bool passesBy(const GroupStep& step, const Ending& end) const;
  std::vector<double> valuesAt(const GroupStep& step, double t) const;
  void take(GroupStep step);

  GroupScene scene_;
  std::vector<GroupContact> contacts_;
  bool redundant_;
  std::vector<ConstrainedGuard> guards_;
  std::vector<State> start_, last_;
  double start_time_, until_, known_, next_length_;
  PathSteps<GroupStep> steps_;
  std::optional<Ending> end_;
  std::vector<TrajectoryBounds> bounds_;
  std::vector<ArcKind> kinds_;
};

}  // namespace carom::adjoint_detail
