// SPDX-License-Identifier: MIT
#include "ode_bridge/first_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <vector>

#include "adjoint/base/errors.h"
#include "ode_bridge/gap_of_pair.hpp"
#include "ode_bridge/ground_seams.hpp"
#include "ode_bridge/persistent_planes.hpp"
#include "ode_bridge/rounding.hpp"
#include "ode_bridge/seams.hpp"
#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {
namespace {

// Bodies that glide along each other without approaching are followed in steps that the tolerance of contact allows.
// After so many such steps in a row it is doubled, up to kLoosest times; what they may overlap by stays below 1e-10 m.
constexpr int kGlideSteps = 64;
constexpr double kLoosest = 1000;
// In lasting contact after so many steps they are asked how long they go on so.
constexpr int kGlides = 4;
// Bodies that start in touch may overlap by somewhat less than this many tolerances of contact.
constexpr double kDeepest = 4e4;

// Faces of fixed bodies are in one plane to so many tolerances of contact.
constexpr double kFlush = 40;

// The library proposes a direction when boxes first come near, grown by this share of their size.
constexpr double kGrown = 0.01;

// Balls further apart than this share of their size are followed as such; nearer ones are opened.
constexpr double kFar = 0.05, kOpen = 0.25;

// A search of more steps than this is given up.
constexpr int kMostSteps = 1'000'000;

// Two nodes, one of each body, that cannot touch before `time`.
struct Pending {
  double time = 0;
  int node_a = 0, node_b = 0;
  int gliding = 0;
  bool parted = false;            // at some time since the start of the search
  Vec3 n = Vec3::Zero();  // the direction that told two pieces apart before; 0 for none yet

  // for a queue with the earliest on top, in an order that does not depend on how it is kept
  bool operator<(const Pending& o) const {
    if (time != o.time) return time > o.time;
    return node_a != o.node_a ? node_a > o.node_a : node_b > o.node_b;
  }
};

class Search {
 public:
  Search(const PairMotion& pair, double from, double until, std::span<const FeaturePair> held,
         std::span<const ConstrainedElsewhere> elsewhere)
      : pair_(pair),
        from_(from),
        until_(until),
        a_(pair.geometry.solid(pair.a), pair.arc_a, from),
        b_(pair.geometry.solid(pair.b), pair.arc_b, from),
        start_a_(a_),
        start_b_(b_),
        held_features_(held),
        elsewhere_(!elsewhere.empty()) {
    if (!held.empty() || !elsewhere.empty())
      held_.emplace(start_a_, start_b_, held, elsewhere, !pair.arc_a.stays());
  }

  std::optional<PredictedImpact> run() {
    searchPieces();
    if (held_) searchPlanes();
    return first_;
  }

 private:
  // What comes to the plane of a held contact, and meets there.
  void searchPlanes() {
    held_->firstReach(pair_, from_, end(), [&](double t, bool through, bool broken) {
      placeAt(t);
      const double tolerance = touchTolerance(a_, b_);
      bool found = false;
      for (const FeaturePair& f : touchingFeatures(a_, b_, 4 * tolerance)) {
        if (std::ranges::find(held_features_, f) != held_features_.end()) continue;
        const GapOfPair gap(pair_, f, from_, until_, tolerance);
        const Root root = gap.root(t, a_, b_, true);
        if (!root.approaching || isAtGroundSeam(f, root.time, tolerance)) continue;
        found = true;
        if (root.time <= until_ && (!first_ || root.time < first_->time)) first_ = PredictedImpact{root.time, f};
      }
      // what goes through the plane beside these two may meet another body there, and only then
      const bool ends = broken || (through && t > from_ && (elsewhere_ || !pair_.ground.bodies.empty()));
      if (!found && ends) first_ = PredictedImpact{t, kSearchedSoFar};
      return found || ends;
    });
  }

  void searchPieces() {
    now_ = {from_, 0, 0, 0, false, Vec3::Zero()};
    do {
      while (advance())
        if (!queue_.empty() && now_ < queue_.top()) {  // others may touch before
          queue_.push(now_);
          break;
        }
    } while (takeNext());
  }

  double end() const { return first_ ? std::min(until_, first_->time) : until_; }

  bool takeNext() {
    if (queue_.empty() || !(queue_.top().time < end())) return false;
    now_ = queue_.top();
    queue_.pop();
    return true;
  }

