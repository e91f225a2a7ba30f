// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/constrained/constrained_path.hpp"

namespace carom::adjoint_detail {

// By the rule of the steps, which is exact for what they are made of.
double ConstrainedPath::supportWork(double t) const {
  double work = 0;
  if (!scene_.isDriven()) return work;
  const Gauss& gauss = Gauss::get();
  const Gauss::Row weights = Gauss::integrals(1) * gauss.coefficients;
  ConstrainedForces forces;
  for (const ConstrainedStep& step : steps_) {
    const double length = std::min(step.length, t - step.start);
    if (!(length > 0)) break;
    for (int i = 0; i < Gauss::kNodes; ++i) {
      const ConstrainedInstant now = instantAt(step.start + gauss.node[i] * length);
      forces.solve(now, redundant_);
      double power = 0;
      for (std::size_t k = 0; k < now.contacts.size(); ++k) power += forces.force(k).dot(now.contacts[k].support_velocity);
      work += length * weights[i] * power;
    }
  }
  return work;
}

}  // namespace carom::adjoint_detail
