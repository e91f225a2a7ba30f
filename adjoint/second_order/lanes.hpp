// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/influence.hpp"
#include "adjoint/derivative/tangent.h"
#include "adjoint/motion/pair_rules.hpp"
#include "adjoint/second_order/dual_state.hpp"
#include "adjoint/second_order/reading_direction.h"

namespace carom::adjoint_detail {

/// A motion with its tangents along up to kLanes directions: states as dual numbers.
class Lanes {
 public:
  Lanes(DerivativeTape& tape, std::span<const ReadingDirection> directions);

  std::size_t size() const { return directions_.size(); }
  DerivativeTape& tape() const { return tape_; }
  const Motion& motion() const { return tape_.motion(); }
  const ReadingDirection& direction(std::size_t lane) const { return directions_[lane]; }
  const MotionTangent& tangent(std::size_t lane) const { return tangents_[lane]; }
  /// What any of the directions influences.
  const Influence& influence() const { return influence_; }
  const DualModel& model(int body) const { return models_[static_cast<std::size_t>(body)]; }
  std::vector<const BodyDerivative*> ofBody(std::size_t body) const;

  /// How fast the time of a seed that is read at a given time moves.
  double timeRate(std::size_t lane, std::size_t seed) const {
    const Eigen::VectorXd& time = directions_[lane].time;
    return time.size() > 0 ? time[static_cast<Eigen::Index>(seed)] : 0;
  }
  Num eventTime(int event) const;
  /// When arc k of a body starts.
  Num startTime(int body, int k) const;
  /// Just after the event that starts arc k; the time of the event has moved along.
  DualState startOf(int body, int k) const;
  /// State of a body on arc k at time t, which moves along; `now` is its value, `S` the sensitivity up to then.
  DualState stateAt(int body, int k, const Num& t, const State& now, const ArcSensitivity& S) const;
  /// d(state)/dt of the flow on arc k at time t, which moves along.
  StateBar rate(int body, int k, const Num& t, const DualState& state) const;
  const NVec& gravity() const { return gravity_; }
  /// Coefficients of the materials of two bodies.
  PairRules<Num> rules(int a, int b) const;

 private:
  const Arc& arc(int body, int k) const {
    return motion().world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(k)];
  }

  DerivativeTape& tape_;
  std::span<const ReadingDirection> directions_;
  Influence influence_;
  std::vector<MotionTangent> tangents_;
  std::vector<DualModel> models_;
  NVec gravity_;
};

}  // namespace carom::adjoint_detail
