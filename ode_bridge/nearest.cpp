// SPDX-License-Identifier: MIT
#include "ode_bridge/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "adjoint/base/arguments.hpp"
#include "ode_bridge/depth.hpp"
#include "ode_bridge/gjk.hpp"
#include "ode_bridge/near_features.hpp"
#include "ode_bridge/overlap.hpp"
#include "ode_bridge/touching.hpp"

// An iteration of support points finds the nearest points of two convex pieces; the features that pass there are tried.
// Any direction bounds the distance from below, so that the pair of features whose normal separates the pieces
// furthest, by no less than its own gap, is the one that they are nearest at.

namespace carom::ode_bridge_detail {

using adjoint_detail::Nearest;

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kRoundingOfGaps = 4e-16;
// Shares of the sizes and distances, about the nearest points, within which features are tried: those of polytopes lie
// there to rounding, those of what is round only roughly.
constexpr double kAroundNearest[] = {1e-7, 1e-3, 1e100};
// Nearest points of what is round are known to this share.
constexpr double kLoose = 1e-7;
// Places whose distances differ by less than this share of what they are worked out from are equally near.
constexpr double kEqual = 1e-13;

class PiecePlaces {
 public:
  PiecePlaces(const PlacedPiece& a, const PlacedPiece& b, const PieceDistance& points, double scale,
              std::vector<NearPlace>& out)
      : a_(a), b_(b), points_(points), room_(32 * kRoundingOfGaps * scale), out_(out) {}

  void find() {
    if (a_.halfSpace() || b_.halfSpace()) {
      beforePlane();
      out_.insert(out_.end(), own_.begin(), own_.end());
      return;
    }
    for (const double around : kAroundNearest) {
      const NearFeatures of_a = near(a_, points_.at_a, around), of_b = near(b_, points_.at_b, around);
      for (const FeatureName& f : of_a)
        for (const FeatureName& g : of_b) tryPair(f, g, false);
      if (!isProven() && around > 1) flatRims(of_a, of_b);
      if (isProven()) break;
    }
    // those that separate less are not where the pieces are nearest
    const double furthest = furthestApart();
    std::erase_if(own_, [&](const NearPlace& p) { return !isProven() || p.separation < furthest - room_; });
    out_.insert(out_.end(), own_.begin(), own_.end());
  }

 private:
  double furthestApart() const {
    double furthest = -kUnbounded;
    for (const NearPlace& p : own_) furthest = std::max(furthest, p.separation);
    return furthest;
  }
  // Two points of the pieces are no further from each other than a pair of features says.
  bool isProven() const {
    const double size = a_.piece->core_radius + b_.piece->core_radius + std::abs(points_.upper);
    return !own_.empty() && furthestApart() >= points_.upper - kLoose * size;
  }

  NearFeatures near(const PlacedPiece& p, const Vec3& at, double around) const {
    const Vec3 local = p.body->k.R.transpose() * (at - p.body->k.x);
    const double size = a_.piece->core_radius + b_.piece->core_radius + std::max(0.0, points_.upper);
    const bool round = a_.piece->core == Piece::Core::frustum || b_.piece->core == Piece::Core::frustum;
    return featuresNear(p.solid(), *p.piece, local, (round ? std::max(around, kAroundNearest[1]) : around) * size);
  }

  // A rim that lies flat before a face has no nearest point of its own.
  void flatRims(const NearFeatures& of_a, const NearFeatures& of_b) {
    for (int v : a_.featuresOf(Family::vertex))
      for (const FeatureName& g : of_b)
        if (g.family == Family::face) tryPair({Family::vertex, v}, g, true);
    for (int v : b_.featuresOf(Family::vertex))
      for (const FeatureName& f : of_a)
        if (f.family == Family::face) tryPair(f, {Family::vertex, v}, true);
  }

