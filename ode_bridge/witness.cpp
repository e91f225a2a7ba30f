// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_bridge/gjk.hpp"
#include "ode_bridge/near_features.hpp"
#include "ode_bridge/separation.hpp"

// Any direction bounds the distance of two convex pieces from below; the best one equals it. Nearest points find that
// direction while pieces are well apart. Where they nearly touch, nearest points say where but no longer say which way
// (the vector between them is all rounding), and the features that meet there give the direction instead: each is
// tried, and the slab along it decides.

namespace carom::ode_bridge_detail {

namespace {

// Cores nearer than this share of their size are looked at feature by feature.
constexpr double kNear = 0.1;
// Features within this share of the size of a piece from its nearest point are tried; further ones if those explain
// less than the distance that the points have.
constexpr double kAround = 1e-6, kFurtherAround = 1e-2, kEverywhere = 1e100;
constexpr double kRounding = 4e-16;
// A crossed pair has to beat a face by the rounding of its cross product (that over the sine of the angle).
constexpr double kEdgeRounding = 8e-16;

FeaturePair pairOf(GapKind kind, int a, int b, int sign) {
  return {static_cast<std::int16_t>(kind), a, b, static_cast<std::int16_t>(sign)};
}

// The vertex that a support point is; on a frustum the rim, or the apex that takes its place.
FeaturePair facing(const PlacedPiece& p, const Vec3& direction, int face, int sign, bool piece_is_a) {
  const Vec3 local = p.body->k.R.transpose() * direction;
  Family family = Family::vertex;
  int feature;
  if (p.piece->core == Piece::Core::frustum) {
    const bool high = furthestEnd(*p.piece, local) > 0;
    if (high && p.piece->rho_high == 0) {
      feature = p.featuresOf(Family::vertex).back();  // the vertex of a cone that is no mark
    } else {
      family = Family::rim;
      feature = p.featuresOf(Family::rim)[high ? 1 : 0];
    }
  } else {
    const int point = supportOf(p.solid(), *p.piece, local).index - p.piece->points.first;
    feature = p.featuresOf(Family::vertex)[static_cast<std::size_t>(point)];
  }
  return piece_is_a ? pairOf(gapKind(family, Family::face), feature, face, sign)
                    : pairOf(gapKind(Family::face, family), face, feature, sign);
}

class WitnessSearch {
 public:
  WitnessSearch(const PlacedPiece& a, const PlacedPiece& b, const Vec3& guess) : a_(a), b_(b), guess_(guess) {
    best_.separation = -std::numeric_limits<double>::infinity();
  }

  Witness run() {
    const CoreDistance points = nearestPoints();
    const double radii = a_.piece->radius + b_.piece->radius, size = a_.piece->core_radius + b_.piece->core_radius;
    scale_ = size + points.at_a.norm() + points.at_b.norm();
    if (points.upper - radii <= kNear * size) {
      for (const double around : {kAround, kFurtherAround, kEverywhere}) {
        byFeatures(points, around, 1e-3 * points.upper);
        if (best_.separation >= best_.distance - 100 * kRounding * scale_) break;
        if (best_.separation > 1e-9 * scale_) break;  // apart in any case: the features would only lengthen the step
      }
    }
    return decided();
  }

  Witness byPointsAlone() {
    nearestPoints();
    return decided();
  }

 private:
  Vec3 between() const { return a_.body->world(a_.piece->center) - b_.body->world(b_.piece->center); }

  CoreDistance nearestPoints() {
    const CoreDistance points = coreDistance(a_, b_, guess_.isZero(0) ? between() : guess_);
    best_.distance = points.upper - a_.piece->radius - b_.piece->radius;
    if (!points.overlap) byPoints(points);
    return points;
  }

  // The best there is; deep inside each other, any.
  Witness decided() {
    if (!(best_.separation > -std::numeric_limits<double>::infinity())) {
      const double length = between().norm();
      best_.n = length > 0 ? Vec3(between() / length) : Vec3::UnitZ();
      best_.separation = separationAlong(a_, b_, best_.n);
    }
    return best_;
  }

