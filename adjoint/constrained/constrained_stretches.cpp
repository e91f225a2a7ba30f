// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_stretches.hpp"

#include <algorithm>

#include "adjoint/constrained/constrained_force_rates.hpp"
#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/constrained/constrained_start_derivative.hpp"
#include "adjoint/constrained/straight_slips.hpp"

namespace carom::adjoint_detail {
namespace {

// Where slips end with the path: its instant there.
using SlipEnds = std::optional<ConstrainedInstant>;

ConstrainedStretch stretchFrom(const ConstrainedPath& path, const SlipEnds& end, const ConstrainedStep& step, double from, double t) {
  const ConstrainedInstant now = path.instantAt(from);
  const ConstrainedDynamics forces(now.body, now.contacts, path.redundant());
  ConstrainedStretch out{&step, from, t, followSlips(path)};
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const PersistentContact& c = path.contacts()[k];
    if (c.mode != ContactMode::slides || !(c.friction > 0)) continue;
    if (step.frozen[k]) {
      out.straight[k] = now.contacts[k].slip;
      continue;
    }
    if (c.begins && !(from > path.start())) continue;
    const Vec3 slip = now.slipAt(k);
    StopOfSlip stop;
    if (end) stop = {end->slipAt(k).norm(), acrossSlip(*end, k).dot(slip)};
    const SlipStretch ahead = slipStretch(slip, forces.slipRate(k), stop, path.scene().speed);
    if (ahead.straight) out.straight[k] = (ahead.stops ? *end : now).contacts[k].slip;
    else if (from + 1.2 * ahead.reach < out.until) out.until = from + ahead.reach;
  }
  return out;
}

}  // namespace

std::vector<ConstrainedStretch> stretchesUntil(const ConstrainedPath& path, double t) {
  SlipEnds end;
  if (path.contactThatStops()) end = path.instantAt(path.ending()->time);
  return stretchesOf<ConstrainedStretch>(path.allSteps(), t, [&](const ConstrainedStep& step, double from, double until) { return stretchFrom(path, end, step, from, until); });
}

Eigen::MatrixXd slopeRates(const ConstrainedPath& path, const ConstrainedInputs& inputs, const State& state, double t,
                           const std::vector<Vec3>& slip) {
  Eigen::MatrixXd G(12, inputs.count);
  ConstrainedRates rates(path.scene(), path.contacts(), inputs, state, t, slip);
  const ConstrainedForceRates of_forces(rates.now(), path.redundant());
  rates.each([&](const ConstrainedLanes& lanes, int first, int count) {
    const ForceLanes forces = of_forces.in(lanes);
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      G.col(first + lane) << ratesOf(lanes.body.v, at), ratesOf(lanes.body.omega, at), ratesOf(forces.acceleration, at),
          ratesOf(forces.moment, at);
    }
  });
  // R = exp(theta) R0 turns with omega: theta' = omega x theta + d(omega)
  G.block<3, 3>(3, 3) += skew(rates.now().body.omega);
  return G;
}

}  // namespace carom::adjoint_detail
