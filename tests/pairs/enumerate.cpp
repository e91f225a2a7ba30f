// SPDX-License-Identifier: MIT
#include "tests/pairs/enumerate.h"

#include <algorithm>
#include <cmath>

namespace carom::pairs {
namespace {

// Points of a against faces of b.
void pointsOnFaces(const Piece& a, int i, const Piece& b, int j, bool swapped, Collector& out) {
  for (int f = 0; f < static_cast<int>(b.faces.size()); ++f) {
    const Piece::Face& face = b.faces[f];
    for (int k = 0; k < static_cast<int>(a.points.size()); ++k) {
      Real height = dot(face.normal, a.points[k] - b.points[face.at]);
      const int side = b.sheet && height < 0 ? -1 : 1;
      height *= side;
      if (height < 0 && b.kind != Piece::Kind::half_space) continue;
      if (height - a.radius > out.cutoff || !isOver(b, face, a.points[k])) continue;
      const Vector foot = a.points[k] - side * height * face.normal;
      Candidate c{{i, FeatureKind::point, k}, {j, FeatureKind::plane, f}, height - a.radius, a.points[k], foot, side};
      if (swapped) std::swap(c.a, c.b), std::swap(c.p, c.q);
      out.add(c);
    }
  }
}

void rimsOnHalfSpace(const Piece& round, int i, const Piece& half_space, int j, bool swapped, Collector& out) {
  const Piece::Face& face = half_space.faces[0];
  const Vector axis = unit(round.points[1] - round.points[0]), down = across(face.normal, axis);
  for (int k = 0; k < 2; ++k) {
    const bool apex = k == 1 && round.kind == Piece::Kind::cone;
    const Vector p = apex ? round.points[k] : round.points[k] - round.radius / norm(down) * down;
    const Real height = dot(face.normal, p - half_space.points[0]);
    if (height > out.cutoff) continue;
    Candidate c{{i, apex ? FeatureKind::point : FeatureKind::circle, k}, {j, FeatureKind::plane, 0}, height, p, p - height * face.normal, 1};
    if (swapped) std::swap(c.a, c.b), std::swap(c.p, c.q);
    out.add(c);
  }
}

void segmentsOnSegments(const Piece& a, int i, const Piece& b, int j, Collector& out) {
  const std::vector<Piece::Edge>&first = segmentsOf(a), &second = segmentsOf(b);
  struct Held {
    Vector p, d, middle;
    Real half;
  };
  const auto hold = [](const Piece& piece, const Piece::Edge& e) {
    const Vector p = piece.points[e.from], d = piece.points[e.to] - p;
    return Held{p, d, p + 0.5L * d, norm(d) / 2};
  };
  static thread_local std::vector<Held> held;  // kept, as this runs for millions of triangles
  held.clear();
  for (const Piece::Edge& e : second) held.push_back(hold(b, e));
  const Real radius = a.radius + b.radius;
  for (int k = 0; k < static_cast<int>(first.size()); ++k) {
    const Held x = hold(a, first[k]);
    for (int l = 0; l < static_cast<int>(second.size()); ++l) {
      const Held& y = held[l];
      const Vector apart = x.middle - y.middle;
      const Real far = x.half + y.half + radius + out.cutoff;
      if (far < 0 || dot(apart, apart) > far * far) continue;
      const auto [s, t] = nearestOnSegments(x.p, x.d, y.p, y.d);
      const Vector p = x.p + s * x.d, q = y.p + t * y.d;
      const Real distance = norm(p - q) - radius;
      if (distance > out.cutoff) continue;
      const int side = dot(cross(x.d, y.d), p - q) < 0 ? -1 : 1;
      out.add({onSegment(i, first[k], k, s), onSegment(j, second[l], l, t), distance, p, q, side});
    }
  }
}

}  // namespace

const std::vector<Piece::Edge>& segmentsOf(const Piece& piece) {
  static const std::vector<Piece::Edge> lone_point = {{0, 0}};
  return piece.edges.empty() ? lone_point : piece.edges;
}

FeatureId onSegment(int piece, const Piece::Edge& edge, int index, Real parameter) {
  if (edge.from == edge.to || parameter <= 0) return {piece, FeatureKind::point, edge.from};
  if (parameter >= 1) return {piece, FeatureKind::point, edge.to};
  return {piece, FeatureKind::line, index};
}

bool isOver(const Piece& piece, const Piece::Face& face, const Vector& p) {
  const std::size_t n = face.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector &from = piece.points[face.corners[i]], &to = piece.points[face.corners[(i + 1) % n]];
    if (dot(cross(to - from, p - from), face.normal) < 0) return false;
  }
  return true;
}

// Minimises |p + s d - q - t e|^2 over the unit square: the free minimum, or the best of the four borders.
SegmentPair nearestOnSegments(const Vector& p, const Vector& d, const Vector& q, const Vector& e) {
  const Vector between = p - q;
  const Real a = dot(d, d), b = dot(d, e), c = dot(e, e), f = dot(d, between), g = dot(e, between);
  const auto clamp = [](Real x) { return std::clamp(x, Real(0), Real(1)); };
  const Real determinant = a * c - b * b;
  if (determinant > 1e-30L * a * c) {
    const Real s = (b * g - c * f) / determinant, t = (a * g - b * f) / determinant;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return {s, t};
  }
  SegmentPair best{0, 0};
  Real least = -1;
  const auto look = [&](Real s, Real t) {
    const Vector w = between + s * d - t * e;
    const Real square = dot(w, w);
    if (least < 0 || square < least) least = square, best = {s, t};
  };
  for (const Real end : {Real(0), Real(1)}) {
    look(a > 0 ? clamp((b * end - f) / a) : 0, end);
    look(end, c > 0 ? clamp((b * end + g) / c) : 0);
  }
  return best;
}

void enumerate(const Piece& a, int i, const Piece& b, int j, Collector& out) {
  using Kind = Piece::Kind;
  if (b.kind == Kind::half_space || a.kind == Kind::half_space) {
    const bool swapped = a.kind == Kind::half_space;
    const Piece &piece = swapped ? b : a, &half_space = swapped ? a : b;
    const int k = swapped ? j : i, l = swapped ? i : j;
    if (isRound(piece))
      rimsOnHalfSpace(piece, k, half_space, l, swapped, out);
    else
      pointsOnFaces(piece, k, half_space, l, swapped, out);
    return;
  }
  if (isRound(a) && isRound(b)) return enumerateRounds(a, i, b, j, out);
  if (isRound(b)) return enumerateRound(a, i, b, j, false, out);
  if (isRound(a)) return enumerateRound(b, j, a, i, true, out);
  segmentsOnSegments(a, i, b, j, out);
  pointsOnFaces(a, i, b, j, false, out);
  pointsOnFaces(b, j, a, i, true, out);
}

}  // namespace carom::pairs
