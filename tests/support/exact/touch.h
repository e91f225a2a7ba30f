// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "tests/support/exact/pieces.h"

namespace carom::exact {

/// Gap, unit normal from b to a, and contact point (on b).
template <class T>
struct Touch {
  T gap = 0;
  Vec<T> normal, point;
};
template <class T>
Touch<T> flipped(const Touch<T>& t) {
  return {t.gap, -t.normal, t.point};
}

template <class T>
Touch<T> pointOnPlane(const Vec<T>& p, const Number<T>& radius, const Vec<T>& origin, const Vec<T>& n) {
  return {dot(n, p - origin) - radius, n, p - radius * n};
}
template <class T>
Touch<T> pointOnPoint(const Vec<T>& p, const Number<T>& radius, const Vec<T>& q, const Number<T>& q_radius) {
  const T distance = norm(p - q);
  const Vec<T> n = (1 / distance) * (p - q);
  return {distance - radius - q_radius, n, q + q_radius * n};
}
template <class T>
Touch<T> pointOnLine(const Vec<T>& p, const Number<T>& radius, const Vec<T>& origin, const Vec<T>& direction,
                     const Number<T>& line_radius) {
  return pointOnPoint<T>(p, radius, origin + dot(direction, p - origin) * direction, line_radius);
}

/// Two curves that cross at right angles to their connection, at p with tangent d and at q with tangent e. The gap goes
/// through zero smoothly, `side` says on which side of b the curve of a is.
template <class T>
Touch<T> curveOnCurve(const Vec<T>& p, const Vec<T>& d, const Number<T>& radius, const Vec<T>& q, const Vec<T>& e,
                      const Number<T>& q_radius, int side) {
  const Vec<T> w = cross(d, e), n = (side / norm(w)) * w;
  return {dot(n, p - q) - radius - q_radius, n, q + q_radius * n};
}
template <class T>
Touch<T> lineOnLine(const Feature<T>& a, const Feature<T>& b, int side) {
  const Vec<T> w = cross(a.along, b.along), between = a.at - b.at;
  // feet where between + s d - t e is parallel to w
  const T s = dot(cross(between, b.along), cross(b.along, a.along)) / dot(w, w);
  const T t = dot(cross(between, a.along), cross(b.along, a.along)) / dot(w, w);
  return curveOnCurve<T>(a.at + s * a.along, a.along, a.radius, b.at + t * b.along, b.along, b.radius, side);
}

/// The side of a cone: normals out of it have n . along = slope, and all planes that touch it go through its apex.
template <class T>
Touch<T> pointOnCone(const Vec<T>& p, const Number<T>& radius, const Feature<T>& side) {
  using std::sqrt;
  const Vec<T> out = unit(across(p - side.at, side.along));
  return pointOnPlane<T>(p, radius, side.at, sqrt(1 - side.slope * side.slope) * out + side.slope * side.along);
}
/// Two lines, one or both of which are sides of cones: the plane that touches both.
template <class T>
Touch<T> lineOnCone(const Feature<T>& a, const Feature<T>& b, int side) {
  using std::sqrt;
  const T k = dot(a.along, b.along);
  const Vec<T> c = cross(a.along, b.along);
  // n = x a + y b + z c with n.a = -slope_a and n.b = slope_b
  const T x = -(a.slope + k * b.slope) / dot(c, c), y = (b.slope + k * a.slope) / dot(c, c);
  const T z = sqrt((1 - x * x - y * y - 2 * x * y * k) / dot(c, c));
  const Vec<T> n = x * a.along + y * b.along + (side * z) * c;
  // the lines of contact, from a.at along d and from b.at along e
  const Vec<T> d = a.along + a.slope * n, e = b.along - b.slope * n, between = a.at - b.at;
  const T t = dot(n, cross(d, between)) / dot(n, cross(d, e));
  return {dot(n, between) - a.radius - b.radius, n, b.at + t * e + b.radius * n};
}

/// A circle c(angle) = centre + R (cos u + sin v) whose angle 0 lies nearest to a given point.
template <class T>
struct Circle {
  Vec<T> centre, u, v;
  T radius;

  Circle(const Feature<T>& f, const Vec<T>& towards)
      : centre(f.at), u(unit(across(towards - f.at, f.along))), v(cross(f.along, u)), radius(f.radius) {}
  struct At {
    Vec<T> point, rate, bend;  ///< c, c', c''
  };
  At at(const T& angle) const {
    using std::cos, std::sin;
    const T c = radius * cos(angle), s = radius * sin(angle);
    const Vec<T> arm = c * u + s * v;
    return {centre + arm, c * v - s * u, -arm};
  }
};

/// Newton's changes below this are not worth another: the next would be their square, below the arithmetic's rounding.
template <class T>
T lastChange() {
  using std::sqrt;
  return sqrt(std::numeric_limits<T>::epsilon()) / 1000;
}
inline constexpr int kNewtonRounds = 60;

/// The lowest point of a circle over a plane.
template <class T>
Touch<T> circleOnPlane(const Feature<T>& circle, const Vec<T>& origin, const Vec<T>& n) {
  const Vec<T> p = circle.at - circle.radius * unit(across(n, circle.along));
  return pointOnPlane<T>(p, 0, origin, n);
}
/// The point of a circle that is nearest to a ball.
template <class T>
Touch<T> circleOnPoint(const Feature<T>& circle, const Feature<T>& ball) {
  const Vec<T> p = circle.at + circle.radius * unit(across(ball.at - circle.at, circle.along));
  return pointOnPoint<T>(p, 0, ball.at, ball.radius);
}

/// Where a circle is locally nearest to a line, by c' . w = 0 with w = (c - q) across the line. With a radius about the
/// line that is a point on a round; without, two curves that cross.
template <class T>
Touch<T> circleOnLine(const Feature<T>& a, const Feature<T>& line, int side, const Vec<T>& near) {
  using std::abs;
  const Circle<T> circle(a, near);
  T angle = 0;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const auto c = circle.at(angle);
    const Vec<T> w = across(c.point - line.at, line.along), rate = across(c.rate, line.along);
    const T change = -dot(c.rate, w) / (dot(c.bend, w) + dot(rate, rate));
    angle += change;
    if (abs(change) < lastChange<T>()) break;
  }
  const auto c = circle.at(angle);
  if (line.radius > 0) return pointOnLine<T>(c.point, 0, line.at, line.along, line.radius);
  const Vec<T> foot = line.at + dot(line.along, c.point - line.at) * line.along;
  return curveOnCurve<T>(c.point, c.rate, 0, foot, line.along, 0, side);
}

