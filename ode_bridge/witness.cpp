#include <algorithm>
#include <array>
#include <cmath>

#include "ode_bridge/separation.h"

namespace carom {
namespace {

// Solids further apart than this share of their bounding radii are seen as balls: one smooth bound, long steps.
constexpr double kFar = 0.25;
// Edges within this angle are parallel: their cross product is no direction, and the faces decide.
constexpr double kParallel = 1e-10;
// Rounding of a separation along crossed edges, over the sine of their angle; found by comparison with long double.
constexpr double kEdgeRounding = 8e-16;

Witness swapped(Witness w) {
  w.n = -w.n;
  std::swap(w.features.a, w.features.b);
  std::swap(w.edge_a, w.edge_b);
  if (w.frame == Witness::Frame::body_a)
    w.frame = Witness::Frame::body_b;
  else if (w.frame == Witness::Frame::body_b)
    w.frame = Witness::Frame::body_a;
  if (w.features.kind == kPointPlane)
    w.features.kind = kPlanePoint;
  else if (w.features.kind == kPlanePoint)
    w.features.kind = kPointPlane;
  else if (w.features.kind == kPointEdge)
    w.features.kind = kEdgePoint;
  else if (w.features.kind == kEdgePoint)
    w.features.kind = kPointEdge;
  return w;
}

// The vertex of a solid that lies furthest along a world direction.
int supportVertex(const Placed& a, const Vec3& direction) {
  if (a.solid->ball) return 0;
  const Vec3 local = a.k.R.transpose() * direction;
  return (local.x() > 0 ? 1 : 0) | (local.y() > 0 ? 2 : 0) | (local.z() > 0 ? 4 : 0);
}

Witness againstPlane(const Placed& a, const Placed& plane) {
  const Feature& face = plane.solid->faces[0];
  Witness w;
  w.frame = Witness::Frame::body_b;
  w.n = plane.k.R * face.direction;
  const double height = w.n.dot(a.k.x - plane.k.x) - face.point.dot(face.direction);
  const double bound = a.solid->bound();
  if (a.solid->box && height > (1 + kFar) * bound) {
    w.bounding = true;
    w.separation = height - bound;
    return w;
  }
  const int v = supportVertex(a, -w.n);
  w.features = {kPointPlane, static_cast<std::int16_t>(v), 0, 1};
  w.separation = height + w.n.dot(a.k.R * a.solid->vertices[static_cast<std::size_t>(v)].point) - a.solid->radius;
  return w;
}

Witness boundingBalls(const Placed& a, const Placed& b, const Vec3& D, double distance) {
  Witness w;
  w.bounding = true;
  w.n = D / distance;
  w.separation = distance - a.solid->bound() - b.solid->bound();
  return w;
}

Witness ballBall(const Placed& a, const Placed& b) {
  Witness w;
  const Vec3 D = a.k.x - b.k.x;
  const double distance = D.norm();
  w.n = distance > 0 ? Vec3(D / distance) : Vec3::UnitZ();
  w.separation = distance - a.solid->radius - b.solid->radius;
  w.features = {kPointPoint, 0, 0, 1};
  return w;
}

// The point of the box nearest to the ball's centre lies on a face, an edge or a vertex, by how many coordinates of the
// centre are beyond the box.
Witness ballBox(const Placed& ball, const Placed& box) {
  Witness w;
  w.frame = Witness::Frame::body_b;
  const Vec3 y = box.k.R.transpose() * (ball.k.x - box.k.x), half = box.solid->half;
  const Vec3 beyond = y - y.cwiseMax(-half).cwiseMin(half);
  int outside = 0, bits = 0, axis = 0, inner = 0;
  for (int k = 0; k < 3; ++k) {
    if (beyond[k] != 0) {
      ++outside;
      axis = k;
    } else {
      inner = k;
    }
    if (y[k] > 0) bits |= 1 << k;
  }
  if (outside == 0) {  // the centre is inside: leave by the nearest face
    (half - y.cwiseAbs()).minCoeff(&axis);
    outside = 1;
  }
  if (outside == 1) {
    const double sign = y[axis] > 0 ? 1.0 : -1.0;
    w.n = box.k.R.col(axis) * sign;
    w.separation = sign * y[axis] - half[axis] - ball.solid->radius;
    w.features = {kPointPlane, 0, static_cast<std::int16_t>(2 * axis + (sign > 0 ? 1 : 0)), 1};
    return w;
  }
  const double distance = beyond.norm();
  w.n = box.k.R * (beyond / distance);
  w.separation = distance - ball.solid->radius;
  if (outside == 3) {
    w.features = {kPointPoint, 0, static_cast<std::int16_t>(bits), 1};
  } else {
    const int edge = 4 * inner + (bits >> (inner + 1) % 3 & 1) + 2 * (bits >> (inner + 2) % 3 & 1);
    w.features = {kPointEdge, 0, static_cast<std::int16_t>(edge), 1};
  }
  return w;
}

// Edge along axis k of a box that lies furthest along a world direction.
int supportEdge(const Placed& box, int k, const Vec3& direction) {
  const Vec3 local = box.k.R.transpose() * direction;
  return 4 * k + (local[(k + 1) % 3] > 0 ? 1 : 0) + (local[(k + 2) % 3] > 0 ? 2 : 0);
}

// Separating axes of two boxes: 6 face normals and 9 crossed edges.
Witness boxBox(const Placed& a, const Placed& b) {
  const Mat3 &A = a.k.R, &B = b.k.R;
  const Vec3 &ha = a.solid->half, &hb = b.solid->half, D = a.k.x - b.k.x;
  const Mat3 c = A.transpose() * B, ac = c.cwiseAbs();
  const Vec3 ta = A.transpose() * D, tb = B.transpose() * D;
  const Vec3 sep_a = ta.cwiseAbs() - ha - ac * hb, sep_b = tb.cwiseAbs() - hb - ac.transpose() * ha;
  int ia, ib;
  const double best_a = sep_a.maxCoeff(&ia), best_b = sep_b.maxCoeff(&ib);
  double best = std::max(best_a, best_b);
  const double scale = D.norm() + ha.sum() + hb.sum();
  int ei = -1, ej = -1;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double s2 = c(i1, j) * c(i1, j) + c(i2, j) * c(i2, j);  // sin^2, without cancellation
      if (s2 < kParallel * kParallel) continue;
      const double s = std::sqrt(s2);
      const double along = std::abs(c(i1, j) * ta[i2] - c(i2, j) * ta[i1]);
      const double radii = ha[i1] * ac(i2, j) + ha[i2] * ac(i1, j) + hb[j1] * ac(i, j2) + hb[j2] * ac(i, j1);
      const double separation = (along - radii) / s;
      if (separation > best + kEdgeRounding * scale / s) best = separation, ei = i, ej = j;
    }
  Witness w;
  w.separation = best;
  if (ei >= 0) {
    const Vec3 cross = A.col(ei).cross(B.col(ej));
    const std::int16_t sign = cross.dot(D) >= 0 ? 1 : -1;
    w.frame = Witness::Frame::crossed;
    w.n = sign * cross.normalized();
    w.edge_a = A.col(ei);
    w.edge_b = B.col(ej);
    w.features = {kEdgeEdge, static_cast<std::int16_t>(supportEdge(a, ei, -w.n)),
                  static_cast<std::int16_t>(supportEdge(b, ej, w.n)), sign};
  } else if (best_b >= best_a) {
    const double sign = tb[ib] >= 0 ? 1.0 : -1.0;
    w.frame = Witness::Frame::body_b;
    w.n = sign * B.col(ib);
    w.features = {kPointPlane, static_cast<std::int16_t>(supportVertex(a, -w.n)),
                  static_cast<std::int16_t>(2 * ib + (sign > 0 ? 1 : 0)), 1};
  } else {
    const double sign = ta[ia] >= 0 ? 1.0 : -1.0;
    w.frame = Witness::Frame::body_a;
    w.n = sign * A.col(ia);
    w.features = {kPlanePoint, static_cast<std::int16_t>(2 * ia + (sign > 0 ? 0 : 1)),
                  static_cast<std::int16_t>(supportVertex(b, w.n)), 1};
  }
  return w;
}

}  // namespace

