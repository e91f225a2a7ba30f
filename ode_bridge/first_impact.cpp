#include "ode_bridge/first_impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
// Positions of size 1 are known to 1e-16 and a separation is a sum of some ten of them.
constexpr double kTouch = 1e-13;
// Approach slower than this share of the speeds involved cannot be told from none.
constexpr double kStill = 1e-12;

double speedScale(const Placed& a, const Placed& b) {
  return a.k.v.norm() + b.k.v.norm() + a.spin * a.solid->reach + b.spin * b.solid->reach;
}

double gapRate(const Placed& a, const Placed& b, const ContactPoint& c) {
  return c.normal.dot(a.k.v + a.k.w.cross(c.point - a.k.x) - b.k.v - b.k.w.cross(c.point - b.k.x));
}

struct Root {
  double time = 0;
  bool approaching = false;
};

// Newton on the gap of frozen features from a time at which it is within rounding of zero.
Root refine(const PairMotion& pair, const FeaturePair& features, double from, double t, const Placed& a0,
            const Placed& b0) {
  const Solid &sa = pair.geometry.solid(pair.a), &sb = pair.geometry.solid(pair.b);
  ContactPoint c = pair.geometry.contact(pair.a, pair.b, features, a0.pose(), b0.pose());
  double rate = gapRate(a0, b0, c);
  if (!(rate < -kStill * speedScale(a0, b0))) return {t, false};
  double best = std::abs(c.gap);
  for (int round = 0; round < 6; ++round) {
    const double next = std::max(from, t - c.gap / rate);
    if (std::abs(next - t) <= 2 * kEps * std::max(1.0, t)) return {next, true};
    pair.arc_a.extendTo(next);
    pair.arc_b.extendTo(next);
    const Placed a(sa, pair.arc_a, next), b(sb, pair.arc_b, next);
    c = pair.geometry.contact(pair.a, pair.b, features, a.pose(), b.pose());
    const double new_rate = gapRate(a, b, c);
    if (!(std::abs(c.gap) < best) || !(new_rate < 0)) return {std::abs(c.gap) <= best ? next : t, true};
    best = std::abs(c.gap);
    rate = new_rate;
    t = next;
  }
  return {t, true};
}

}  // namespace

double touchTolerance(const Placed& a, const Placed& b) {
  double scale = 1;
  for (const Placed* p : {&a, &b})
    if (!p->solid->plane) scale = std::max({scale, p->k.x.cwiseAbs().maxCoeff(), p->solid->bound()});
  return kTouch * scale;
}

namespace {

// Bodies that glide along each other without approaching are followed in steps that the tolerance of contact allows.
// After so many such steps in a row it is doubled, up to kLoosest times; what they may overlap by stays below 1e-10 m.
constexpr int kGlideSteps = 64;
constexpr double kLoosest = 1000;

// The library proposes a direction when boxes first come near, grown by this share of their size.
constexpr double kGrown = 0.01;

// The candidate direction, if the exact geometry says that the solids are apart along it.
std::optional<Witness> candidateWitness(const PairMotion& pair, const Placed& a, const Placed& b, double tolerance) {
  if (!a.solid->box || !b.solid->box) return std::nullopt;
  const auto n =
      pair.narrow_phase.candidateNormal(pair.a, pair.b, a, b, kGrown * std::min(a.solid->reach, b.solid->reach));
  if (!n) return std::nullopt;
  const Witness w = witnessAlong(a, b, *n);
  return w.separation > tolerance ? std::optional(w) : std::nullopt;
}

// The earliest impact among the features that touch, if any of them approaches.
std::optional<PredictedImpact> impactAtTouch(const PairMotion& pair, const Placed& a, const Placed& b,
                                             const Witness& witness, double from, double t, double until,
                                             double tolerance) {
  std::optional<PredictedImpact> first;
  const double reach = std::max(4 * tolerance, 2 * std::abs(witness.separation));
  for (const FeaturePair& f : touchingFeatures(a, b, witness, reach)) {
    const Root root = refine(pair, f, from, t, a, b);
    if (root.approaching && root.time <= until && (!first || root.time < first->time))
      first = PredictedImpact{root.time, f};
  }
  return first;
}

}  // namespace

std::optional<PredictedImpact> findFirstImpact(const PairMotion& pair, double from, double until) {
  const Solid &sa = pair.geometry.solid(pair.a), &sb = pair.geometry.solid(pair.b);
  int gliding = 0;
  double loose = 1;
  bool near = false;
  for (double t = from;;) {
    pair.arc_a.extendTo(t);
    pair.arc_b.extendTo(t);
    const Placed a(sa, pair.arc_a, t), b(sb, pair.arc_b, t);
    const double tolerance = touchTolerance(a, b);
    Witness witness = findWitness(a, b);
    if (!witness.bounding && !near) {
      near = true;
      if (const auto candidate = candidateWitness(pair, a, b, tolerance)) witness = *candidate;
    }
    if (witness.separation <= tolerance && !witness.bounding) {
      if (const auto first = impactAtTouch(pair, a, b, witness, from, t, until, tolerance)) return first;
      if (++gliding % kGlideSteps == 0) loose = std::min(2 * loose, kLoosest);
    } else {
      gliding = 0;
      loose = 1;
    }
    const double h = safeStep(a, b, witness, loose * tolerance, until - t);
    if (!(t + h < until)) return std::nullopt;
    t = std::max(t + h, std::nextafter(t, until));
  }
}

}  // namespace carom