  // Everything that stands out furthest towards the half space.
  void beforePlane() {
    const bool plane_is_a = a_.halfSpace();
    const PlacedPiece& p = plane_is_a ? b_ : a_;
    const FeatureName face{Family::face, 0};
    for (const bool marks : {false, true})
      for (const Family family : {Family::vertex, Family::rim}) {
        if (!own_.empty() && marks) break;
        for (int i : p.featuresOf(family)) {
          if (family == Family::vertex && p.solid().feature(family, i).mark != marks) continue;
          if (plane_is_a) tryPair(face, {family, i}, marks);
          else tryPair({family, i}, face, marks);
        }
      }
  }

  bool isOpen(const PlacedPiece& p, const FeatureName& f) const {
    return f.family == Family::face && p.solid().faces[static_cast<std::size_t>(f.index)].open;
  }

  void tryPair(const FeatureName& f, const FeatureName& g, bool mark) {
    if (!hasKind(f.family, g.family)) return;
    const GapKind kind = gapKind(f.family, g.family);
    const Feature &fa = a_.solid().feature(f.family, f.index), &fb = b_.solid().feature(g.family, g.index);
    const WorldFeature wa = placeFeature(fa, {a_.body->k.x, a_.body->k.R}),
                       wb = placeFeature(fb, {b_.body->k.x, b_.body->k.R});
    const bool face = f.family == Family::face || g.family == Family::face;
    const bool sharp_curves = branches(kind) == 2 && !isSwept(fa) && !isSwept(fb);
    const bool one_sign = face ? !isOpen(a_, f) && !isOpen(b_, g) : sharp_curves;
    for (int place = 1; place <= branches(kind); ++place)
      for (const int side : {1, -1}) {
        if (side < 0 && one_sign) continue;
        const int sign = side * (sharp_curves ? place + 2 : place);
        const ContactPoint c = contactOf(kind, wa, wb, sign);
        if (!std::isfinite(c.gap) || !c.normal.allFinite() || !c.point.allFinite()) continue;
        if (!(c.gap > -a_.piece->radius - b_.piece->radius)) continue;
        keep({static_cast<std::int16_t>(kind), f.index, g.index, static_cast<std::int16_t>(sign)}, c, mark, f, g);
      }
  }

  void keep(const FeaturePair& features, const ContactPoint& c, bool mark, const FeatureName& f, const FeatureName& g) {
    const double separation = separationAlong(a_, b_, c.normal);
    // the lines through edges may come nearer than the edges, and the normal of a crossing is as good as its sine
    if (!(separation >= c.gap - room_)) return;
    if (!(c.gap >= points_.lower - room_) || !(c.gap <= points_.upper + room_)) return;
    if (!onFeature(a_, f, c) || !onFeature(b_, g, c)) return;
    own_.push_back({features, c, separation, mark});
  }

  // Whether a witness lies on a face or an edge itself, not on its continuation.
  bool onFeature(const PlacedPiece& p, const FeatureName& f, const ContactPoint& c) const {
    const Solid& solid = p.solid();
    const Vec3 local = p.body->k.R.transpose() * (c.point - p.body->k.x);
    const double room = 1e-9 * p.coreRadius() + room_;
    if (f.family == Family::face) {
      const SolidFace& face = solid.faces[static_cast<std::size_t>(f.index)];
      return (face.count == 0 && face.disc == 0) || outsideFace(solid, face, local) <= room;
    }
    if (f.family != Family::edge) return true;
    const SolidEdge& edge = solid.edges[static_cast<std::size_t>(f.index)];
    if (isSwept(edge) && edge.apex > 0) return true;
    const Vec3 n = p.body->k.R.transpose() * c.normal;
    const double lean = std::abs(edge.direction.dot(n)) * (c.gap + edge.radius);  // the point may be the other body's
    return std::abs(edge.direction.dot(local - edge.point)) <= edge.half_length + lean + room;
  }

