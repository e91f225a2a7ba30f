// SPDX-License-Identifier: MIT
#include "ode_bridge/feature_limits.hpp"

#include <cmath>

namespace carom::ode_bridge_detail {
namespace {

struct Limits {
  const Solid& solid;
  double sign;
  int body;
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

  // weight . outward >= 0
  void normal(const Vec3& weight, std::string beyond) const {
    FeatureLimit limit;
    limit.body = body;
    limit.normal_weight = sign * weight;
    limit.beyond = std::move(beyond);
    out.push_back(std::move(limit));
  }

  const Feature& vertexAt(int v) const { return solid.vertices[static_cast<std::size_t>(v)]; }
};

// All neighbours lie behind the vertex as the normal sees it.
void ofVertex(const Limits& limits, int v) {
  const Solid& solid = limits.solid;
  const auto at = static_cast<std::size_t>(v);
  if (at + 1 >= solid.neighbour_first.size()) return;
  for (int i = solid.neighbour_first[at]; i < solid.neighbour_first[at + 1]; ++i) {
    const int other = solid.neighbours[static_cast<std::size_t>(i)];
    const Vec3 to = limits.vertexAt(other).point - limits.vertexAt(v).point;
    if (to.norm() > 0) limits.normal(-to.normalized(), nameOf(solid, Family::vertex, other));
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
    limits.normal(-into.normalized(), nameOf(solid, Family::face, f));
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
    return;
  }
  for (int i = 0; i < face.count; ++i) {
    const auto corner = [&](int k) {
      return limits.vertexAt(solid.corners[static_cast<std::size_t>(face.first + k % face.count)]).point;
    };
    const Vec3 from = corner(i), along = corner(i + 1) - from;
    limits.point(-along.cross(face.direction).normalized(), from, face, border);
  }
}

// Unit, from the side of a cylinder or cone towards the cap, along the line of it that ends at a rim's point in the
// direction `across`.
Vec3 sideAbove(const Solid& solid, const Feature& rim, const Vec3& across) {
  for (const SolidEdge& side : solid.edges)
    if (side.part == rim.part && side.apex > 0 && across.norm() > 0)
      return (rim.rim * across.normalized() + 2 * side.apex * rim.direction).normalized();
  return rim.direction;
}

// The contact is at the outermost point of the rim, on the side of the cap.
void ofRim(const Limits& limits, int r, const Vec3& point) {
  const Feature& rim = limits.solid.rims[static_cast<std::size_t>(r)];
  const std::string name = nameOf(limits.solid, Family::rim, r);
  const Vec3 to = point - rim.point, across = to - rim.direction.dot(to) * rim.direction;
  limits.normal(sideAbove(limits.solid, rim, across), "the side of " + name);
  if (across.norm() > 0) limits.normal(across.normalized(), "the cap of " + name);
}

}  // namespace

void addFeatureLimits(const Solid& solid, Family family, int index, const Vec3& point, double sign, int body,
                      std::vector<FeatureLimit>& out) {
  const Limits limits{solid, sign, body, out};
  if (solid.plane || solid.ball) return;
  if (family == Family::vertex) ofVertex(limits, index);
  if (family == Family::edge) ofEdge(limits, index);
  if (family == Family::face) ofFace(limits, index, point);
  if (family == Family::rim) ofRim(limits, index, point);
}

}  // namespace carom::ode_bridge_detail
