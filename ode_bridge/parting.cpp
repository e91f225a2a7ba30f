// SPDX-License-Identifier: MIT
#include "ode_bridge/parting.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "ode_bridge/overlap.hpp"
#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {
namespace {

// Steps are as long as it takes to part by this share of the smaller body's size at the least.
constexpr double kLeastShare = 1e-4;
constexpr int kMostSteps = 1'000'000;

class Pair {
 public:
  Pair(const Solid& a, const Solid& b, Arc& arc_a, Arc& arc_b, WorkCount* work)
      : a_(a), b_(b), arc_a_(arc_a), arc_b_(arc_b), work_(work), size_(std::min(a.bound(), b.bound())) {}

  // How deep they overlap; none when they do not.
  std::optional<double> depthAt(double t) {
    arc_a_.extendTo(t);
    arc_b_.extendTo(t);
    const Placed a(a_, arc_a_, t), b(b_, arc_b_, t);
    return overlapOf(a, b, touchTolerance(a, b), work_);
  }

  // A time that it takes to move by `depth` against each other, at the least.
  double timeFor(double depth, double t) const {
    const double speed = (arc_a_.velocityAt(t) - arc_b_.velocityAt(t)).norm() + turning(a_, arc_a_) + turning(b_, arc_b_);
    const double acceleration = (arc_a_.acceleration() - arc_b_.acceleration()).norm() +
                                arc_a_.accelerationVariation() + arc_b_.accelerationVariation();
    return 2 * depth / (speed + std::sqrt(speed * speed + 2 * acceleration * depth));
  }
  double leastStep(double t) const { return timeFor(kLeastShare * size_, t); }

 private:
  static double turning(const Solid& solid, const Arc& arc) { return solid.plane ? 0 : arc.spinBound() * solid.bound(); }

  const Solid &a_, &b_;
  Arc &arc_a_, &arc_b_;
  WorkCount* work_;
  double size_;
};

// Between a time at which they overlap and one at which they do not.
double bisected(Pair& pair, double overlapping, double apart) {
  for (;;) {
    const double middle = overlapping + 0.5 * (apart - overlapping);
    if (!(middle > overlapping && middle < apart)) return apart;
    (pair.depthAt(middle) ? overlapping : apart) = middle;
  }
}

}  // namespace

std::optional<double> partingTime(const Solid& a, const Solid& b, Arc& arc_a, Arc& arc_b, double from, double until,
                                  WorkCount* work) {
  Pair pair(a, b, arc_a, arc_b, work);
  double before = from;
  for (int steps = 0; steps < kMostSteps; ++steps) {
    const std::optional<double> depth = pair.depthAt(before);
    if (!depth) return before;
    // half of the depth: it is known as far as the directions that decide tell
    const double t = before + std::max(pair.timeFor(0.5 * *depth, before), pair.leastStep(before));
    if (!(t < until)) return pair.depthAt(until) ? std::nullopt : std::optional(bisected(pair, before, until));
    if (!pair.depthAt(t)) return bisected(pair, before, t);
    before = t;
  }
  throw NotComputable("they overlap from the start, and it takes more than " + std::to_string(kMostSteps) +
                      " steps to decide whether they separate");
}

}  // namespace carom::ode_bridge_detail
