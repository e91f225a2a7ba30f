// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_guards.hpp"
#include "adjoint/constrained/path_limits.hpp"
#include "adjoint/numeric/illinois.hpp"

/// Where a path in contact ends, of one body or of a group: roots of its guards. `value_at(t)` gives the values of all guards at
/// a time of a step.
namespace carom::adjoint_detail {

struct PathEnding {
  double time = kInfinity;
  ConstrainedGuard guard;
};

/// Times between which a guard falls through 0, and its values there.
struct GuardBracket {
  double above, below;
  IllinoisEnds value;
};

inline std::size_t indexOf(const std::vector<ConstrainedGuard>& guards, const ConstrainedGuard& guard) {
  return static_cast<std::size_t>(std::ranges::find_if(guards, [&](const ConstrainedGuard& g) { return g.isSame(guard); }) - guards.begin());
}

template <class Values>
double rootOf(const Values& value_at, std::size_t guard, GuardBracket in) {
  const double length = in.below - in.above;
  for (int k = 0; k < 100 && std::nextafter(in.above, in.below) < in.below && in.value.b < 0; ++k) {
    // the chord, with halving where it does not help
    double t = k % 8 == 7 ? 0.5 * (in.above + in.below)
                          : in.above + (in.below - in.above) * (in.value.a / (in.value.a - in.value.b));
    t = std::clamp(t, std::nextafter(in.above, in.below), std::nextafter(in.below, in.above));
    const double now = value_at(t)[guard];
    if (now > 0) {
      in.above = t, in.value.moveA(now);
    } else {
      in.below = t, in.value.moveB(now);
    }
    if (in.below - in.above <= 4e-16 * std::max(std::abs(in.below), length) || now == 0) break;
  }
  return in.below;
}

/// The first guard that falls through 0, looked for at the nodes of a step and at both ends, or at the nodes alone and the start;
/// `last`: the values there. `size`: that of positions.
template <class Values>
std::optional<PathEnding> firstEnd(const std::vector<ConstrainedGuard>& guards, double start, double length, double size, std::vector<double> last,
                                   const Values& value_at, bool nodes_alone = false) {
  const Gauss& gauss = Gauss::get();
  double before = start;
  for (int i = 0; i <= Gauss::kNodes - (nodes_alone ? 1 : 0); ++i) {
    const double t = start + (i < Gauss::kNodes ? gauss.node[i] : 1) * length;
    const std::vector<double> now = value_at(t);
    std::optional<PathEnding> first;
    for (std::size_t g = 0; g < guards.size(); ++g) {
      if (!(now[g] < -guardRounding(guards[g], size)) || !(now[g] < last[g])) continue;
      const double root = last[g] <= 0 ? before : rootOf(value_at, g, {before, t, {last[g], now[g]}});
      // what comes at one instant comes in the order of the guards, whatever the rounding
      if (!first || root < first->time - PathLimits::kAtOnce * std::abs(root)) first = PathEnding{root, guards[g]};
    }
    if (first) return first;
    before = t, last = now;
  }
  return std::nullopt;
}

/// The state of an event is that at the end of a step: the step from `start` is made anew up to the root of a guard, which is found
/// once more there. `value_at(step, t)`: of that guard, of which `rounding` is rounding. False: there is no such step.
template <class Stepper, class Step, class Value>
bool endAt(Stepper& stepper, const typename Stepper::Start& start, Step& step, PathEnding& end, double rounding, const Value& value_at) {
  for (int round = 0; round < PathLimits::kEndings; ++round) {
    const double shorter = end.time - start.time;
    if (shorter == step.length) return true;
    std::optional<Step> ending = stepper.tried(start, shorter, &step);
    if (!ending) return false;
    step = std::move(*ending);
    const double h = step.length, value = value_at(step, start.time + h), earlier = value_at(step, start.time + 0.999 * h);
    const double move = -value * (0.001 * h) / (value - earlier);
    if (std::abs(move) <= std::max(PathLimits::kSameEnd * h, 1e-16 * start.time)) return true;
    const bool is_rounding = std::abs(value) <= rounding;  // of a guard that hardly moves
    if (is_rounding && (round > 0 || !(value < earlier))) return true;
    if (!(std::abs(move) <= 0.5 * h)) return false;
    end.time += move;
  }
  return false;
}

/// A step beyond an end, as short as shows that a guard, `value_at(step, t)`, has clearly fallen below 0; none where it hardly does.
/// `unit`: of time.
template <class Step, class Stepper, class Value>
std::optional<Step> stepBeyond(Stepper& stepper, const typename Stepper::Start& start, double unit, const Value& value_at) {
  for (const double share : PathLimits::kFurther) {
    std::optional<Step> step = stepper.tried(start, share * unit, nullptr);
    if (!step || value_at(*step, step->start + step->length) < -PathLimits::kClearlyBeyond) return step;
  }
  return std::nullopt;
}

/// Where a guard comes nearest to 0 and turns away from it: a little change lets it end the path there.
struct PathNearMiss {
  double margin = kInfinity;  ///< the value of the guard
  double time = 0;
  ConstrainedGuard guard;
};

/// The nearest, up to a time, of those that the nodes of steps show. `steps.at(t, known)` gives a step; `value_at(step, t)` the values of all
/// guards; `unit`: of time; `share(guard)`: by what a value is to be multiplied to be without a unit.
template <class Steps, class Values, class Share>
PathNearMiss nearestMiss(const std::vector<ConstrainedGuard>& guards, const Steps& steps, double known, double until, double unit, const Values& value_at,
                         const Share& share) {
  // How well the time of a least value is known, as a share of it or of the unit of time: values are flat there.
  constexpr double kLeastWithin = 1e-9;
  constexpr double kGolden = 0.6180339887498949;
  const auto guard_at = [&](std::size_t guard, double t) { return value_at(steps.at(t, known), t)[guard]; };
  const auto least_of = [&](std::size_t guard, double from, double to) {  // by golden sections
    double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
    double at_left = guard_at(guard, left), at_right = guard_at(guard, right);
    while (to - from > kLeastWithin * std::max(to, unit)) {
      if (at_left < at_right) {
        to = right, right = left, at_right = at_left;
        at_left = guard_at(guard, left = to - kGolden * (to - from));
      } else {
        from = left, left = right, at_left = at_right;
        at_right = guard_at(guard, right = from + kGolden * (to - from));
      }
    }
    return 0.5 * (from + to);
  };
  PathNearMiss nearest;
  std::vector<double> last, before;  // values at the two times looked at last
  double at = steps.empty() ? 0 : steps.front().start, earlier = at;
  for (const auto& step : steps) {
    if (!(step.length > 0) || !(step.start < until)) break;
    for (const double node : Gauss::get().node) {
      const double t = step.start + node * step.length;
      const std::vector<double> now = value_at(step, t);
      for (std::size_t g = 0; g < guards.size() && !before.empty(); ++g) {
        if (!(last[g] < before[g]) || !(last[g] <= now[g])) continue;
        const double time = least_of(g, earlier, t), margin = std::abs(guard_at(g, time)) * share(guards[g]);
        if (time <= until && margin < nearest.margin) nearest = {margin, time, guards[g]};
      }
      before = std::move(last), last = now, earlier = at, at = t;
      if (t > until) return nearest;
    }
  }
  return nearest;
}

}  // namespace carom::adjoint_detail
