// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_forces.hpp"
#include "adjoint/constrained/constrained_path.hpp"

namespace carom::adjoint_detail {

/// The values of all guards at times of one step.
struct ConstrainedPath::Values {
  const ConstrainedPath& path;
  const ConstrainedStep& step;
  ConstrainedInstant now;
  ConstrainedForces forces;
  std::vector<Vec3> slip;
  std::vector<double> values;

  Values(const ConstrainedPath& of, const ConstrainedStep& in) : path(of), step(in), values(of.guards_.size()) {}

  const std::vector<double>& at(double t) {
    step.placeSlips(t, slip);
    return withSlips(t);
  }

  const std::vector<double>& atStart() {
    step.placeSlips(step.start, slip);
    for (std::size_t k = 0; k < slip.size() && path.steps_.empty(); ++k)
      if (const Vec3& first = path.contacts_[k].slip; !first.isZero(0)) slip[k] = first;
    return withSlips(step.start);
  }

 private:
  const std::vector<double>& withSlips(double t) {
    const State s = step.stateAt(t);
    const Mat3 R = s.q.toRotationMatrix();
    placeInstant(path.scene_, path.contacts_, s, R, t, now);
    for (std::size_t k = 0; k < slip.size(); ++k) {
      ContactInstant<double>& c = now.contacts[k];
      c.slip = slip[k];
      if (c.mode == ContactMode::slides && c.friction > 0) c.slip = inPlane(c.slip, c.n);
    }
    forces.solve(now, path.redundant_);
    forces.share();
    const Pose own{s.x, path.scene_.model->shapeToWorld(R)};
    for (std::size_t g = 0; g < values.size(); ++g)
      values[g] = guardValue(path.guards_[g], path.scene_, path.contacts_, own, t, now, forces);
    return values;
  }
};

}  // namespace carom::adjoint_detail
