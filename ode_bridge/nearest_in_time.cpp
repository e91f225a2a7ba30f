// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/illinois.hpp"
#include "ode_bridge/depth.hpp"
#include "ode_bridge/nearest.hpp"
#include "ode_bridge/touching.hpp"

// The least distance m known so far is a level that nothing may lie below. Bodies grown by m touch where their distance
// is m, so that the steps of the search for impacts, which cannot pass a touch of those grown bodies, exclude lower
// distances; where a step ends below the level, the way down from there ends in a lower least distance.

namespace carom::ode_bridge_detail {

using adjoint_detail::IllinoisEnds;
using adjoint_detail::Nearest;
using adjoint_detail::NearestInTime;

namespace {

// What may lie below the least distance that is found, as a share of the sizes and the distance; after so many steps it
// is doubled, again and again.
constexpr double kBelow = 1e-10;
constexpr int kStepsOfLevel = 5'000;
constexpr int kMostSearchSteps = 1'000'000;
// Balls further apart than this share of their size are followed as such; nearer ones are opened.
constexpr double kFarApart = 0.25;
constexpr int kMostRounds = 200;
constexpr double kSameGap = 1e-13;

struct Waiting {
  double time = 0;
  int node_a = 0, node_b = 0;

  bool operator<(const Waiting& o) const {
    if (time != o.time) return time > o.time;
    return node_a != o.node_a ? node_a > o.node_a : node_b > o.node_b;
  }
};

class LeastDistance {
 public:
  LeastDistance(const Solid& a, const Solid& b, const Arc& arc_a, const Arc& arc_b, double from, double to,
                double under, WhereOverlapping overlap)
      : solid_a_(a), solid_b_(b), arc_a_(arc_a), arc_b_(arc_b), from_(from), to_(to), level_(under), overlap_(overlap) {}

  std::optional<NearestInTime> find() {
    consider(at(from_));
    if (!touches() && to_ > from_) {
      consider(at(to_));
      if (!touches()) sweep();
    }
    if (!best_) return std::nullopt;
    best_->below = slack();
    return best_;
  }

 private:
  bool hasDepth() const { return overlap_ == WhereOverlapping::depth; }
  bool touches() const { return best_ && !hasDepth() && !best_->nearest.apart(); }

  // Of the present level.
  double slack() const {
    double size = 0;
    for (const Solid* s : {&solid_a_, &solid_b_})
      if (!s->plane) size = std::max(size, s->bound());
    return loose_ * kBelow * (size + (std::isfinite(level_) ? std::abs(level_) : 0));
  }

  NearestInTime at(double t) const {
    const Placed a(solid_a_, arc_a_, t), b(solid_b_, arc_b_, t);
    NearestInTime here{t, nearestOf(a, b, overlap_)};
    if (!std::isfinite(here.nearest.gap)) throw NotComputable("their distance is beyond the range of doubles");
    if (here.nearest.apart()) here.rate = gapRateOf(a, b, here.nearest.features);
    return here;
  }

  void consider(const NearestInTime& here) {
    if (!(here.nearest.gap < level_)) return;
    best_ = here;
    level_ = here.nearest.gap;
  }

  void sweep() {
    // an end from which the way goes down, first of all
    if (best_ && best_->time == from_ && best_->rate < 0) consider(wayDown(*best_));
    if (best_ && best_->time == to_ && best_->rate > 0) consider(wayDown(*best_));
    queue_.push({from_, 0, 0});
    while (!queue_.empty() && !touches()) {
      const Waiting now = queue_.top();
      queue_.pop();
      if (++steps_ > kMostSearchSteps)
        throw NotComputable("it takes more than " + std::to_string(kMostSearchSteps) +
                            " steps to find the distance of two bodies: they rotate too fast");
      if (steps_ % kStepsOfLevel == 0) loose_ *= 2;
      advance(now);
    }
  }

