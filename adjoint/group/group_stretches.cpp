// SPDX-License-Identifier: MIT
#include "adjoint/group/group_stretches.hpp"

#include <algorithm>

#include "adjoint/constrained/straight_slips.hpp"
#include "adjoint/group/group_force_rates.hpp"
#include "adjoint/group/group_start_derivative.hpp"

namespace carom::adjoint_detail {
namespace {

// Where slips end with the path: its instant there.
using SlipEnds = std::optional<GroupInstant>;

GroupStretch stretchFrom(const GroupPath& path, const SlipEnds& end, const GroupStep& step, double from, double t) {
  const GroupInstant now = path.instantAt(from);
  GroupForces forces;
  forces.solve(path.contacts(), now, path.redundant());
  GroupStretch out{&step, from, t, followSlips(path)};
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const GroupContact& c = path.contacts()[k];
    if (!c.turns()) continue;
    if (step.frozen[k]) {
      out.straight[k] = now.contacts[k].slip;
      continue;
    }
    if (c.begins && !(from > path.start())) continue;
    const Vec3 slip = now.contacts[k].slipVelocity();
    StopOfSlip stop;
    if (end) stop = {end->contacts[k].slipVelocity().norm(), acrossSlip(*end, k).dot(slip)};
    const SlipStretch ahead = slipStretch(slip, forces.slipRate(k), stop, path.scene().speed);
    if (ahead.straight) out.straight[k] = (ahead.stops ? *end : now).contacts[k].slip;
    else if (from + 1.2 * ahead.reach < out.until) out.until = from + ahead.reach;
  }
  return out;
}

}  // namespace

std::vector<GroupStretch> stretchesUntil(const GroupPath& path, double t) {
  SlipEnds end;
  if (path.contactThatStops()) end = path.instantAt(path.ending()->time);
  return stretchesOf<GroupStretch>(path.allSteps(), t, [&](const GroupStep& step, double from, double until) { return stretchFrom(path, end, step, from, until); });
}

Eigen::MatrixXd slopeRates(const GroupPath& path, const GroupInputs& inputs, const std::vector<State>& states, double t, const std::vector<Vec3>& slip) {
  Eigen::MatrixXd G(inputs.states(), inputs.count);
  GroupRates rates(path.scene(), path.contacts(), inputs, states, t, slip);
  const GroupForceRates of_forces(path.contacts(), rates.now(), path.redundant());
  rates.each([&](const GroupLanes& lanes, int first, int count) {
    const GroupForceLanes forces = of_forces.in(lanes);
    for (std::size_t m = 0; m < states.size(); ++m)
      for (int lane = 0; lane < count; ++lane) {
        const auto at = static_cast<std::size_t>(lane);
        G.block<12, 1>(12 * rowAt(m), first + lane) << ratesOf(lanes.members[m].v, at), ratesOf(lanes.members[m].w, at),
            ratesOf(forces.acceleration[m], at), ratesOf(forces.moment[m], at);
      }
  });
  // R = exp(theta) R0 turns with w: theta' = w x theta + d(w)
  for (std::size_t m = 0; m < states.size(); ++m) G.block<3, 3>(12 * rowAt(m) + 3, 12 * rowAt(m) + 3) += skew(rates.now().members[m].w);
  return G;
}

}  // namespace carom::adjoint_detail
