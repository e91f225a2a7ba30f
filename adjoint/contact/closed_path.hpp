// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/flight/trajectory.hpp"

namespace carom::adjoint_detail {

/// Rest, sliding or rolling on one face, in closed form.
class ClosedPath final : public Trajectory {
 public:
  explicit ClosedPath(ContactPath path) : path_(std::move(path)) {}

  ArcKind kind() const override;
  State stateAt(const Arc& arc, double t) const override;
  Vec3 positionAt(const Arc& arc, double t) const override;
  Vec3 velocityAt(const Arc& arc, double t) const override;
  StateDerivative rateAt(const Arc& arc, double t, const State& state) const override;
  TrajectoryBounds bounds(const Arc&) const override { return path_.bounds; }
  void extendTo(const Arc& arc, double t) override;
  double availableUntil(const Arc& arc) const override;
  std::shared_ptr<const TrajectoryLinearization> linearise(const Motion& motion, int body, int k, double t) const override;
  const ContactPath* closedForm() const override { return &path_; }
  bool isLoose() const override { return path_.loose; }

 private:
  ContactPath path_;
};

}  // namespace carom::adjoint_detail
