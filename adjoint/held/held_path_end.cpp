// SPDX-License-Identifier: MIT
// Where a path in contact ends: roots of its guards, and where they nearly are.

#include <algorithm>
#include <cmath>

#include "adjoint/held/held_path.hpp"

namespace carom::adjoint_detail {
namespace {

// Guards that fall to 0 nearer to one another than this share of the time do so at once.
constexpr double kAtOnce = 1e-13;
// Rounds of a step to its end, and by which share of it the end may still move.
constexpr int kEndings = 6;
constexpr double kSameEnd = 1e-15;
// How well the time of a least value is known, s, or as a share of the time: values are flat there.
constexpr double kLeastWithin = 1e-9;
// What a slip that ends may have across its direction, as a share of the unit of speed: one that goes straight, and one
// that still turns.
constexpr double kStraightLeft = 1e-6, kNothingLeft = 1e-11;

}  // namespace

// The values of all guards at times of one step.
struct HeldPath::Values {
  const HeldPath& path;
  const HeldStep& step;
  HeldInstant now;
  HeldForces forces;
  std::vector<Vec3> slip;
  std::vector<double> values;

  Values(const HeldPath& of, const HeldStep& in) : path(of), step(in), values(of.guards_.size()) {}

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
    placeInstant(path.scene_, path.contacts_, s, R, now);
    for (std::size_t k = 0; k < slip.size(); ++k) {
      ContactInstant<double>& c = now.contacts[k];
      c.slip = slip[k];
      if (c.mode == HeldMode::slides && c.friction > 0) c.slip = inPlane(c.slip, c.n);
    }
    forces.solve(now, path.redundant_);
    forces.share();
    const Pose own{s.x, path.scene_.model->shapeToWorld(R)};
    for (std::size_t g = 0; g < values.size(); ++g)
      values[g] = guardValue(path.guards_[g], path.scene_, path.contacts_, own, now, forces);
    return values;
  }
};

// The state of an event is that at the end of a step: the step is made anew up to the root, which is found once more
// there. False: there is no such step.
bool HeldPath::endAt(HeldStepper& stepper, const HeldStepper::Start& start, HeldStep& step, End& end) const {
  const auto which = static_cast<std::size_t>(
      std::ranges::find_if(guards_, [&](const HeldGuard& g) { return g.isSame(end.guard); }) - guards_.begin());
  for (int round = 0; round < kEndings; ++round) {
    const double shorter = end.time - known_;
    if (shorter == step.length) return true;
    std::optional<HeldStep> ending = stepper.tried(start, shorter, &step);
    if (!ending) return false;
    step = std::move(*ending);
    Values values(*this, step);
    const double h = step.length, value = values.at(known_ + h)[which], earlier = values.at(known_ + 0.999 * h)[which];
    const double move = -value * (0.001 * h) / (value - earlier);
    if (std::abs(move) <= std::max(kSameEnd * h, 1e-16 * known_)) return true;
    const bool is_rounding = std::abs(value) <= guardRounding(guards_[which]);  // of a guard that hardly moves
    if (is_rounding && (round > 0 || !(value < earlier))) return true;
    if (!(std::abs(move) <= 0.5 * h)) return false;
    end.time += move;
  }
  return false;
}

// A slip that was expected to end has not.
bool HeldPath::passesBy(const HeldStep& step, const End& end) const {
  if (end.guard.cause != TransitionCause::sticks) return false;
  const HeldInstant now = instantOf(scene_, contacts_, step.stateAt(step.start + step.length),
                                    step.slipAtNode(Gauss::kNodes - 1));
  const auto k = static_cast<std::size_t>(end.guard.contact);
  return now.slipAt(k).norm() > (step.frozen[k] ? kStraightLeft : kNothingLeft) * scene_.speed;
}

