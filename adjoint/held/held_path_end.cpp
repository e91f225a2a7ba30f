// SPDX-License-Identifier: MIT
// Where a path in contact ends: roots of its guards.

#include <algorithm>
#include <cmath>

#include "adjoint/held/held_path.hpp"

namespace carom::adjoint_detail {
namespace {

// Guards that fall to 0 nearer to one another than this share of the time do so at once.
constexpr double kAtOnce = 1e-13;
// Rounds in which an end is moved to the root of its guard, and by how much of the step.
constexpr int kEndRounds = 4;
constexpr double kEndMoves = 0.2;
// What a slip that ends may have across its direction, as a share of the unit of speed: one that goes straight, and one
// that still turns.
constexpr double kStraightLeft = 1e-6, kNothingLeft = 1e-11;

// Between two nodes, or a little beyond the second one.
std::vector<Vec3> slipBetween(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double share) {
  std::vector<Vec3> slip = from;
  for (std::size_t k = 0; k < slip.size(); ++k) slip[k] += share * (to[k] - from[k]);
  return slip;
}

// At the end of a step, as far beyond its last node as that is beyond the one before.
std::vector<Vec3> slipAtEnd(const HeldStep& step) {
  const auto& node = Gauss::get().node;
  const double last = node[Gauss::kNodes - 1], before = node[Gauss::kNodes - 2];
  return slipBetween(step.slipAtNode(Gauss::kNodes - 2), step.slipAtNode(Gauss::kNodes - 1), (1 - before) / (last - before));
}

}  // namespace

// The values of all guards at times of one step.
struct HeldPath::Values {
  const HeldPath& path;
  const HeldStep& step;
  HeldInstant now;
  HeldForces forces;
  std::vector<double> values;

  Values(const HeldPath& of, const HeldStep& in) : path(of), step(in), values(of.guards_.size()) {}

  const std::vector<double>& at(double t, const std::vector<Vec3>& slip) {
    const State s = step.stateAt(t);
    const Mat3 R = s.q.toRotationMatrix();
    placeInstant(path.scene_, path.contacts_, s, R, now);
    for (std::size_t k = 0; k < slip.size(); ++k) {
      ContactInstant<double>& c = now.contacts[k];
      c.slip = slip[k];
      if (c.mode == HeldMode::slides && c.friction > 0) c.slip = (c.slip - c.n.dot(c.slip) * c.n).normalized();
    }
    forces.solve(now, path.redundant_);
    const Pose own{s.x, path.scene_.model->shapeToWorld(R)};
    for (std::size_t g = 0; g < values.size(); ++g)
      values[g] = guardValue(path.guards_[g], path.scene_, path.contacts_, own, now, forces);
    return values;
  }
};

// The state of an event is that at the end of a step: the step is made anew up to the root, which is looked for once more
// there, where directions of slip are known better than between the nodes of a longer step. False: there is no such step.
bool HeldPath::endAt(HeldStepper& stepper, const HeldStepper::Start& start, HeldStep& step, End& end) const {
  const auto which = static_cast<std::size_t>(
      std::ranges::find_if(guards_, [&](const HeldGuard& g) { return g.isSame(end.guard); }) - guards_.begin());
  for (int round = 0; round < kEndRounds; ++round) {
    const double shorter = end.time - known_;
    if (shorter == step.length) return true;
    std::optional<HeldStep> ending = stepper.tried(start, shorter, &step);
    if (!ending) return false;
    step = std::move(*ending);
    if (round == kEndRounds - 1) return true;
    Values values(*this, step);
    const std::vector<Vec3> last = slipAtEnd(step);
    const double h = step.length, value = values.at(known_ + h, last)[which],
                 earlier = values.at(known_ + 0.999 * h, slipBetween(step.slipAtNode(Gauss::kNodes - 1), last, 0.9))[which];
    const double move = -value * (0.001 * h) / (value - earlier);
    if (!(std::abs(move) <= kEndMoves * h) || std::abs(move) <= 1e-16 * known_) return true;
    end.time += move;
  }
  return true;
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
  std::vector<Vec3> slip;
  for (const auto& of : step.slip) slip.push_back(of.front());
  if (steps_.empty())
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      if (!contacts_[k].slip.isZero(0)) slip[k] = contacts_[k].slip;
  Values values(*this, step);
  std::vector<double> last = values.at(before, slip);
  for (int i = 0; i <= Gauss::kNodes; ++i) {
    const double t = i < Gauss::kNodes ? step.start + gauss.node[i] * step.length : step.start + step.length;
    const std::vector<Vec3> here = step.slipAtNode(std::min(i, Gauss::kNodes - 1));
    const std::vector<double> now = values.at(t, here);
    std::optional<End> first;
    for (std::size_t g = 0; g < guards_.size(); ++g) {
      if (!(now[g] < -guardRounding(guards_[g])) || !(now[g] < last[g])) continue;
      const double root = last[g] <= 0 ? before : rootOf(values, g, before, t, slip, here);
      // what comes at one instant comes in the order of the guards, whatever the rounding
      if (!first || root < first->time - kAtOnce * std::abs(root)) first = End{root, guards_[g]};
    }
    if (first) return first;
    before = t, last = now, slip = here;
  }
  return std::nullopt;
}

double HeldPath::rootOf(Values& values, std::size_t guard, double above, double below,
                        const std::vector<Vec3>& slip_above, const std::vector<Vec3>& slip_below) const {
  const double length = below - above, from = above;
  double high = values.at(above, slip_above)[guard], low = values.at(below, slip_below)[guard];
  if (!(high > 0)) return above;
  int side = 0;
  for (int k = 0; k < 100 && std::nextafter(above, below) < below && low < 0; ++k) {
    // the chord, drawn towards the end that has not moved (Illinois), with halving where it does not help
    double t = k % 8 == 7 ? 0.5 * (above + below) : above + (below - above) * (high / (high - low));
    t = std::clamp(t, std::nextafter(above, below), std::nextafter(below, above));
    const double now = values.at(t, slipBetween(slip_above, slip_below, (t - from) / length))[guard];
    if (now > 0) {
      above = t, high = now;
      if (side == 1) low *= 0.5;
      side = 1;
    } else {
      below = t, low = now;
      if (side == -1) high *= 0.5;
      side = -1;
    }
    if (below - above <= 4e-16 * std::max(std::abs(below), length) || now == 0) break;
  }
  return below;
}

}  // namespace carom::adjoint_detail