  PlacedPiece a_, b_;
  PieceDistance points_;
  double room_;
  std::vector<NearPlace>& out_;
  std::vector<NearPlace> own_;  // of these pieces
};

struct NearPair {
  PlacedPiece a, b;
  PieceDistance distance;
  std::optional<Depth> depth;  // where the cores overlap
};

// The pieces that may hold the nearest points.
class NearPairs {
 public:
  NearPairs(const Placed& a, const Placed& b, WhereOverlapping overlap) : a_(a), b_(b), overlap_(overlap) {
    visit(0, 0);
  }

  double upper() const { return upper_; }
  std::vector<NearPair> within(double room) {
    std::erase_if(pairs_, [&](const NearPair& p) { return !(p.distance.lower <= upper_ + room); });
    return std::move(pairs_);
  }

 private:
  const Node& nodeOf(const Placed& p, int i) const { return p.solid->nodes[static_cast<std::size_t>(i)]; }
  double apart(int i, int j) const {
    return separationOf(PlacedNode{&a_, &nodeOf(a_, i)}, PlacedNode{&b_, &nodeOf(b_, j)});
  }

  void visit(int i, int j) {
    const Node &na = nodeOf(a_, i), &nb = nodeOf(b_, j);
    if (na.piece >= 0 && nb.piece >= 0) {
      const PlacedPiece p{&a_, &a_.solid->pieces[static_cast<std::size_t>(na.piece)]},
          q{&b_, &b_.solid->pieces[static_cast<std::size_t>(nb.piece)]};
      pairs_.push_back({p, q, pieceDistance(p, q), std::nullopt});
      NearPair& pair = pairs_.back();
      if (overlap_ == WhereOverlapping::depth && (pair.depth = depthOf(p, q)))
        pair.distance.lower = pair.distance.upper = pair.depth->separation;
      upper_ = std::min(upper_, pair.distance.upper);
      return;
    }
    const bool first = nb.piece >= 0 || (na.piece < 0 && na.radius >= nb.radius);
    const Node& opened = first ? na : nb;
    int left = opened.left, right = opened.right;
    double to_left = first ? apart(left, j) : apart(i, left), to_right = first ? apart(right, j) : apart(i, right);
    if (to_right < to_left) std::swap(left, right), std::swap(to_left, to_right);
    for (const auto& [child, least] : {std::pair{left, to_left}, std::pair{right, to_right}}) {
      if (least > upper_ + 1e-9 * (std::abs(upper_) + std::abs(least))) continue;
      if (first) visit(child, j);
      else visit(i, child);
    }
  }

  const Placed &a_, &b_;
  WhereOverlapping overlap_;
  double upper_ = kUnbounded;
  std::vector<NearPair> pairs_;
};

double scaleOfPair(const Placed& a, const Placed& b, double gap) {
  double scale = std::abs(gap) + a.k.x.norm() + b.k.x.norm();
  for (const Placed* p : {&a, &b}) scale += p->solid->plane ? p->solid->faces[0].point.norm() : p->solid->bound();
  return scale;
}

bool samePlace(const NearPlace& p, const NearPlace& q, double size) {
  return (p.at.normal - q.at.normal).norm() <= 1e-7 &&
         (p.at.point - q.at.point).cross(p.at.normal).norm() <= 1e-7 * size;
}

}  // namespace

PieceDistance pieceDistance(const PlacedPiece& a, const PlacedPiece& b) {
  PieceDistance d;
  if (a.halfSpace() || b.halfSpace()) {
    d.upper = d.lower = findWitness(a, b).separation;
    return d;
  }
  const double radii = a.piece->radius + b.piece->radius;
  const Vec3 between = a.body->world(a.piece->center) - b.body->world(b.piece->center);
  const CoreDistance points = coreDistance(a, b, between.isZero(0) ? Vec3::UnitZ() : between);
  d.upper = points.upper - radii;
  d.lower = (points.overlap ? 0 : points.lower) - radii;
  d.at_a = b.body->k.x + points.at_a;
  d.at_b = b.body->k.x + points.at_b;
  return d;
}