  void placeAt(double t) {
    if (t == placed_at_) return;
    pair_.arc_a.extendTo(t);
    pair_.arc_b.extendTo(t);
    a_ = Placed(*a_.solid, pair_.arc_a, t);
    b_ = Placed(*b_.solid, pair_.arc_b, t);
    placed_at_ = t;
  }

  // Follows the present two nodes by one step; false when they are done with: they cannot touch before the end, or
  // have touched, or others stand for them.
  bool advance() {
    placeAt(now_.time);
    const PlacedNode a{&a_, &a_.solid->nodes[static_cast<std::size_t>(now_.node_a)]},
        b{&b_, &b_.solid->nodes[static_cast<std::size_t>(now_.node_b)]};
    const bool leaves = a.node->piece >= 0 && b.node->piece >= 0;
    if (leaves && held_ && held_->keepApart(a.node->piece, b.node->piece)) return false;
    const double apart = separationOf(a, b), size = sizeOf(a) + sizeOf(b);
    if (!std::isfinite(apart)) throw NotComputable("their distance is beyond the range of doubles");
    if (pair_.work) pair_.work->step();
    if (++steps_ > kMostSteps)
      throw NotComputable("it takes more than " + std::to_string(kMostSteps) +
                          " steps: they rotate too fast, or move along each other too closely");
    if (apart > (leaves ? kFar : kOpen) * size) {
      now_.gliding = 0, now_.parted = true;
      return step(safeStep(a, b, apart, end() - now_.time));
    }
    if (!leaves) {
      if (const auto h = stepOfPieceBeforeBall(a, b)) return now_.parted = true, step(*h);
      open(a, b);
      return false;
    }
    return advancePieces({&a_, &a_.solid->pieces[static_cast<std::size_t>(a.node->piece)]},
                         {&b_, &b_.solid->pieces[static_cast<std::size_t>(b.node->piece)]});
  }

  // A long piece lies in a large ball: it may be well apart from a ball of the other body that its own ball meets.
  std::optional<double> stepOfPieceBeforeBall(const PlacedNode& a, const PlacedNode& b) const {
    const PlacedNode &leaf = a.node->piece >= 0 ? a : b, &node = a.node->piece >= 0 ? b : a;
    if (leaf.node->piece < 0 || leaf.body->solid->plane) return std::nullopt;
    const Piece& own = leaf.body->solid->pieces[static_cast<std::size_t>(leaf.node->piece)];
    if (own.core == Piece::Core::point) return std::nullopt;
    const Piece ball = ballOf(*node.node);
    const PlacedPiece p{leaf.body, &own}, q{node.body, &ball};
    const Witness witness = findDirection(p, q);
    if (!(witness.separation > kOpen * node.node->radius)) return std::nullopt;
    return safeStep(p, q, witness, 0, end() - now_.time);
  }

  static double sizeOf(const PlacedNode& p) { return p.body->solid->plane ? 0 : p.node->radius; }

  bool step(double h) {
    if (std::isnan(h)) throw NotComputable("bounds on their motion are beyond the range of doubles");
    if (!(now_.time + h < end())) return false;
    now_.time = std::max(now_.time + h, std::nextafter(now_.time, until_));
    return true;
  }

  void open(const PlacedNode& a, const PlacedNode& b) {
    const bool first = b.node->piece >= 0 || (a.node->piece < 0 && a.node->radius >= b.node->radius);
    const Node& node = first ? *a.node : *b.node;
    for (const int child : {node.left, node.right}) {
      Pending next = now_;
      (first ? next.node_a : next.node_b) = child;
      queue_.push(next);
    }
  }

  bool advancePieces(const PlacedPiece& a, const PlacedPiece& b) {
    const double tolerance = touchTolerance(a_, b_);
    Witness witness = findWitness(a, b, now_.n);
    if (now_.n.isZero(0))
      if (const auto candidate = candidateWitness(a, b, tolerance)) witness = *candidate;
    now_.n = witness.n;
    if (witness.separation <= tolerance) {
      if (impactAtTouch(a, b, witness, tolerance)) return false;
      if (witness.separation < -kDeepest * tolerance) {
        first_ = PredictedImpact{now_.time, {}};  // they meet with no features that say how
        return false;
      }
      ++now_.gliding;
    } else {
      now_.gliding = 0, now_.parted = true;
    }
    if (held_ && now_.gliding >= kGlides)
      if (const double h = glidesFor(a, b, tolerance); h > 0) return step(h);
    double loose = 1;
    for (int i = now_.gliding / kGlideSteps; i > 0 && loose < kLoosest; --i) loose *= 2;
    return step(safeStep(a, b, witness, std::min(loose, kLoosest) * tolerance, end() - now_.time));
  }

