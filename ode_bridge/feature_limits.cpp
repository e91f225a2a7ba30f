// SPDX-License-Identifier: MIT
#include "adjoint/motion/body_geometry.h"

#include <algorithm>
#include <cmath>

#include "adjoint/base/arguments.hpp"
#include "ode_bridge/gaps.hpp"
#include "ode_bridge/overlap.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

struct Limits {
  const Solid& solid;
  double sign;
  int body;
  int other;  // dimension of what the feature of the other body has in the plane of the contact
  std::vector<FeatureLimit>& out;

  // weight . (p - border) >= 0; the border moves with the part that `of` belongs to
  void point(const Vec3& weight, const Vec3& border, const Feature& of, std::string beyond) const {
    FeatureLimit limit;
    limit.body = body;
    limit.point_weight = weight;
    limit.border = border;
    Feature moving = of;
    moving.point = border;
    limit.border_rates = ratesOf(solid, moving).point;
    limit.beyond = std::move(beyond);
    out.push_back(std::move(limit));
  }

  // weight . outward >= 0; at 0 what lies beside, a line or a face, is in the plane of the contact. Two lines there, or a
  // point and anything, have a point in common as before; else more of the bodies comes into touch.
  void normal(const Vec3& weight, int beside, std::string beyond, const Eigen::Matrix3Xd& rates = {}) const {
    FeatureLimit limit;
    limit.body = body;
    limit.normal_weight = sign * weight;
    limit.normal_rates = sign * rates;
    limit.rolls_over = beside + other <= 2;
    limit.beyond = std::move(beyond);
    out.push_back(std::move(limit));
  }

  const Feature& vertexAt(int v) const { return solid.vertices[static_cast<std::size_t>(v)]; }
};

// The side of the cone that a part is; null for other parts.
const SolidEdge* sideOfCone(const Solid& solid, int part) {
  const auto side = std::find_if(solid.edges.begin(), solid.edges.end(),
                                 [&](const SolidEdge& e) { return e.part == part && e.apex > 0; });
  return side == solid.edges.end() ? nullptr : &*side;
}

// Along or against the line of a cone's side that ends at the rim's point in the direction u from the axis:
// (rho u - 2 apex d)/|..|, d towards the apex. As the normal of a contact there moves, u turns about the axis, which
// the normal has no part along: only rho and apex count.
void ofSideOfCone(const Limits& limits, const SolidEdge& side, const Vec3& u, double way, std::string beyond) {
  const Vec3 along = side.rim * u - 2 * side.apex * side.direction, w = along.normalized();
  const FeatureRates by_size = ratesOf(limits.solid, side);
  const Eigen::Matrix3Xd rates = u * by_size.rim - 2 * side.direction * by_size.apex;
  limits.normal(way * w, 1, std::move(beyond), way / along.norm() * (rates - w * (w.transpose() * rates)));
}

// The lines of the side fall back from the apex; the one towards which the normal leans is the first that does not.
void ofApex(const Limits& limits, int v, const Vec3& outward) {
  const SolidEdge* side = sideOfCone(limits.solid, limits.vertexAt(v).part);
  if (!side || limits.vertexAt(v).mark) return;
  const Vec3 across = outward - side->direction.dot(outward) * side->direction;
  if (across.norm() > 0)
    ofSideOfCone(limits, *side, across.normalized(), -1, "the side next to " + nameOf(limits.solid, Family::vertex, v));
}

// All neighbours lie behind the vertex as the normal sees it.
void ofVertex(const Limits& limits, int v) {
  const Solid& solid = limits.solid;
  const auto at = static_cast<std::size_t>(v);
  if (at + 1 >= solid.neighbour_first.size()) return;
  for (int i = solid.neighbour_first[at]; i < solid.neighbour_first[at + 1]; ++i) {
    const int other = solid.neighbours[static_cast<std::size_t>(i)];
    const Vec3 to = limits.vertexAt(other).point - limits.vertexAt(v).point;
    if (to.norm() > 0) limits.normal(-to.normalized(), 1, nameOf(solid, Family::vertex, other));
  }
}