/// Where a circle is locally nearest to the side of a cone: its tangent there is across the normal.
template <class T>
Touch<T> circleOnCone(const Feature<T>& a, const Feature<T>& side, const Vec<T>& near) {
  using std::abs, std::sqrt;
  const Circle<T> circle(a, near);
  T angle = 0;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const auto c = circle.at(angle);
    const Vec<T> w = across(c.point - side.at, side.along), u = unit(w), rate = across(c.rate, side.along);
    const T cosine = sqrt(1 - side.slope * side.slope);
    const Vec<T> n = cosine * u + side.slope * side.along;
    const Vec<T> turn = (cosine / norm(w)) * (rate - dot(rate, u) * u);
    const T change = -dot(c.rate, n) / (dot(c.bend, n) + dot(c.rate, turn));
    angle += change;
    if (abs(change) < lastChange<T>()) break;
  }
  return pointOnCone<T>(circle.at(angle).point, 0, side);
}

/// Where two circles are locally nearest: their connection is at right angles to both.
template <class T>
Touch<T> circleOnCircle(const Feature<T>& a, const Feature<T>& b, int side, const Vec<T>& near_a,
                        const Vec<T>& near_b) {
  using std::abs;
  const Circle<T> first(a, near_a), second(b, near_b);
  T s = 0, t = 0;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const auto c = first.at(s), d = second.at(t);
    const Vec<T> w = c.point - d.point;
    // [f_s f_t; g_s g_t] (ds, dt) = -(f, g)
    const T f = dot(c.rate, w), g = dot(d.rate, w);
    const T f_s = dot(c.bend, w) + dot(c.rate, c.rate), f_t = -dot(c.rate, d.rate);
    const T g_s = -f_t, g_t = dot(d.bend, w) - dot(d.rate, d.rate);
    const T determinant = f_s * g_t - f_t * g_s;
    const T ds = -(f * g_t - g * f_t) / determinant, dt = -(f_s * g - g_s * f) / determinant;
    s += ds, t += dt;
    if (abs(ds) < lastChange<T>() && abs(dt) < lastChange<T>()) break;
  }
  const auto c = first.at(s), d = second.at(t);
  return curveOnCurve<T>(c.point, c.rate, 0, d.point, d.rate, 0, side);
}

/// Two features that face each other. `side` is the sign of the normal where the features leave it open: which way
/// curves cross, and from which side a face is met. `near_a`, `near_b`: the nearest points of a and b, roughly (used
/// for circles only). Their smooth gap; nothing for features that meet in no general way (an edge and a plane, two
/// sharp points).
template <class T>
std::optional<Touch<T>> touchOf(const Feature<T>& a, const Feature<T>& b, int side, const Vec<T>& near_a,
                                const Vec<T>& near_b) {
  using K = FeatureKind;
  if (a.kind > b.kind) {  // crossing tangents change their order, so that `side` keeps its meaning
    auto t = touchOf(b, a, side, near_b, near_a);
    if (t) t = flipped(*t);
    return t;
  }
  const bool sharp = !(a.radius > 0) && !(b.radius > 0) && !(a.slope > 0) && !(b.slope > 0);
  const bool cone = a.slope > 0 || b.slope > 0;
  switch (b.kind) {
    case K::point:
      if (sharp) return {};
      return pointOnPoint<T>(a.at, a.radius, b.at, b.radius);
    case K::line:
      if (a.kind == K::line) return cone ? lineOnCone(a, b, side) : lineOnLine(a, b, side);
      if (sharp) return {};
      if (cone) return pointOnCone<T>(a.at, a.radius, b);
      return pointOnLine<T>(a.at, a.radius, b.at, b.along, b.radius);
    case K::circle:
      if (a.kind == K::circle) return circleOnCircle(a, b, side, near_a, near_b);
      if (cone) return flipped(circleOnCone(b, a, near_b));
      if (a.kind == K::line) return flipped(circleOnLine(b, a, side, near_b));
      if (!(a.radius > 0)) return {};
      return flipped(circleOnPoint(b, a));
    case K::plane:
      if (a.kind == K::point) return pointOnPlane<T>(a.at, a.radius, b.at, side * b.along);
      if (a.kind == K::circle) return circleOnPlane(a, b.at, side * b.along);
      return {};
  }
  return {};
}

}  // namespace carom::exact
