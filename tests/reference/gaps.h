// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/reference/numbers.h"

namespace carom::reference {

/// A part of a shape's surface in its own frame: for a box, sign[i] = +-1 where coordinate i is at its bound and 0
/// where it is free, so that one, two or three signs are a face, an edge or a vertex. Unused by spheres and planes.
struct Feature {
  std::array<int, 3> sign{};
  int count() const { return (sign[0] != 0) + (sign[1] != 0) + (sign[2] != 0); }
  bool operator==(const Feature&) const = default;
};

struct Features {
  Feature a, b;
  int side = 1;  ///< edge-edge: sign that makes the cross product of the edges point from b to a
};

/// Where a body is, and its shape.
struct Placed {
  const BodyNumbers* body;
  RVec x;
  RMat R;  ///< shape to world

  RVec corner(const Feature& f) const {
    return x + R * RVec{f.sign[0] * body->size[0] / 2, f.sign[1] * body->size[1] / 2, f.sign[2] * body->size[2] / 2};
  }
  /// Outward normal of a face, or direction of an edge (the axis that is free).
  RVec faceNormal(const Feature& f) const {
    for (int i = 0; i < 3; ++i) {
      if (f.sign[i] != 0) return Real(f.sign[i]) * R.column[i];
    }
    throw std::logic_error("not a face");
  }
  RVec edgeDirection(const Feature& f) const {
    for (int i = 0; i < 3; ++i) {
      if (f.sign[i] == 0) return R.column[i];
    }
    throw std::logic_error("not an edge");
  }
};

/// Gap, normal from b to a, contact point.
struct Touch {
  Real gap;
  RVec normal, point;
};

inline Touch pointOnPlane(const RVec& p, const Real& radius, const RVec& origin, const RVec& n) {
  return {dot(n, p - origin) - radius, n, p - radius * n};
}
inline Touch pointOnPoint(const RVec& p, const Real& radius, const RVec& q, const Real& q_radius) {
  const Real distance = norm(p - q);
  const RVec n = (1 / distance) * (p - q);
  return {distance - radius - q_radius, n, q + q_radius * n};
}
inline Touch pointOnEdge(const RVec& p, const Real& radius, const RVec& origin, const RVec& direction) {
  return pointOnPoint(p, radius, origin + dot(direction, p - origin) * direction, 0);
}
inline Touch edgeOnEdge(const RVec& p, const RVec& d, const RVec& q, const RVec& e, int side) {
  const RVec w = cross(d, e), n = (side / norm(w)) * w, between = p - q;
  // foot on q + t e: between + s d - t e parallel to n
  const Real t = dot(cross(between, d), cross(e, d)) / dot(w, w);
  return {dot(n, between), n, q + t * e};
}

inline Touch flipped(Touch t) { return {t.gap, -t.normal, t.point}; }

/// Gap of the frozen features of two placed shapes.
inline Touch touchOf(const Placed& A, const Placed& B, const Features& f) {
  using Kind = BodyNumbers::Kind;
  const Kind a = A.body->kind, b = B.body->kind;
  if (a > b) return flipped(touchOf(B, A, {f.b, f.a, f.side}));  // order: sphere, box, plane
  if (b == Kind::plane) {
    const RVec n = B.R * B.body->plane_normal, origin = B.x + B.body->plane_offset * n;
    return a == Kind::sphere ? pointOnPlane(A.x, A.body->size[0], origin, n)
                             : pointOnPlane(A.corner(f.a), 0, origin, n);
  }
  if (b == Kind::sphere) return pointOnPoint(A.x, A.body->size[0], B.x, B.body->size[0]);
  const RVec corner_b = B.corner(f.b);
  if (a == Kind::sphere) {
    const Real& radius = A.body->size[0];
    if (f.b.count() == 1) return pointOnPlane(A.x, radius, corner_b, B.faceNormal(f.b));
    if (f.b.count() == 2) return pointOnEdge(A.x, radius, corner_b, B.edgeDirection(f.b));
    return pointOnPoint(A.x, radius, corner_b, 0);
  }
  const RVec corner_a = A.corner(f.a);
  if (f.a.count() == 3 && f.b.count() == 1) return pointOnPlane(corner_a, 0, corner_b, B.faceNormal(f.b));
  if (f.a.count() == 1 && f.b.count() == 3) return flipped(pointOnPlane(corner_b, 0, corner_a, A.faceNormal(f.a)));
  if (f.a.count() == 2 && f.b.count() == 2) {
    return edgeOnEdge(corner_a, A.edgeDirection(f.a), corner_b, B.edgeDirection(f.b), f.side);
  }
  throw std::runtime_error("the reference has no gap for these features of two boxes");
}

inline std::string nameOf(const BodyNumbers& body, const Feature& f) {
  if (body.kind == BodyNumbers::Kind::sphere) return "sphere";
  if (body.kind == BodyNumbers::Kind::plane) return "plane";
  std::string name = f.count() == 1 ? "face " : f.count() == 2 ? "edge " : "vertex ";
  for (int sign : f.sign) name += sign > 0 ? '+' : sign < 0 ? '-' : '0';
  return name;
}

}  // namespace carom::reference