// Between the ends, with a normal between those of the two faces.
void ofEdge(const Limits& limits, int e) {
  const Solid& solid = limits.solid;
  const SolidEdge& edge = solid.edges[static_cast<std::size_t>(e)];
  const std::string end = "the end of " + nameOf(solid, Family::edge, e);
  for (const double side : {-1.0, 1.0})
    limits.point(-side * edge.direction, edge.point + side * edge.half_length * edge.direction, edge, end);
  const auto face = [&](int f, double along) {
    if (f < 0) return;
    const Vec3 into = along * solid.faces[static_cast<std::size_t>(f)].direction.cross(edge.direction);
    limits.normal(-into.normalized(), 2, nameOf(solid, Family::face, f));
  };
  face(edge.left, 1);
  face(edge.right, -1);
}

void ofFace(const Limits& limits, int f, const Vec3& point) {
  const Solid& solid = limits.solid;
  const SolidFace& face = solid.faces[static_cast<std::size_t>(f)];
  const std::string border = "the border of " + nameOf(solid, Family::face, f);
  if (face.disc > 0) {
    const Vec3 to = point - face.point, across = to - face.direction.dot(to) * face.direction;
    if (across.norm() == 0) return;
    const Vec3 out = across.normalized();
    limits.point(-out, face.point + face.disc * out, face, border);
    limits.out.back().radius = face.disc;
    limits.out.back().axis = face.direction;
    return;
  }
  for (int i = 0; i < face.count; ++i) {
    const Vec3 &from = solid.corner(face, i), along = solid.corner(face, i + 1) - from;
    limits.point(-along.cross(face.direction).normalized(), from, face, border);
  }
}

// The contact is at the outermost point of the rim, on the side of the cap.
void ofRim(const Limits& limits, int r, const Vec3& point) {
  const Feature& rim = limits.solid.rims[static_cast<std::size_t>(r)];
  const std::string name = nameOf(limits.solid, Family::rim, r);
  const Vec3 to = point - rim.point, across = to - rim.direction.dot(to) * rim.direction;
  const SolidEdge* side = sideOfCone(limits.solid, rim.part);
  if (!side || across.norm() == 0) {
    limits.normal(rim.direction, 1, "the side of " + name);
  } else {
    ofSideOfCone(limits, *side, across.normalized(), 1, "the side of " + name);
  }
  if (across.norm() > 0) limits.normal(across.normalized(), 2, "the cap of " + name);
}

// Adds the conditions under which a contact stays with one feature of a solid (see FeatureLimit). `point` and `n` are
// those of the contact in the solid's axes.
void addFeatureLimits(const Limits& limits, Family family, int index, const Vec3& point, const Vec3& n) {
  if (family == Family::vertex) ofVertex(limits, index), ofApex(limits, index, limits.sign * n);
  if (family == Family::edge) ofEdge(limits, index);
  if (family == Family::face) ofFace(limits, index, point);
  if (family == Family::rim) ofRim(limits, index, point);
}

// A mark of a rim may hang over the border of a face by this share of the radius, where the rim there runs along the
// border to within so many rad: beside the border itself it crosses it at no angle, and has no contact with a normal.
constexpr double kHangs = 1e-6, kAlongBorder = 1e-3;

// Of the rim whose cap has a mark: from its centre to the mark; 0 where `v` is none.
Vec3 toMark(const Solid& solid, int v) {
  const Feature& mark = solid.vertices[static_cast<std::size_t>(v)];
  if (!mark.mark) return Vec3::Zero();
  for (const Feature& rim : solid.rims) {
    const Vec3 to = mark.point - rim.point;
    if (rim.part == mark.part && std::abs(to.norm() - rim.rim) <= 1e-9 * rim.rim) return to;
  }
  return Vec3::Zero();
}

// A rim that crosses an edge does so until it runs along the edge to within this angle, rad: where they touch, both places
// at which they cross are one, without an angle and with endless speed. `line`, `point`: in the axes of the rim.
constexpr double kCrosses = 3e-4;

