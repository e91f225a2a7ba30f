// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/event_pass.hpp"
#include "adjoint/second_order/lanes.hpp"

namespace carom::adjoint_detail {

/// One event, linearised, in dual numbers: what EventLinearization holds with the rates of all of it.
class DualEvent {
 public:
  DualEvent(const Lanes& lanes, int event);

  /// As EventLinearization::pullback.
  std::vector<StateBar> pullback(const std::vector<StateBar>& after_bar, const std::vector<StateBar>& read_bar,
                                 const Num& time_bar, SceneBar& scene_bar, std::vector<ModelBar>& model_bar) const;
  const DualState& before(std::size_t participant) const { return before_[participant]; }

 private:
  using Pass = EventPass<Num>;
  using Part = Pass::Part;

  Pass passOf() const;
  // Adds the contact to what the impact sees.
  Part partOf(const Contact& c, double weight, ImpactInputs<Num>& inputs) const;
  PairTangent pairTangent(const Part& part, std::size_t lane) const;
  NVec tiltNormal(const Contact& c, const NVec& normal, Part& part) const;
  PairRules<Num> rulesOf(const Contact& c, const Part& part) const;

  const Lanes& lanes_;
  int index_;
  const Event& event_;
  std::vector<DualState> before_;  // of the participants
  Pass pass_;
};

}  // namespace carom::adjoint_detail
