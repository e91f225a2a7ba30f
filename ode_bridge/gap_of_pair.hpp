// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ode_bridge/pair_motion.hpp"
#include "ode_bridge/rounding.hpp"
#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {

// An approach of less than this share of the speeds, or of what spins and accelerations give (ownSpeed), may be that of a
// touch which goes no deeper: of bodies that began in touch, or roll along a seam.
inline constexpr double kGrazing = 1e-3, kGrazingOfOwn = 1e-5;
// It is one if a straight approach would overlap by so many tolerances of contact, and it does not come half as far.
inline constexpr double kDeeper = 4;

// Bodies in touch that begin with no more than this share of ownSpeed against each other begin with nothing.
inline constexpr double kAtRest = 1e-15;

// What spins, and accelerations against each other, give over the size of what moves, m/s.
inline double ownSpeed(const Placed& a, const Placed& b) {
  double length = 0, spinning = 0;
  for (const Placed* p : {&a, &b}) {
    if (p->solid->plane || !p->arc || p->arc->stays()) continue;
    length = std::max(length, p->solid->bound());
    spinning += p->spin * p->solid->bound();
  }
  return spinning + std::sqrt((a.acceleration - b.acceleration).norm() * length);
}

// An approach along n slower than this cannot be told from none. What a body spins by about n moves nothing along n,
// but for its rounding.
inline double stillSpeed(const Placed& a, const Placed& b, const Vec3& n) {
  double speed = a.k.v.norm() + b.k.v.norm(), spinning = 0;
  for (const Placed* p : {&a, &b}) {
    if (!(p->spin > 0)) continue;
    speed += n.cross(p->k.w).norm() * p->solid->bound();
    spinning += p->spin * p->solid->bound();
  }
  return kStill * speed + 32 * kEps * spinning;
}

inline double gapRate(const Placed& a, const Placed& b, const ContactPoint& c) {
  return c.normal.dot(a.k.v + a.k.w.cross(c.point - a.k.x) - b.k.v - b.k.w.cross(c.point - b.k.x));
}

struct Root {
  double time = 0;
  bool approaching = false;
};

// The gap of frozen features along the two arcs, near the times at which it is within rounding of zero.
class GapOfPair {
 public:
  GapOfPair(const PairMotion& pair, const FeaturePair& features, double from, double until, double tolerance)
      : pair_(pair), features_(features), from_(from), until_(until), tolerance_(tolerance) {}

  // Its root near time t, at which the bodies are `a0` and `b0`: by Newton, never before the start of the search. Where
  // they have not `parted` since, and did not approach there, it is that start.
  Root root(double t, const Placed& a0, const Placed& b0, bool parted) const {
    const State now = stateOf(a0, b0);
    if (!(now.rate < -now.still) || (!parted && !goesDeeper(t, now))) return {t, false};
    if (!parted && t > from_) {
      const State start = stateAt(from_);
      const bool at_rest = std::abs(start.rate) <= std::max(start.still, kAtRest * start.own);
      if (at_rest && std::abs(start.gap) <= kDeeper * tolerance_ && !risesBefore(t)) return {from_, true};
    }
    return newton(t, now);
  }

  bool isSlowAt(const Placed& a0, const Placed& b0) const { return isSlow(stateOf(a0, b0)); }

 private:
  struct State {
    double gap, rate, still, speed, own;  // slower than `still` is no approach
  };
  static bool isSlow(const State& at) { return -at.rate < std::max(kGrazing * at.speed, kGrazingOfOwn * at.own); }

  State stateOf(const Placed& a, const Placed& b) const {
    const ContactPoint c =
        pair_.geometry.contact(pair_.a, pair_.b, features_, {a.k.x, a.k.R}, {b.k.x, b.k.R});
    return {c.gap, gapRate(a, b, c), stillSpeed(a, b, c.normal), a.k.v.norm() + b.k.v.norm(), ownSpeed(a, b)};
  }
  State stateAt(double t) const {
    pair_.arc_a.extendTo(t);
    pair_.arc_b.extendTo(t);
    const Placed a(pair_.geometry.solid(pair_.a), pair_.arc_a, t), b(pair_.geometry.solid(pair_.b), pair_.arc_b, t);
    return stateOf(a, b);
  }

  // Whether bodies that begin with nothing against each other part before they meet, however little.
  bool risesBefore(double t) const {
    for (double h = 0.125 * (t - from_); from_ + h > from_; h *= 0.125) {
      const State then = stateAt(from_ + h);
      const double still = std::max(then.still, kAtRest * then.own);
      if (then.rate > still) return true;
      if (std::abs(then.rate) <= still) break;
    }
    return false;
  }

  // The gap of bodies that began in touch may have its least value at that touch, 0 but for rounding.
  bool goesDeeper(double t, const State& now) const {
    if (!isSlow(now)) return true;
    const double h = std::min(kDeeper * tolerance_ / -now.rate, until_ - t);
    if (!(t + h > t)) return true;
    return stateAt(t + h).gap < now.gap + 0.5 * h * now.rate && !partsFirst(t, h, now);
  }

  // Whether what comes so deep within h parts before, so that it comes back later.
  bool partsFirst(double t, double h, const State& now) const {
    constexpr double kLonger = 64, kShortest = 1e-18;
    for (double after = kShortest * h; after < h; after *= kLonger) {
      const State then = stateAt(t + after);
      if (then.gap < now.gap - tolerance_) return false;
      if (then.rate > std::max(then.still, kAtRest * then.own)) return true;
    }
    return false;
  }

  Root newton(double t, State at) const {
    double best = std::abs(at.gap);
    for (int round = 0; round < 6; ++round) {
      const double next = std::max(from_, t - at.gap / at.rate);
      if (std::abs(next - t) <= 2 * kEps * t) return {next, true};
      at = stateAt(next);
      if (next < t && at.rate > at.still) return {descentBetween(next, t), true};
      if (!(std::abs(at.gap) < best) || !(at.rate < 0)) return {std::abs(at.gap) <= best ? next : t, true};
      best = std::abs(at.gap);
      t = next;
    }
    return {t, true};
  }

  // The gap rises at `rising` and has fallen again to 0 or less at `fallen`: they have parted and come back.
  double descentBetween(double rising, double fallen) const {
    for (;;) {
      const double middle = rising + 0.5 * (fallen - rising);
      if (!(middle > rising && middle < fallen)) return fallen;
      const State at = stateAt(middle);
      (at.gap > 0 || at.rate > at.still ? rising : fallen) = middle;
    }
  }

  const PairMotion& pair_;
  const FeaturePair& features_;
  double from_, until_, tolerance_;
};

}  // namespace carom::ode_bridge_detail