  // Of directions that separate equally but for rounding, that of features is taken, before that of nearest points.
  bool offer(const Vec3& n, Witness::Frame frame, double handicap = 0) {
    const double separation = separationAlong(a_, b_, n);
    if (best_.features.kind < 0) handicap = -10 * kRounding * scale_;
    if (!(separation > best_.separation + handicap)) return false;
    best_.n = n;
    best_.separation = separation;
    best_.frame = frame;
    best_.features = {};
    return true;
  }

  // A direction between nearest points turns with the body of the longer feature that they lie on.
  void byPoints(const CoreDistance& points) {
    const auto different = [&](const std::array<Vec3, 4>& of) {
      int n = 0;
      for (int i = 0; i < points.count; ++i) {
        bool seen = false;
        for (int j = 0; j < i; ++j) seen = seen || of[static_cast<std::size_t>(i)] == of[static_cast<std::size_t>(j)];
        n += !seen;
      }
      return n;
    };
    using Frame = Witness::Frame;
    const int on_a = different(points.of_a), on_b = different(points.of_b);
    Frame frame = Frame::world;
    if (a_.piece->core != Piece::Core::frustum && b_.piece->core != Piece::Core::frustum) {
      if (on_a == 1 && on_b > 1) frame = Frame::body_b;
      if (on_b == 1 && on_a > 1) frame = Frame::body_a;
      if (points.count == 3 && on_a == 2 && on_b == 2) frame = Frame::crossed;
    }
    if (!offer(points.normal, frame) || frame != Frame::crossed) return;
    best_.edge_a = spread(points.of_a);
    best_.edge_b = spread(points.of_b);
  }
  static Vec3 spread(const std::array<Vec3, 4>& of) {
    return (of[1] != of[0] ? Vec3(of[1] - of[0]) : Vec3(of[2] - of[0])).normalized();
  }

  void byFeatures(const CoreDistance& points, double around, double further) {
    const auto near = [&](const PlacedPiece& p, const Vec3& at) {
      const Vec3 local = p.body->k.R.transpose() * (at - (p.body->k.x - b_.body->k.x));
      return featuresNear(p.solid(), *p.piece, local, around * p.piece->core_radius + further);
    };
    const NearFeatures of_a = near(a_, points.at_a), of_b = near(b_, points.at_b);
    for (const auto& g : of_b)
      if (g.family == Family::face) face(b_, a_, g.index);
    for (const auto& f : of_a)
      if (f.family == Family::face) face(a_, b_, f.index);
    for (const auto& f : of_a)
      for (const auto& g : of_b)
        if (f.family != Family::face && g.family != Family::face) crossing(f, g);
  }

  void face(const PlacedPiece& of, const PlacedPiece& other, int f) {
    const bool of_b = &of == &b_;
    const SolidFace& face = of.solid().faces[static_cast<std::size_t>(f)];
    for (int sign = 1; sign >= (face.open ? -1 : 1); sign -= 2) {
      const Vec3 outward = sign * (of.body->k.R * face.direction);
      if (offer(of_b ? outward : Vec3(-outward), of_b ? Witness::Frame::body_b : Witness::Frame::body_a))
        best_.features = facing(other, -outward, f, sign, of_b);
    }
  }