Placed::Placed(const Solid& s, const Arc& arc, double t)
    : solid(&s),
      k(arc.kinematicsAt(t)),
      acceleration(arc.acceleration()),
      spin(s.ball ? 0 : arc.spinBound()),
      spin_rate(s.ball ? 0 : arc.spinRateBound()) {}

Witness witnessAlong(const Placed& a, const Placed& b, const Vec3& n) {
  Witness w;
  w.n = n;
  const auto vertex = [&](const Placed& p, const Vec3& direction) {
    const auto v = static_cast<std::size_t>(supportVertex(p, direction));
    return Vec3(p.k.x + p.k.R * p.solid->vertices[v].point);
  };
  w.separation = n.dot(vertex(a, -n) - vertex(b, n)) - a.solid->radius - b.solid->radius;
  return w;
}

Witness findWitness(const Placed& a, const Placed& b) {
  if (b.solid->plane) return againstPlane(a, b);
  if (a.solid->plane) return swapped(againstPlane(b, a));
  if (a.solid->ball && b.solid->ball) return ballBall(a, b);
  const Vec3 D = a.k.x - b.k.x;
  const double distance = D.norm(), bounds = a.solid->bound() + b.solid->bound();
  if (distance > (1 + kFar) * bounds) return boundingBalls(a, b, D, distance);
  if (a.solid->ball) return ballBox(a, b);
  if (b.solid->ball) return swapped(ballBox(b, a));
  return boxBox(a, b);
}

}  // namespace carom
