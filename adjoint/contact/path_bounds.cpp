// SPDX-License-Identifier: MIT
#include "adjoint/contact/contact_path.hpp"

namespace carom::adjoint_detail {
namespace {

// Above what rounding makes of a bound.
constexpr double kMore = 1 + 1e-12;

TrajectoryBounds boundsOf(const RestPath<double>&, double, double) { return {}; }

// The angular velocity goes along a line: its longest is at an end.
TrajectoryBounds boundsOf(const RollPath<double>& path, double from, double until) {
  return {path.acceleration(), 0, true, kMore * std::max(path.spinAt(from).norm(), path.spinAt(until).norm()),
          kMore * path.spinRate().norm()};
}

// The slip turns one way, and by less than half a turn: it is farthest from where it was at the end.
TrajectoryBounds boundsOf(const GlidePath<double>& path, double from, double until) {
  const Vec3 first = path.directionAt(from);
  TrajectoryBounds bounds;
  bounds.acceleration = path.acceleration(first);
  bounds.straight = path.slip().straight();
  if (!bounds.straight)
    bounds.variation = kMore * (path.acceleration(path.directionAt(until)) - bounds.acceleration).norm();
  bounds.spin_rate = kMore * path.lever().norm() * path.slip().friction();
  bounds.spin = bounds.straight ? kMore * std::max(path.spinAt(from).norm(), path.spinAt(until).norm())
                                : kMore * (path.spinAt(from).norm() + bounds.spin_rate * (until - from));
  return bounds;
}

}  // namespace

TrajectoryBounds pathBounds(PathForm form, const PathInputs<double>& in, double from, double until) {
  return withPath<double>(form, in, [&](const auto& path) { return boundsOf(path, from, until); });
}

State ContactPath::stateAt(const State& start_state, double t, bool turning) const {
  const double elapsed = elapsedAt(t);
  if (form == PathForm::rest || elapsed == 0) return start_state;
  const PathState<double> now =
      elapsed == slip_end ? pathStateAtSlipEnd(form, inputs, turning) : pathStateAt(form, inputs, elapsed, turning);
  const bool turns = turning && form != PathForm::glide_block;
  return {now.x, turns ? Quat(now.R).normalized() : start_state.q, now.v, now.L};
}

double ContactPath::followedUntil(double series) const {
  // The shortest are 1.2/(|w| + sqrt|w'|). At a constant spin there are none.
  if (bounds.spin_rate == 0) return std::numeric_limits<double>::infinity();
  return start + 1.2 * series / (bounds.spin + std::sqrt(bounds.spin_rate));
}

}  // namespace carom::adjoint_detail