  // Edges, rims and swept vertices.
  void crossing(const FeatureName& f, const FeatureName& g) {
    if (!hasKind(f.family, g.family)) return;
    const Feature &fa = a_.solid().feature(f.family, f.index), &fb = b_.solid().feature(g.family, g.index);
    const bool vertex = f.family == Family::vertex || g.family == Family::vertex;
    if (vertex && !isSwept(fa) && !isSwept(fb)) return;  // sharp points meet in no general way
    const GapKind kind = gapKind(f.family, g.family);
    const WorldFeature wa = placeFeature(fa, {a_.body->k.x, a_.body->k.R}),
                       wb = placeFeature(fb, {b_.body->k.x, b_.body->k.R});
    const double scale = a_.piece->core_radius + b_.piece->core_radius + (wa.point - wb.point).norm();
    const bool tapered = fa.apex > 0 || fb.apex > 0;
    double handicap = 0;
    const bool edges = f.family == Family::edge && g.family == Family::edge;
    const Vec3 crossed = wa.direction.cross(wb.direction);
    if (edges && !tapered) {
      const double sine = crossed.norm();
      if (!(sine > 1e-14)) return;
      handicap = kEdgeRounding * scale / sine;
    }
    for (int branch = 1; branch <= branches(kind); ++branch)
      for (const int sign : {branch, -branch}) {
        const ContactPoint c = contactOf(kind, wa, wb, sign);
        if (edges && tapered) handicap = kEdgeRounding * scale / std::abs(crossed.dot(c.normal));
        if (!std::isfinite(c.gap) || !offer(c.normal, frameOf(f.family, g.family, tapered), handicap)) continue;
        best_.features = pairOf(kind, f.index, g.index, sign);
        if (edges) best_.edge_a = wa.direction, best_.edge_b = wb.direction;
      }
  }

  // What is normal to two edges stays so as they turn; to tapered ones it keeps its angles.
  static Witness::Frame frameOf(Family a, Family b, bool tapered) {
    if (a == Family::edge && b == Family::edge) return tapered ? Witness::Frame::tapered : Witness::Frame::crossed;
    if (b == Family::edge) return Witness::Frame::body_b;
    if (a == Family::edge) return Witness::Frame::body_a;
    return Witness::Frame::world;
  }

  PlacedPiece a_, b_;
  Vec3 guess_;
  Witness best_;
  double scale_ = 0;
};

// A half space has one direction.
Witness againstPlane(const PlacedPiece& a, const PlacedPiece& plane) {
  Witness w;
  w.frame = Witness::Frame::body_b;
  w.n = plane.body->k.R * plane.solid().faces[0].direction;
  w.separation = w.distance = separationAlong(a, plane, w.n);
  w.features = facing(a, -w.n, 0, 1, true);
  return w;
}

Witness swapped(Witness w) {
  w.n = -w.n;
  w.frame = w.frame == Witness::Frame::body_b ? Witness::Frame::body_a : w.frame;
  const auto kind = static_cast<GapKind>(w.features.kind);
  w.features.kind = gapKind(familyOfSecond(kind), familyOfFirst(kind));
  std::swap(w.features.a, w.features.b);
  return w;
}

Witness ballBall(const PlacedPiece& a, const PlacedPiece& b) {
  Witness w;
  const Vec3 D = a.body->world(a.piece->center) - b.body->world(b.piece->center);
  const double distance = D.norm();
  w.n = distance > 0 ? Vec3(D / distance) : Vec3::UnitZ();
  w.separation = w.distance = distance - a.piece->radius - b.piece->radius;
  w.features = pairOf(kPointPoint, a.featuresOf(Family::vertex)[0], b.featuresOf(Family::vertex)[0], 1);
  return w;
}

}  // namespace

Witness witnessAlong(const PlacedPiece& a, const PlacedPiece& b, const Vec3& n) {
  Witness w;
  w.n = n;
  w.separation = separationAlong(a, b, n);
  return w;
}

Witness findDirection(const PlacedPiece& a, const PlacedPiece& b) { return WitnessSearch(a, b, Vec3::Zero()).byPointsAlone(); }

Witness findWitness(const PlacedPiece& a, const PlacedPiece& b, const Vec3& guess) {
  if (b.halfSpace()) return againstPlane(a, b);
  if (a.halfSpace()) return swapped(againstPlane(b, a));
  if (a.piece->core == Piece::Core::point && b.piece->core == Piece::Core::point) return ballBall(a, b);
  return WitnessSearch(a, b, guess).run();
}

}  // namespace carom::ode_bridge_detail
