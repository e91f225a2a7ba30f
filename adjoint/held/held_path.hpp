// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/contact/integrated_path.hpp"
#include "adjoint/held/held_guards.hpp"
#include "adjoint/held/held_step.hpp"
#include "adjoint/motion/rim_geometry.hpp"

namespace carom::adjoint_detail {

/// The path of a body that contacts hold to bodies which stand still, at frozen features and in frozen modes: as many
/// steps as somebody has looked at, up to the first guard that falls to 0.
class HeldPath final : public IntegratedPath {
 public:
  struct End {
    double time = kInfinity;
    HeldGuard guard;
  };

  /// `until`: nothing later is asked for. `stopped`: see heldStart. Throws NotComputable where not even a first step can be made.
  HeldPath(HeldScene scene, std::vector<HeldContact> contacts, bool redundant, std::vector<HeldGuard> guards,
           const State& start, double time, double until, std::vector<Vec3> stopped = {});

  std::unique_ptr<IntegratedPath> clone() const override { return std::make_unique<HeldPath>(*this); }
  void useModel(const BodyModel& model) override { scene_.model = &model; }
  void extendTo(double t) override;
  double knownUntil() const override { return known_; }
  bool ended() const override { return end_ || known_ >= until_; }
  std::size_t steps() const override { return steps_.size(); }

  State stateAt(double t) const override;
  Vec3 positionAt(double t) const override { return stateAt(t).x; }
  Vec3 velocityAt(double t) const override;
  StateDerivative rateAt(double t) const override;
  PathBounds bounds() const override { return bounds_; }
  bool slides() const override;
  bool rolls() const override { return rolls_; }

  /// One step more.
  void extend();
  /// Where it goes on otherwise, once that is known.
  const std::optional<End>& end() const { return end_; }

  const HeldScene& scene() const { return scene_; }
  const std::vector<HeldContact>& contacts() const { return contacts_; }
  const std::vector<HeldGuard>& guards() const { return guards_; }
  bool redundant() const { return redundant_; }
  const HeldSteps& allSteps() const { return steps_; }
  /// It ends where a rim lies flat: the guard is `leaves`, without a limit.
  bool endsFlat() const { return end_ && end_->guard.cause == TransitionCause::leaves && end_->guard.limit < 0; }
  /// It begins where a rim lies flat, and tilts about its lowest point.
  bool beginsFlat() const;
  /// Of two steps that meet at t the one before.
  const HeldStep& stepAt(double t) const;
  double start() const { return start_; }
  /// The impulses, N s, by which the contacts took away what was left of speeds at its start; empty: none.
  const std::vector<Vec3>& stopped() const { return stopped_; }
  /// Whether what its start took away of speeds is more than rounding.
  bool stopsSpeeds() const;
  /// That whose slip ends it.
  std::optional<std::size_t> contactThatStops() const;
  /// The body and its contacts; where a slip is too slow to have a direction of its own, that of the step, and at its end
  /// that of its acceleration.
  HeldInstant instantAt(double t) const;

  /// Where a guard comes nearest to 0 and turns away from it: a little change lets it end the path there.
  struct NearMiss {
    double margin = kInfinity;  ///< the value of the guard
    double time = 0;
    HeldGuard guard;
  };
  /// The nearest, up to a time, of those that the nodes of steps show.
  NearMiss nearestMiss(double until) const;

 private:
  struct Values;
  struct Bracket {
    double above, below;  ///< times, between which a guard falls through 0
    double high, low;     ///< its values there
  };
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
  std::optional<FlatAhead> flatAhead(const HeldStepper::Start& start) const;
  std::optional<HeldStep> stepToFlat(HeldStepper& stepper, const HeldStepper::Start& start, const FlatAhead& ahead) const;
  bool passesFlat(const HeldStep& step) const;
  HeldStep nextStep();
  std::vector<Vec3> slipAfter() const;
  void alignStop(HeldInstant& now) const;
  double lookAtSlips(HeldStepper::Start& start) const;
  double shorterLength(double length, double error, const std::optional<End>& end) const;
  std::optional<End> firstEnd(const HeldStep& step, bool nodes_alone = false) const;
  double rootOf(Values& values, std::size_t guard, Bracket in) const;
  bool endAt(HeldStepper& stepper, const HeldStepper::Start& start, HeldStep& step, End& end) const;
  double guardAt(std::size_t guard, double t) const;
  double leastOf(std::size_t guard, double from, double to) const;
  bool passesBy(const HeldStep& step, const End& end) const;
  std::string tooManySteps() const;
  std::string jamAt(const HeldStepper::Start& start) const;
  State stayingOn(const State& state) const;
  void take(HeldStep step);

  HeldScene scene_;
  std::vector<HeldContact> contacts_;
  bool redundant_;
  std::vector<HeldGuard> guards_;
  std::vector<std::optional<RimOnFace>> rims_;  // of contacts that have one
  State start_state_, last_;
  double start_, until_, known_, next_length_;
  std::vector<Vec3> stopped_;
  HeldSteps steps_;
  std::optional<End> end_;
  PathBounds bounds_;
  bool rolls_ = false;
};

}  // namespace carom::adjoint_detail