  void advance(const Waiting& now) {
    const Placed a(solid_a_, arc_a_, now.time), b(solid_b_, arc_b_, now.time);
    Node na = a.solid->nodes[static_cast<std::size_t>(now.node_a)];
    Node nb = b.solid->nodes[static_cast<std::size_t>(now.node_b)];
    // a half space stays as it is, the other grows
    const double level = std::isfinite(level_) ? level_ : 0;
    const bool leaves = na.piece >= 0 && nb.piece >= 0;
    const double size = (a.solid->plane ? 0 : na.radius) + (b.solid->plane ? 0 : nb.radius);
    (a.solid->plane ? nb : na).radius += level;
    const PlacedNode pa{&a, &na}, pb{&b, &nb};
    const double apart = separationOf(pa, pb), left = to_ - now.time;
    if (apart > std::max(0.0, kFarApart * size)) return later(now, safeStep(pa, pb, apart, left));
    if (!leaves) return open(now, na, nb);
    const Piece &as_is_a = a.solid->pieces[static_cast<std::size_t>(na.piece)],
                &as_is_b = b.solid->pieces[static_cast<std::size_t>(nb.piece)];
    Piece piece_a = as_is_a, piece_b = as_is_b;
    (a.solid->plane ? piece_b : piece_a).radius += level;
    const PlacedPiece p{&a, &piece_a}, q{&b, &piece_b};
    const auto depth = hasDepth() ? depthOf({&a, &as_is_a}, {&b, &as_is_b}) : std::nullopt;
    Witness witness = depth && depth->witness ? *depth->witness : findWitness(p, q);
    if (depth) witness.separation = separationAlong(p, q, witness.n);
    if (witness.separation < -slack()) {
      const double before = level_;
      consider(wayDown(at(now.time)));
      if (level_ < before) {
        queue_.push(now);
        return;
      }
    }
    later(now, safeStep(p, q, witness, slack(), left));
  }

  void later(Waiting now, double h) {
    if (std::isnan(h)) throw NotComputable("bounds on their motion are beyond the range of doubles");
    if (!(now.time + h < to_)) return;
    now.time = std::max(now.time + h, std::nextafter(now.time, to_));
    queue_.push(now);
  }

  void open(const Waiting& now, const Node& a, const Node& b) {
    const bool first = b.piece >= 0 || (a.piece < 0 && a.radius >= b.radius);
    const Node& node = first ? a : b;
    for (const int child : {node.left, node.right}) {
      Waiting next = now;
      (first ? next.node_a : next.node_b) = child;
      queue_.push(next);
    }
  }

  // From a place to the bottom of the valley that it is on a side of.
  NearestInTime wayDown(NearestInTime here) const {
    if (!here.nearest.apart() || here.rate == 0) return here;
    const double way = here.rate < 0 ? 1 : -1, end = here.rate < 0 ? to_ : from_;
    double h = std::abs(end - here.time) / 64;
    for (int round = 0; round < kMostRounds && here.time != end; ++round) {
      const double t = way * (here.time + way * h - end) >= 0 ? end : here.time + way * h;
      if (t == here.time) break;
      const NearestInTime next = at(t);
      if (!next.nearest.apart()) return next;
      if (way * next.rate >= 0) return bottom(here, next);
      if (next.nearest.gap < here.nearest.gap) {
        here = next;
        h *= 2;
      } else {
        h /= 4;  // beyond a hill
      }
    }
    return here;
  }

  // Separations cancel where they are 0.
  double sizes() const { return hasDepth() ? solid_a_.bound() + solid_b_.bound() : 0; }

  // Where the distances are the same but for rounding, the rate says which place is nearer to the bottom.
  bool isLower(const NearestInTime& p, const NearestInTime& q) const {
    const double difference = p.nearest.gap - q.nearest.gap;
    if (std::abs(difference) > kSameGap * (std::abs(q.nearest.gap) + sizes())) return difference < 0;
    return std::abs(p.rate) < std::abs(q.rate);
  }