// The first guard that falls through 0, looked for at the nodes and at both ends.
std::optional<HeldPath::End> HeldPath::firstEnd(const HeldStep& step) const {
  if (guards_.empty()) return std::nullopt;
  const Gauss& gauss = Gauss::get();
  double before = step.start;
  Values values(*this, step);
  std::vector<double> last = values.atStart();
  for (int i = 0; i <= Gauss::kNodes; ++i) {
    const double t = step.start + (i < Gauss::kNodes ? gauss.node[i] : 1) * step.length;
    const std::vector<double> now = values.at(t);
    std::optional<End> first;
    for (std::size_t g = 0; g < guards_.size(); ++g) {
      if (!(now[g] < -guardRounding(guards_[g])) || !(now[g] < last[g])) continue;
      const double root = last[g] <= 0 ? before : rootOf(values, g, {before, t, last[g], now[g]});
      // what comes at one instant comes in the order of the guards, whatever the rounding
      if (!first || root < first->time - kAtOnce * std::abs(root)) first = End{root, guards_[g]};
    }
    if (first) return first;
    before = t, last = now;
  }
  return std::nullopt;
}

double HeldPath::guardAt(std::size_t guard, double t) const {
  Values values(*this, stepAt(t));
  return values.at(t)[guard];
}

// By golden sections.
double HeldPath::leastOf(std::size_t guard, double from, double to) const {
  constexpr double kGolden = 0.6180339887498949;
  double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
  double at_left = guardAt(guard, left), at_right = guardAt(guard, right);
  while (to - from > kLeastWithin * std::max(to, 1.0)) {
    if (at_left < at_right) {
      to = right, right = left, at_right = at_left;
      at_left = guardAt(guard, left = to - kGolden * (to - from));
    } else {
      from = left, left = right, at_left = at_right;
      at_right = guardAt(guard, right = from + kGolden * (to - from));
    }
  }
  return 0.5 * (from + to);
}

HeldPath::NearMiss HeldPath::nearestMiss(double until) const {
  NearMiss nearest;
  std::vector<double> last, before;  // values at the two times looked at last
  double at = start_, earlier = start_;
  const auto look = [&](double t, const std::vector<double>& now) {
    for (std::size_t g = 0; g < guards_.size() && !before.empty(); ++g) {
      if (!(last[g] < before[g]) || !(last[g] <= now[g])) continue;
      const double time = leastOf(g, earlier, t), margin = std::abs(guardAt(g, time));
      if (time <= until && margin < nearest.margin) nearest = {margin, time, guards_[g]};
    }
    before = std::move(last), last = now, earlier = at, at = t;
  };
  for (const HeldStep& step : steps_) {
    if (!(step.length > 0) || !(step.start < until)) break;
    Values values(*this, step);
    for (const double node : Gauss::get().node) {
      const double t = step.start + node * step.length;
      look(t, values.at(t));
      if (t > until) return nearest;
    }
  }
  return nearest;
}

double HeldPath::rootOf(Values& values, std::size_t guard, Bracket in) const {
  const double length = in.below - in.above;
  int side = 0;
  for (int k = 0; k < 100 && std::nextafter(in.above, in.below) < in.below && in.low < 0; ++k) {
    // the chord, drawn towards the end that has not moved (Illinois), with halving where it does not help
    double t = k % 8 == 7 ? 0.5 * (in.above + in.below)
                          : in.above + (in.below - in.above) * (in.high / (in.high - in.low));
    t = std::clamp(t, std::nextafter(in.above, in.below), std::nextafter(in.below, in.above));
    const double now = values.at(t)[guard];
    if (now > 0) {
      in.above = t, in.high = now;
      if (side == 1) in.low *= 0.5;
      side = 1;
    } else {
      in.below = t, in.low = now;
      if (side == -1) in.high *= 0.5;
      side = -1;
    }
    if (in.below - in.above <= 4e-16 * std::max(std::abs(in.below), length) || now == 0) break;
  }
  return in.below;
}

}  // namespace carom::adjoint_detail