  // A body in lasting contact that glides along another one goes on doing so for as long as it is in touch at every one of some
  // times, as the guards of its path are looked at.
  double glidesFor(const PlacedPiece& a, const PlacedPiece& b, double tolerance) const {
    const double spin = a_.spin + b_.spin, left = end() - now_.time, longest = spin > 0 ? std::min(left, 0.5 / spin) : left;
    constexpr int kLooks = 12;
    for (int i = 1; i <= kLooks; ++i) {
      const double t = now_.time + longest * i / kLooks;
      pair_.arc_a.extendTo(t);
      pair_.arc_b.extendTo(t);
      const Placed then_a(*a_.solid, pair_.arc_a, t), then_b(*b_.solid, pair_.arc_b, t);
      const Witness witness = findWitness({&then_a, a.piece}, {&then_b, b.piece}, now_.n);
      if (!(std::abs(witness.separation) <= tolerance)) return longest * (i - 1) / kLooks;
    }
    return longest;
  }

  // The library's direction, if the exact geometry says that the boxes are apart along it.
  std::optional<Witness> candidateWitness(const PlacedPiece& a, const PlacedPiece& b, double tolerance) const {
    if (!a_.solid->box || !b_.solid->box) return std::nullopt;
    const double margin = kGrown * std::min(a_.solid->bound(), b_.solid->bound());
    const auto n = pair_.narrow_phase.candidateNormal(pair_.a, pair_.b, a_, b_, margin);
    if (!n) return std::nullopt;
    const Witness w = witnessAlong(a, b, *n);
    return w.separation > tolerance ? std::optional(w) : std::nullopt;
  }

  // Takes over the earliest impact among the features that touch, if any of them approaches.
  bool impactAtTouch(const PlacedPiece& a, const PlacedPiece& b, const Witness& witness, double tolerance) {
    const double room = std::max(4 * tolerance, std::min(2 * std::abs(witness.separation), kDeepest * tolerance));
    touching_.clear();
    addTouching(a, b, witness, room, touching_);
    bool found = false;
    for (const FeaturePair& f : touching_) {
      const GapOfPair gap(pair_, f, from_, until_, tolerance);
      const Root root = gap.root(now_.time, a_, b_, now_.parted);
      if (root.approaching && isAtGroundSeam(f, root.time, tolerance)) continue;
      if (!root.approaching || (now_.parted && gap.isSlowAt(a_, b_) && isAtSeam(f, room))) continue;
      found = true;
      if (root.time <= until_ && (!first_ || root.time < first_->time)) first_ = PredictedImpact{root.time, f};
    }
    return found;
  }

  // Of fixed bodies that lie flush: as it is when it is met, however deep the search has come since.
  bool isAtGroundSeam(const FeaturePair& f, double time, double tolerance) const {
    if (pair_.ground.bodies.empty()) return false;
    pair_.arc_a.extendTo(time);
    pair_.arc_b.extendTo(time);
    const Placed a(*a_.solid, pair_.arc_a, time), b(*b_.solid, pair_.arc_b, time);
    return isGroundSeam(a, b, f, pair_.ground, kFlush * tolerance);
  }

  // What rolls along a wall does not meet the edges of its parts: it touches the faces on both sides of them.
  bool isAtSeam(const FeaturePair& f, double room) const {
    if (a_.solid->pieces.size() + b_.solid->pieces.size() == 2) return false;
    return isBesideFace(a_, b_, f, touchingFeatures(a_, b_, room), 10 * room);
  }

  const PairMotion& pair_;
  double from_, until_;
  Placed a_, b_, start_a_, start_b_;
  std::optional<PersistentPlanes> held_;
  std::span<const FeaturePair> held_features_;
  bool elsewhere_;  // whether something else holds the body
  int steps_ = 0;
  double placed_at_ = std::numeric_limits<double>::quiet_NaN();
  Pending now_;
  std::priority_queue<Pending> queue_;
  std::vector<FeaturePair> touching_;
  std::optional<PredictedImpact> first_;
};

}  // namespace

std::optional<PredictedImpact> findFirstImpact(const PairMotion& pair, double from, double until,
                                               std::span<const FeaturePair> held,
                                               std::span<const ConstrainedElsewhere> elsewhere) {
  pair.arc_a.extendTo(from);
  pair.arc_b.extendTo(from);
  return Search(pair, from, until, held, elsewhere).run();
}

}  // namespace carom::ode_bridge_detail