  // Between a place where the distance falls towards the other and one where it does not: where its rate is 0.
  NearestInTime bottom(NearestInTime a, NearestInTime b) const {
    NearestInTime best = isLower(a, b) ? a : b;
    IllinoisEnds f{a.rate, b.rate};
    for (int round = 0; round < kMostRounds && f.b != 0; ++round) {
      double t = a.time - f.a * (b.time - a.time) / (f.b - f.a);
      if (round % 8 == 7 || !std::isfinite(t) || f.a * f.b > 0) t = a.time + 0.5 * (b.time - a.time);
      if (!((t > a.time && t < b.time) || (t < a.time && t > b.time))) break;
      if (hasDepth() && a.nearest.features != b.nearest.features) {
        // the rate may jump from one pair of features to another
        const auto crossing = round % 2 == 0 ? crossingOf(a, b) : std::nullopt;
        if (crossing && crossing->other && crossing->nearest.gap <= a.nearest.gap) return *crossing;
        t = a.time + 0.5 * (b.time - a.time);
        if (!((t > a.time && t < b.time) || (t < a.time && t > b.time))) break;
      }
      const NearestInTime here = at(t);
      if (!here.nearest.apart()) return here;
      if (isLower(here, best)) best = here;
      // beyond a hill that is as high there is a valley before it
      if ((here.rate < 0) == (a.rate < 0) && here.rate != 0 &&
          here.nearest.gap <= a.nearest.gap + kSameGap * (std::abs(a.nearest.gap) + sizes())) {
        a = here, f.moveA(here.rate);
      } else {
        b = here, f.moveB(here.rate);
      }
    }
    // a jump that no crossing of two explains
    if (hasDepth() && a.nearest.features != b.nearest.features) best.nearest.several = true;
    return best;
  }

  // Where two pairs of features overtake each other between a and b, that of a falling and that of b rising: the least of
  // the larger of both. Without `other` where a third one rules at that time.
  std::optional<NearestInTime> crossingOf(const NearestInTime& a, const NearestInTime& b) const {
    const FeaturePair &f = a.nearest.features, &g = b.nearest.features;
    if (!a.nearest.apart() || !b.nearest.apart()) return std::nullopt;
    const auto difference = [&](double t) {
      const Placed pa(solid_a_, arc_a_, t), pb(solid_b_, arc_b_, t);
      return contactAt(pa, pb, f).gap - contactAt(pa, pb, g).gap;
    };
    double s = a.time, t = b.time;
    IllinoisEnds d{difference(s), difference(t)};
    if (!(d.a >= 0 && d.b <= 0 && d.a > d.b)) return std::nullopt;
    for (int round = 0; round < kMostRounds; ++round) {
      double u = s + d.a * (t - s) / (d.a - d.b);
      if (round % 8 == 7 || !std::isfinite(u)) u = s + 0.5 * (t - s);
      if (!((u > s && u < t) || (u < s && u > t))) break;
      const double du = difference(u);
      if (!std::isfinite(du)) return std::nullopt;
      if (du > 0) {
        s = u, d.moveA(du);
      } else {
        t = u, d.moveB(du);
        if (du == 0) break;
      }
    }
    if (std::abs(difference(s)) < std::abs(difference(t))) t = s;
    NearestInTime here = at(t);
    const Placed pa(solid_a_, arc_a_, t), pb(solid_b_, arc_b_, t);
    const ContactPoint of_f = contactAt(pa, pb, f), of_g = contactAt(pa, pb, g);
    const double rate_f = gapRateOf(pa, pb, f), rate_g = gapRateOf(pa, pb, g), way = a.time < b.time ? 1 : -1;
    const double scale = std::abs(here.nearest.gap) + solid_a_.bound() + solid_b_.bound() + pa.k.x.norm();
    const bool rules = std::abs(of_f.gap - here.nearest.gap) <= kSameGap * scale &&
                       std::abs(of_g.gap - here.nearest.gap) <= kSameGap * scale;
    if (!rules || !(way * rate_f < 0) || !(way * rate_g > 0)) return here;
    here.nearest.features = f, here.nearest.normal = of_f.normal, here.nearest.several = false;
    here.rate = rate_f;
    here.other = here.nearest;
    here.other->features = g, here.other->normal = of_g.normal;
    here.other_rate = rate_g;
    return here;
  }

  const Solid &solid_a_, &solid_b_;
  const Arc &arc_a_, &arc_b_;
  double from_, to_, level_, loose_ = 1;
  WhereOverlapping overlap_;
  int steps_ = 0;
  std::optional<NearestInTime> best_;
  std::priority_queue<Waiting> queue_;
};

}  // namespace

std::optional<NearestInTime> nearestInTimeOf(const Solid& a, const Solid& b, const Arc& arc_a, const Arc& arc_b,
                                             double from, double to, double under, WhereOverlapping overlap) {
  return LeastDistance(a, b, arc_a, arc_b, from, to, under, overlap).find();
}

}  // namespace carom::ode_bridge_detail
