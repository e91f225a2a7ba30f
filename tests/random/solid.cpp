// SPDX-License-Identifier: MIT
#include "tests/random/solid.h"

#include <algorithm>
#include <cmath>

namespace carom::brute {
namespace {

using Kind = Solid::Kind;

Real planeHeight(const Solid& plane, const Placement& P, const Vector& point) {
  return (P.R * plane.normal).dot(point - P.x) - plane.offset;
}

// Half of the width of a box along a unit direction.
Real halfWidth(const Solid& box, const Matrix& R, const Vector& n) {
  return box.half.dot((R.transpose() * n).cwiseAbs());
}

Separation ballBox(const Solid& ball, const Placement& A, const Solid& box, const Placement& B) {
  const Vector q = B.R.transpose() * (A.x - B.x);
  const Vector nearest = q.cwiseMax(-box.half).cwiseMin(box.half);
  const Real distance = (q - nearest).norm();
  if (distance > 0) return {distance - ball.radius, B.R * ((q - nearest) / distance)};
  int axis = 0;
  const Real depth = (q.cwiseAbs() - box.half).maxCoeff(&axis);
  return {depth - ball.radius, B.R.col(axis) * (q[axis] < 0 ? -1 : 1)};
}

// One separating axis of two boxes; `first` and `second` are the edges that it crosses, or one of them is -1 for a
// face.
struct Axis {
  Separation s;
  int first, second;
};

std::vector<Axis> axesOf(const Solid& a, const Placement& A, const Solid& b, const Placement& B) {
  std::vector<Axis> axes;
  axes.reserve(15);
  const Vector d = A.x - B.x;
  // Widths are taken along the direction as computed, so that any direction gives a true bound, even a badly rounded
  // one from edges that are nearly parallel.
  const auto add = [&](Vector n, int first, int second) {
    const Real length = n.norm();
    if (length < 1e-14L) return;  // parallel edges: the faces decide
    n /= n.dot(d) < 0 ? -length : length;
    axes.push_back({{n.dot(d) - halfWidth(a, A.R, n) - halfWidth(b, B.R, n), n}, first, second});
  };
  for (int i = 0; i < 3; ++i) add(A.R.col(i), i, -1);
  for (int i = 0; i < 3; ++i) add(B.R.col(i), -1, i);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) add(A.R.col(i).cross(B.R.col(j)), i, j);
  return axes;
}

Separation boxBox(const Solid& a, const Placement& A, const Solid& b, const Placement& B) {
  const auto axes = axesOf(a, A, b, B);
  return std::max_element(axes.begin(), axes.end(), [](const Axis& p, const Axis& q) { return p.s.value < q.s.value; })
      ->s;
}

// Corners that lie within `tie` of the lowest along n.
std::vector<Vector> lowestCorners(const Solid& box, const Placement& P, const Vector& n, Real tie) {
  std::vector<Vector> lowest;
  const Real floor = n.dot(P.x) - halfWidth(box, P.R, n);
  for (const Vector& r : corners(box, P.R))
    if (n.dot(P.x + r) <= floor + tie) lowest.push_back(P.x + r);
  return lowest;
}

// Middle of the edge along axis `e` of the box that lies lowest along n.
Vector lowestEdge(const Solid& box, const Placement& P, const Vector& n, int e) {
  Vector middle = P.x;
  for (int k = 0; k < 3; ++k)
    if (k != e) middle -= P.R.col(k) * (n.dot(P.R.col(k)) < 0 ? -box.half[k] : box.half[k]);
  return middle;
}

// Point of the line (p, d) nearest to the line (q, e); unit directions that are not parallel.
Vector nearestOnLine(const Vector& p, const Vector& d, const Vector& q, const Vector& e) {
  const Vector w = p - q;
  const Real c = d.dot(e), s2 = d.cross(e).squaredNorm();
  return p + d * ((c * e.dot(w) - d.dot(w)) / s2);
}

std::vector<Contact> boxBoxContacts(const Solid& a, const Placement& A, const Solid& b, const Placement& B, Real tie) {
  std::vector<Contact> contacts;
  const Real best = boxBox(a, A, b, B).value;
  for (const Axis& axis : axesOf(a, A, b, B)) {
    if (axis.s.value < best - tie) continue;
    const Vector n = axis.s.n;
    if (axis.second < 0) {  // face of a, corner of b
      for (const Vector& p : lowestCorners(b, B, -n, tie)) contacts.push_back({n, p});
    } else if (axis.first < 0) {
      for (const Vector& p : lowestCorners(a, A, n, tie)) contacts.push_back({n, p});
    } else {
      const Vector p = lowestEdge(a, A, n, axis.first), q = lowestEdge(b, B, -n, axis.second);
      contacts.push_back({n, nearestOnLine(q, B.R.col(axis.second), p, A.R.col(axis.first))});
    }
  }
  return contacts;
}

}  // namespace

Solid solidOf(const Shape& shape) {
  Solid solid;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    solid.kind = Kind::ball;
    solid.radius = sphere->radius;
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    solid.kind = Kind::box;
    solid.half = widen(box->size) / 2;
  } else {
    const auto& plane = std::get<Plane>(shape);
    solid.kind = Kind::half_space;
    solid.normal = widen(plane.normal);
    solid.offset = plane.offset;
  }
  return solid;
}

Separation separation(const Solid& a, const Placement& A, const Solid& b, const Placement& B) {
  if (a.kind > b.kind) {
    const Separation s = separation(b, B, a, A);
    return {s.value, -s.n};
  }
  if (b.kind == Kind::half_space) {
    const Vector n = B.R * b.normal;
    return {planeHeight(b, B, A.x) - (a.kind == Kind::ball ? a.radius : halfWidth(a, A.R, n)), n};
  }
  if (a.kind == Kind::box) return boxBox(a, A, b, B);
  if (b.kind == Kind::box) return ballBox(a, A, b, B);
  const Vector d = A.x - B.x;
  return {d.norm() - a.radius - b.radius, d.normalized()};
}

std::vector<Contact> contactsOf(const Solid& a, const Placement& A, const Solid& b, const Placement& B, Real tie) {
  if (a.kind > b.kind) {
    auto contacts = contactsOf(b, B, a, A, tie);
    for (Contact& c : contacts) c.n = -c.n;
    return contacts;
  }
  if (a.kind == Kind::box && b.kind == Kind::box) return boxBoxContacts(a, A, b, B, tie);
  const Vector n = separation(a, A, b, B).n;
  if (a.kind == Kind::ball) return {{n, A.x - a.radius * n}};
  std::vector<Contact> contacts;
  for (const Vector& p : lowestCorners(a, A, n, tie)) contacts.push_back({n, p});
  return contacts;
}

std::vector<Vector> corners(const Solid& solid, const Matrix& R) {
  if (solid.kind != Kind::box) return {Vector::Zero()};
  std::vector<Vector> list;
  list.reserve(8);
  for (int i = 0; i < 8; ++i) {
    const Vector sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    list.push_back(R * solid.half.cwiseProduct(sign));
  }
  return list;
}

}  // namespace carom::brute