void ofCrossedRim(const Limits& limits, int r, const Vec3& line, const Vec3& point) {
  const Feature& rim = limits.solid.rims[static_cast<std::size_t>(r)];
  Vec3 along = line - rim.direction.dot(line) * rim.direction;
  if (!(along.norm() > 0)) return;
  along.normalize();
  const double at = along.dot(point - rim.point), room = std::ldexp(1.0, std::ilogb(kCrosses * rim.rim));
  const Vec3 weight = at < 0 ? Vec3(-along) : along;
  limits.point(weight, rim.point + room * weight, rim, "where " + nameOf(limits.solid, Family::rim, r) + " runs along the edge");
}

// `to`: in the axes of the face.
void letMarkHang(std::vector<FeatureLimit>& limits, int face_of, const Vec3& to) {
  const double radius = to.norm();
  if (!(radius > 0)) return;
  const double hangs = std::ldexp(1.0, std::ilogb(kHangs * radius));  // a little change of the radius leaves it as it is
  for (FeatureLimit& limit : limits)
    if (limit.body == face_of && limit.radius == 0 && limit.point_weight.cross(to).norm() < kAlongBorder * radius)
      limit.border -= hangs * limit.point_weight;
}

}  // namespace

double FeatureGeometry::boundingRadius(int body) const {
  return solids_[checkedIndex("boundingRadius", "body", body, solids_.size())].bound();
}

double FeatureGeometry::overlap(int a, int b, const Pose& A, const Pose& B) const {
  for (int body : {a, b}) checkedIndex("overlap", "body", body, solids_.size());
  return overlapOf(Placed(solid(a), A.x, A.R), Placed(solid(b), B.x, B.R), 0).value_or(0);
}

std::vector<FeatureLimit> FeatureGeometry::limits(int a, int b, const FeaturePair& f, const Pose& A,
                                                  const Pose& B) const {
  std::vector<FeatureLimit> limits;
  const ContactPoint at = contact(a, b, f, A, B);
  const auto kind = static_cast<GapKind>(f.kind);
  const auto dimensionOf = [](Family family) { return family == Family::face ? 2 : family == Family::edge ? 1 : 0; };
  const Family of_a = familyOfFirst(kind), of_b = familyOfSecond(kind);
  // the normal points out of b
  addFeatureLimits({solid(a), -1, a, dimensionOf(of_b), limits}, of_a, f.a, A.R.transpose() * (at.point - A.x),
                   A.R.transpose() * at.normal);
  addFeatureLimits({solid(b), 1, b, dimensionOf(of_a), limits}, of_b, f.b, B.R.transpose() * (at.point - B.x),
                   B.R.transpose() * at.normal);
  if (of_a == Family::vertex && of_b == Family::face) letMarkHang(limits, b, B.R.transpose() * (A.R * toMark(solid(a), f.a)));
  if (of_b == Family::vertex && of_a == Family::face) letMarkHang(limits, a, A.R.transpose() * (B.R * toMark(solid(b), f.b)));
  const auto isLine = [](const Solid& solid, int e) {
    const SolidEdge& edge = solid.edges[static_cast<std::size_t>(e)];
    return edge.radius == 0 && edge.apex == 0;
  };
  if (of_a == Family::rim && of_b == Family::edge && isLine(solid(b), f.b))
    ofCrossedRim({solid(a), -1, a, 1, limits}, f.a, A.R.transpose() * (B.R * solid(b).edges[static_cast<std::size_t>(f.b)].direction),
                 A.R.transpose() * (at.point - A.x));
  if (of_b == Family::rim && of_a == Family::edge && isLine(solid(a), f.a))
    ofCrossedRim({solid(b), 1, b, 1, limits}, f.b, B.R.transpose() * (A.R * solid(a).edges[static_cast<std::size_t>(f.a)].direction),
                 B.R.transpose() * (at.point - B.x));
  return limits;
}

}  // namespace carom
