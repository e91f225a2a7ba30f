// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_stretches.hpp"

#include <algorithm>

#include "adjoint/constrained/constrained_force_rates.hpp"
#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/constrained/constrained_start_derivative.hpp"

namespace carom::adjoint_detail {
namespace {

// Stretches end where a slip has changed by so much of itself. Slower than kNoSlip of the unit of speed it is
// straight, if its acceleration has no more than kStillTurns of itself across it, and slower than kNoDirectionLeft in any case.
constexpr double kReachOfStretch = 0.7, kNoSlip = 1e-8, kStillTurns = 1e-6;

// Of what a slip has left at its end, which is rounding: what is no larger across its way there is rounding, too.
constexpr double kLeftAcross = 4;

// Where slips end with the path: its instant there.
using SlipEnds = std::optional<ConstrainedInstant>;

// Whether a slip that comes to its end goes straight to it, as far as rounding lets anybody tell.
bool goesStraightTo(const ConstrainedInstant& end, std::size_t k, const ConstrainedInstant& now) {
  const double left = end.slipAt(k).norm(), across = std::abs(acrossSlip(end, k).dot(now.slipAt(k)));
  return left < kLeftAcross * now.slipAt(k).norm() && across <= kLeftAcross * left;
}

ConstrainedStretch stretchFrom(const ConstrainedPath& path, const SlipEnds& end, const ConstrainedStep& step, double from, double t) {
  const ConstrainedInstant now = path.instantAt(from);
  const ConstrainedDynamics forces(now.body, now.contacts, path.redundant());
  ConstrainedStretch out{&step, from, t, followSlips(path)};
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const PersistentContact& c = path.contacts()[k];
    if (c.mode != ContactMode::slides || !(c.friction > 0)) continue;
    const double slip = now.slipAt(k).norm();
    if (step.frozen[k]) {
      out.straight[k] = now.contacts[k].slip;
      continue;
    }
    if (c.begins && !(from > path.start())) continue;
    const Vec3 rate = forces.slipRate(k);
    const bool stops = end && end->slipAt(k).norm() <= kNoDirectionLeft * path.scene().speed;
    const bool turns = rate.cross(now.slipAt(k)).norm() > kStillTurns * rate.norm() * slip && !(stops && goesStraightTo(*end, k, now));
    if (!(slip > (turns ? kNoDirectionLeft : kNoSlip) * path.scene().speed)) {
      out.straight[k] = (stops ? *end : now).contacts[k].slip;
    } else {
      const double reach = kReachOfStretch * slip / rate.norm();
      if (from + 1.2 * reach < out.until) out.until = from + reach;
    }
  }
  return out;
}

}  // namespace

std::vector<ConstrainedStretch> stretchesUntil(const ConstrainedPath& path, double t) {
  SlipEnds end;
  if (path.contactThatStops()) end = path.instantAt(path.ending()->time);
  std::vector<ConstrainedStretch> out;
  for (const ConstrainedStep& step : path.allSteps()) {
    if (!(step.length > 0) || !(step.start < t)) break;
    const bool last = &step == &path.allSteps().back();
    const double until = last ? t : std::min(t, step.start + step.length);
    for (double from = step.start; from < until; from = out.back().until)
      out.push_back(stretchFrom(path, end, step, from, until));
  }
  return out;
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
