// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tests/pairs/enumerate.h"

namespace carom::pairs {
namespace {

constexpr int kSamples = 48;  // around a rim, before each minimum is refined

// A placed cylinder or cone, and what of it is nearest to a point.
struct Round {
  const Piece* piece;
  int number;
  Vector low, axis;
  Real height;

  Round(const Piece& p, int n)
      : piece(&p),
        number(n),
        low(p.points[0]),
        axis(unit(p.points[1] - p.points[0])),
        height(norm(p.points[1] - p.points[0])) {}

  struct Nearest {
    Vector point;
    FeatureId feature;
    Vector on_feature;  // the point, or for the side its foot on the axis
  };
  bool cone() const { return piece->kind == Piece::Kind::cone; }
  int rims() const { return cone() ? 1 : 2; }
  // In the half plane of p, with r across the axis and z along it: beside the line from the rim to the apex, or not.
  Nearest nearestOnCone(const Vector& p) const {
    const Real z = dot(p - low, axis), slant = std::sqrt(height * height + piece->radius * piece->radius);
    const Vector out = p - low - z * axis;
    const Real r = norm(out), sine = piece->radius / slant, cosine = height / slant;
    const Real up = cosine * z - sine * (r - piece->radius), away = cosine * (r - piece->radius) + sine * z;
    const Vector rim = low + piece->radius / r * out, apex = low + height * axis;
    if (z < 0 && r <= piece->radius) return {low + out, {number, FeatureKind::plane, 0}, low + out};
    if (z < 0 || up < 0) return {rim, {number, FeatureKind::circle, 0}, rim};
    if (up > slant && away > 0) return {apex, {number, FeatureKind::point, 1}, apex};
    const Vector point = away > 0 ? rim + up * (cosine * axis - sine / r * out) : p;
    return {point, {number, FeatureKind::line, 0}, point};
  }
  Nearest nearestTo(const Vector& p) const {
    if (cone()) return nearestOnCone(p);
    const Real along = dot(p - low, axis), z = std::clamp(along, Real(0), height);
    const Vector out = p - low - along * axis, foot = low + z * axis;
    const Real rho = norm(out);
    const bool beyond = along < 0 || along > height, outside = rho > piece->radius;
    const Vector point = outside ? foot + piece->radius / rho * out : foot + out;
    const int cap = along > height / 2 ? 1 : 0;
    if (beyond && outside) return {point, {number, FeatureKind::circle, cap}, point};
    if (beyond) return {point, {number, FeatureKind::plane, cap}, point};
    return {point, {number, FeatureKind::line, 0}, foot};
  }
  Real distanceTo(const Vector& p) const { return norm(p - nearestTo(p).point); }
};

// Zero of an increasing function with f(low) < 0 < f(high), by false position made safe (Illinois), then halving.
template <class Function>
Real zeroBetween(Real low, Real high, const Function& f, Real at_low, Real at_high) {
  const Real fine = 1e-20L + 1e-19L * std::max(std::abs(low), std::abs(high));
  for (int round = 0; round < 200 && high - low > fine; ++round) {
    Real x = low + (high - low) * (-at_low / (at_high - at_low));
    if (round > 60 || !(x > low && x < high)) x = low + (high - low) / 2;
    if (x == low || x == high) break;
    const Real value = f(x);
    if (value == 0) return x;
    if (value < 0) {
      low = x, at_low = value, at_high /= 2;
    } else {
      high = x, at_high = value, at_low /= 2;
    }
  }
  return low + (high - low) / 2;
}

void tell(Candidate c, bool swapped, Collector& out) {
  if (c.distance > out.cutoff) return;
  if (swapped) std::swap(c.a, c.b), std::swap(c.p, c.q);
  out.add(c);
}

// Which way the curves of an edge or a rim and of a rim cross, so that the normal points from b to a.
int sideOf(const Vector& tangent_a, const Vector& tangent_b, const Vector& between) {
  return dot(cross(tangent_a, tangent_b), between) < 0 ? -1 : 1;
}
Vector tangentOf(const Round& r, const Vector& p) { return cross(r.axis, p - r.low); }

// The distance of a segment's points from a convex body is a convex function along it.
void segmentOnRound(const Piece& piece, int i, const Piece::Edge& edge, int index, const Round& round, bool swapped,
                       Collector& out) {
  const Vector p = piece.points[edge.from], d = piece.points[edge.to] - p;
  const Real reach = norm(d) / 2 + piece.radius + out.cutoff;
  if (round.distanceTo(p + 0.5L * d) > reach) return;
  const auto slope = [&](Real t) {
    const Vector at = p + t * d;
    return dot(d, at - round.nearestTo(at).point);
  };
  Real t = 0;
  if (edge.from != edge.to) {
    const Real at_0 = slope(0), at_1 = slope(1);
    t = at_0 >= 0 ? 0 : at_1 <= 0 ? 1 : zeroBetween(Real(0), Real(1), slope, at_0, at_1);
  }
  const Vector at = p + t * d;
  const Round::Nearest near = round.nearestTo(at);
  Candidate c{onSegment(i, edge, index, t), near.feature, norm(at - near.point) - piece.radius, at, near.on_feature, 1};
  if (c.a.kind == FeatureKind::line && c.b.kind != FeatureKind::plane) {
    const Vector other = c.b.kind == FeatureKind::circle ? tangentOf(round, near.point) : round.axis;
    c.side = sideOf(d, other, at - near.point);
  }
  tell(c, swapped, out);
}

// The lowest points of the rims over the faces.
void rimsOnFaces(const Piece& piece, int i, const Round& round, bool swapped, Collector& out) {
  for (int f = 0; f < static_cast<int>(piece.faces.size()); ++f) {
    const Piece::Face& face = piece.faces[f];
    const Vector origin = piece.points[face.at], middle = round.low + round.height / 2 * round.axis;
    const int side = piece.sheet && dot(face.normal, middle - origin) < 0 ? -1 : 1;
    const Vector down = side * across(face.normal, round.axis);
    if (norm(down) < 1e-12L) continue;  // flat on its cap: as near at the borders
    for (int k = 0; k < round.rims(); ++k) {
      const Vector p = round.piece->points[k] - round.piece->radius / norm(down) * down;
      const Real height = side * dot(face.normal, p - origin);
      if (height < 0 || height > out.cutoff || !isOver(piece, face, p)) continue;
      tell({{i, FeatureKind::plane, f},
            {round.number, FeatureKind::circle, k},
            height,
            p - side * height * face.normal,
            p,
            side},
           swapped, out);
    }
  }
}

// The apex of a cone over the faces, each of which may be seen from behind.
void apexOnFaces(const Piece& piece, int i, const Round& round, bool swapped, Collector& out) {
  if (!round.cone()) return;
  const Vector apex = round.piece->points[1];
  for (int f = 0; f < static_cast<int>(piece.faces.size()); ++f) {
    const Piece::Face& face = piece.faces[f];
    const Real height = dot(face.normal, apex - piece.points[face.at]);
    const int side = piece.sheet && height < 0 ? -1 : 1;
    if (side * height < 0 || side * height > out.cutoff || !isOver(piece, face, apex)) continue;
    tell({{i, FeatureKind::plane, f}, {round.number, FeatureKind::point, 1}, side * height, apex - height * face.normal, apex,
          side},
         swapped, out);
  }
}

// The apex of one against another.
void apexOnRound(const Round& a, const Round& b, bool swapped, Collector& out) {
  if (!a.cone()) return;
  const Vector apex = a.piece->points[1];
  const Round::Nearest near = b.nearestTo(apex);
  tell({{a.number, FeatureKind::point, 1}, near.feature, norm(apex - near.point), apex, near.on_feature, 1}, swapped, out);
}

// The sides of two, at least one a cone: a plane that touches both, where the lines of contact cross within them.
void sidesOfCones(const Round& a, const Round& b, Collector& out) {
  const FeatureId of_a{a.number, FeatureKind::line, 0}, of_b{b.number, FeatureKind::line, 0};
  const Feature fa = a.piece->feature(of_a), fb = b.piece->feature(of_b);
  for (const int side : {1, -1}) {
    const auto touch = exact::lineOnCone<Real>(fa, fb, side);
    if (!(touch.gap >= 0)) continue;
    const Vector q = touch.point, p = q + touch.gap * touch.normal;
    const auto within = [](const Round& r, const Vector& x) {
      const Real along = dot(x - r.low, r.axis);
      return along > 0 && along < r.height;
    };
    if (within(a, p) && within(b, q)) tell({of_a, of_b, touch.gap, p, q, side}, false, out);
  }
}

// A rim of one against another: sampled all around, and every minimum refined.
void rimOnRound(const Round& a, int rim, const Round& b, bool swapped, Collector& out) {
  const Feature circle = a.piece->feature({a.number, FeatureKind::circle, rim});
  const Vector other = b.low + b.height / 2 * b.axis;
  Vector towards = other - circle.at;
  if (norm(across(towards, a.axis)) < 1e-9L) towards = exact::unitVector<Real>(std::abs(a.axis[0]) < 0.9L ? 0 : 1);
  const exact::Circle<Real> c(circle, circle.at + towards);
  static const Real step = 2 * std::acos(Real(-1)) / kSamples;
  const auto slope = [&](Real angle) {
    const auto at = c.at(angle);
    return dot(at.rate, at.point - b.nearestTo(at.point).point);
  };
  const Real spacing = circle.radius * step / 2;
  if (b.distanceTo(circle.at) - circle.radius > out.cutoff) return;
  Real slopes[kSamples + 1], distances[kSamples + 1];
  for (int k = 0; k <= kSamples; ++k) {
    const auto at = c.at(k * step);
    const Vector w = at.point - b.nearestTo(at.point).point;
    slopes[k] = dot(at.rate, w), distances[k] = norm(w);
  }
  for (int k = 0; k < kSamples; ++k) {
    if (!(slopes[k] <= 0 && slopes[k + 1] > 0)) continue;
    if (std::min(distances[k], distances[k + 1]) - spacing > out.cutoff) continue;
    const Real angle =
        slopes[k] == 0 ? k * step : zeroBetween(k * step, (k + 1) * step, slope, slopes[k], slopes[k + 1]);
    const Vector p = c.at(angle).point;
    const Round::Nearest near = b.nearestTo(p);
    Candidate found{{a.number, FeatureKind::circle, rim}, near.feature, norm(p - near.point), p, near.on_feature, 1};
    if (near.feature.kind == FeatureKind::circle) {
      const Vector first = tangentOf(a, p), second = tangentOf(b, near.point);
      found.side = sideOf(first, second, p - near.point);
    }
    tell(found, swapped, out);
  }
}

void sidesOfCylinders(const Piece& a, int i, const Piece& b, int j, Collector& out) {
  const Vector d = a.points[1] - a.points[0], e = b.points[1] - b.points[0];
  const auto [s, t] = nearestOnSegments(a.points[0], d, b.points[0], e);
  if (s > 0 && s < 1 && t > 0 && t < 1) {
    const Vector p = a.points[0] + s * d, q = b.points[0] + t * e;
    const int side = dot(cross(d, e), p - q) < 0 ? -1 : 1;
    tell({{i, FeatureKind::line, 0}, {j, FeatureKind::line, 0}, norm(p - q) - a.radius - b.radius, p, q, side}, false,
         out);
  }
}

}  // namespace

void enumerateRound(const Piece& other, int i, const Piece& piece, int j, bool swapped, Collector& out) {
  const Round round(piece, j);
  const std::vector<Piece::Edge>& edges = segmentsOf(other);
  for (int k = 0; k < static_cast<int>(edges.size()); ++k)
    segmentOnRound(other, i, edges[k], k, round, swapped, out);
  rimsOnFaces(other, i, round, swapped, out);
  apexOnFaces(other, i, round, swapped, out);
}

void enumerateRounds(const Piece& a, int i, const Piece& b, int j, Collector& out) {
  const Round first(a, i), second(b, j);
  if (first.cone() || second.cone()) {
    sidesOfCones(first, second, out);
  } else {
    sidesOfCylinders(a, i, b, j, out);
  }
  apexOnRound(first, second, false, out);
  apexOnRound(second, first, true, out);
  for (int rim = 0; rim < first.rims(); ++rim) rimOnRound(first, rim, second, false, out);
  for (int rim = 0; rim < second.rims(); ++rim) rimOnRound(second, rim, first, true, out);
}

}  // namespace carom::pairs