Nearest nearestOf(const Placed& a, const Placed& b, WhereOverlapping overlap) {
  NearPairs pairs(a, b, overlap);
  const double scale = scaleOfPair(a, b, pairs.upper()), touch = 4 * touchTolerance(a, b);
  Nearest out;
  if (overlap == WhereOverlapping::nothing &&
      (!(pairs.upper() > touch) ||
       ((a.solid->closed_mesh || b.solid->closed_mesh) && overlapOf(a, b, touchTolerance(a, b))))) {
    out.gap = 0;
    return out;
  }
  std::vector<NearPlace> places;
  for (NearPair& pair : pairs.within(kEqual * scale)) {
    if (pair.depth) {
      places.insert(places.end(), pair.depth->places.begin(), pair.depth->places.end());
    } else {
      PiecePlaces(pair.a, pair.b, pair.distance, scale, places).find();
    }
  }
  const auto best = std::min_element(places.begin(), places.end(), [](const NearPlace& p, const NearPlace& q) {
    return p.mark != q.mark ? q.mark : p.at.gap < q.at.gap;
  });
  out.gap = pairs.upper();
  if (best == places.end()) return out;
  out.gap = best->at.gap;
  out.features = best->features;
  out.normal = best->at.normal;
  const double size = std::min(a.solid->bound(), b.solid->bound());
  out.several = best->mark || std::any_of(places.begin(), places.end(), [&](const NearPlace& p) {
    return p.at.gap <= best->at.gap + kEqual * scale && !samePlace(p, *best, size);
  });
  return out;
}

double gapRateOf(const Placed& a, const Placed& b, const FeaturePair& features) {
  const ContactPoint c = contactAt(a, b, features);
  return c.normal.dot(a.k.v + a.k.w.cross(c.point - a.k.x) - b.k.v - b.k.w.cross(c.point - b.k.x));
}

}  // namespace carom::ode_bridge_detail

namespace carom {

using namespace ode_bridge_detail;

adjoint_detail::Nearest FeatureGeometry::nearest(int a, int b, const Pose& A, const Pose& B) const {
  for (int body : {a, b}) adjoint_detail::checkedIndex("nearest", "body", body, solids_.size());
  return nearestOf(Placed(solid(a), A.x, A.R), Placed(solid(b), B.x, B.R));
}

std::optional<adjoint_detail::NearestInTime> FeatureGeometry::nearestInTime(int a, int b, const Arc& arc_a,
                                                                            const Arc& arc_b, double from, double to,
                                                                            double under) const {
  for (int body : {a, b}) adjoint_detail::checkedIndex("nearestInTime", "body", body, solids_.size());
  for (double t : {from, to}) adjoint_detail::checkedNumber("nearestInTime", "the time", t);
  return nearestInTimeOf(solid(a), solid(b), arc_a, arc_b, from, to, under);
}

adjoint_detail::Nearest FeatureGeometry::separation(int a, int b, const Pose& A, const Pose& B) const {
  for (int body : {a, b}) adjoint_detail::checkedIndex("separation", "body", body, solids_.size());
  return nearestOf(Placed(solid(a), A.x, A.R), Placed(solid(b), B.x, B.R), WhereOverlapping::depth);
}

std::optional<adjoint_detail::NearestInTime> FeatureGeometry::leastSeparation(int a, int b, const Arc& arc_a,
                                                                              const Arc& arc_b, double from, double to,
                                                                              double under) const {
  for (int body : {a, b}) adjoint_detail::checkedIndex("leastSeparation", "body", body, solids_.size());
  for (double t : {from, to}) adjoint_detail::checkedNumber("leastSeparation", "the time", t);
  return nearestInTimeOf(solid(a), solid(b), arc_a, arc_b, from, to, under, WhereOverlapping::depth);
}

}  // namespace carom
