// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/carrier.hpp"

namespace carom::adjoint_detail {

/// Rest on what moves: the pose of its start in the frame of a carrier (docs/equations.md, 11.33), with its velocities, whatever
/// those of the start are.
class RidePath final : public Trajectory {
 public:
  /// `loose`: contacts do not hold the body against every motion.
  RidePath(Carrier carrier, bool loose) : carrier_(std::move(carrier)), loose_(loose) {}

  ArcKind kind() const override { return ArcKind::ride; }
  State stateAt(const Arc& arc, double t) const override { return carried(arc.model(), arc.startState(), t); }
  Vec3 positionAt(const Arc& arc, double t) const override;
  Vec3 velocityAt(const Arc& arc, double t) const override;
  StateDerivative rateAt(const Arc& arc, double t, const State& state) const override;
  TrajectoryBounds bounds(const Arc& arc) const override;
  std::shared_ptr<const TrajectoryLinearization> linearise(const Motion& motion, int body, int k, double t) const override;
  const RidePath* ride() const override { return this; }
  bool isLoose() const override { return loose_; }

  const Carrier& carrier() const { return carrier_; }
  /// Of a body with this pose at the start of the path, at time t.
  State carried(const BodyModel& model, const State& start, double t) const;

 private:
  Carrier carrier_;
  bool loose_;
};

}  // namespace carom::adjoint_detail
