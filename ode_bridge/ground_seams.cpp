// SPDX-License-Identifier: MIT
#include "ode_bridge/ground_seams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "adjoint/numeric/elementary.hpp"
#include "ode_bridge/contact_at.hpp"
#include "ode_bridge/near_features.hpp"

namespace carom::ode_bridge_detail {
namespace {

// How far from a place its surroundings are looked at, as a share of the feature's size; how alike normals are in one
// plane.
constexpr double kSurroundings = 1e-6, kInOnePlane = 1e-9;

// How far q (solid's axes) is outside of a piece, m: exact to first order near its surface, below 0 within.
double outsidePiece(const Solid& solid, const Piece& piece, const Vec3& q) {
  const auto faceAt = [&](int f) -> const SolidFace& { return solid.faces[static_cast<std::size_t>(f)]; };
  double outside = -std::numeric_limits<double>::infinity();
  switch (piece.core) {
    case Piece::Core::point:
      return (q - piece.center).norm() - piece.radius;
    case Piece::Core::segment: {
      const Vec3 &from = solid.points[static_cast<std::size_t>(piece.points.first)],
                 along = solid.points[static_cast<std::size_t>(piece.points.first) + 1] - from;
      const double share = std::clamp(along.dot(q - from) / along.squaredNorm(), 0.0, 1.0);
      return (q - from - share * along).norm() - piece.radius;
    }
    case Piece::Core::frustum: {
      const Vec3 to = q - piece.center;
      const double along = piece.axis.dot(to), out_of_axis = (to - along * piece.axis).norm();
      const double rise = 2 * piece.half_length, fall = piece.rho - piece.rho_high;
      const double side = ((out_of_axis - 0.5 * (piece.rho + piece.rho_high)) * rise + along * fall) /
                          std::sqrt(rise * rise + fall * fall);
      return std::max(side, std::abs(along) - piece.half_length);
    }
    case Piece::Core::triangle: {
      const SolidFace& face = faceAt(solid.featuresOf(piece, Family::face)[0]);
      return std::max(std::abs(face.direction.dot(q - face.point)), outsideFace(solid, face, q));
    }
    case Piece::Core::polytope:
    case Piece::Core::half_space:
      for (int f : solid.featuresOf(piece, Family::face))
        outside = std::max(outside, faceAt(f).direction.dot(q - faceAt(f).point));
      return outside;
  }
  return outside;
}

// The pieces of a body that come within `distance` of q (world): visit(piece, q in the solid's axes) until it says true.
template <class Visit>
bool anyPieceAt(const Placed& body, const Vec3& q, double distance, const Visit& visit) {
  const Solid& solid = *body.solid;
  const Vec3 local = body.k.R.transpose() * (q - body.k.x);
  std::vector<int> open{0};
  while (!open.empty()) {
    const Node& node = solid.nodes[static_cast<std::size_t>(open.back())];
    open.pop_back();
    if (!solid.plane && (local - node.center).norm() > node.radius + distance) continue;
    if (node.piece < 0) {
      open.push_back(node.left), open.push_back(node.right);
      continue;
    }
    const Piece& piece = solid.pieces[static_cast<std::size_t>(node.piece)];
    if (outsidePiece(solid, piece, local) <= distance && visit(piece, local)) return true;
  }
  return false;
}

// A contact of a body with a fixed one, at a sharp feature of that.
struct SharpContact {
  const Placed &moving, &fixed;
  Family of_moving, of_fixed;
  int moving_index, fixed_index;
  Vec3 p, n;  // place, and normal out of the fixed body
  std::span<const Placed* const> beside;
  double flush;

  const Feature& own() const { return moving.solid->feature(of_moving, moving_index); }
  const Feature& seam() const { return fixed.solid->feature(of_fixed, fixed_index); }

  // Whether a piece of what is beside holds q and lies in the way of what is pushed along n there.
  bool isInTheWay(const Vec3& q) const {
    return std::ranges::any_of(beside, [&](const Placed* body) {
      const Vec3 way = body->k.R.transpose() * n;
      return anyPieceAt(*body, q, flush, [&](const Piece& piece, const Vec3& local) {
        if (piece.core == Piece::Core::half_space)
          return (body->solid->faces[0].direction - way).norm() > kInOnePlane;
        const double further = way.dot(supportOf(*body->solid, piece, way).at - local) + piece.radius;
        return further > flush + kInOnePlane * (piece.core_radius + piece.radius);
      });
    });
  }

  // Whether what moves is smooth at the contact: a ball, a round side, the midst of a face.
  bool isSmooth() const {
    if (of_moving == Family::face) {
      const SolidFace& face = moving.solid->faces[static_cast<std::size_t>(moving_index)];
      return outsideFace(*moving.solid, face, moving.k.R.transpose() * (p - moving.k.x)) < -flush;
    }
    return isSwept(own());
  }

  // Where the feature goes from p, as steps from it that stay on it.
  std::vector<Vec3> ways() const {
    std::vector<Vec3> out;
    const Solid& solid = *fixed.solid;
    const Feature& feature = seam();
    const Vec3 local = fixed.k.R.transpose() * (p - fixed.k.x);
    if (of_fixed == Family::edge) {
      const SolidEdge& edge = solid.edges[static_cast<std::size_t>(fixed_index)];
      const double along = edge.direction.dot(local - edge.point), step = kSurroundings * edge.half_length;
      for (const double sign : {1.0, -1.0})
        if (sign * along + step <= edge.half_length) out.push_back(sign * step * (fixed.k.R * edge.direction));
    } else if (of_fixed == Family::rim) {
      const Vec3 across = feature.direction.cross(local - feature.point).normalized();
      for (const double sign : {1.0, -1.0}) out.push_back(sign * kSurroundings * feature.rim * (fixed.k.R * across));
    } else if (of_fixed == Family::vertex) {
      const auto v = static_cast<std::size_t>(fixed_index);
      for (int i = solid.neighbour_first[v]; i < solid.neighbour_first[v + 1]; ++i) {
        const Vec3 to = fixed.k.R * (solid.vertices[static_cast<std::size_t>(solid.neighbours[static_cast<std::size_t>(i)])].point -
                                     feature.point);
        if (n.dot(to) >= -kInOnePlane * to.norm()) out.push_back(kSurroundings * to);
      }
    }
    return out;
  }

  // All of the feature about p is covered by what is in the way.
  bool isCovered() const {
    if (isSmooth()) return isInTheWay(p);
    const std::vector<Vec3> around = ways();
    if (around.empty()) return isInTheWay(p);
    return std::ranges::all_of(around, [&](const Vec3& step) { return isInTheWay(p + step); });
  }

  // A face across n that p lies on, of the fixed body or of one beside it.
  struct Area {
    const Placed* body;
    const SolidFace* face;
    double outside(const Vec3& q) const {
      if (face->count == 0 && face->disc == 0) return -std::numeric_limits<double>::infinity();
      return outsideFace(*body->solid, *face, body->k.R.transpose() * (q - body->k.x));
    }
  };

  void addAreas(const Placed& body, std::vector<Area>& areas) const {
    const Solid& solid = *body.solid;
    const Vec3 way = body.k.R.transpose() * n;
    anyPieceAt(body, p, flush, [&](const Piece& piece, const Vec3& local) {
      for (int f : solid.featuresOf(piece, Family::face)) {
        const SolidFace& face = solid.faces[static_cast<std::size_t>(f)];
        if ((face.direction - way).norm() > kInOnePlane || std::abs(face.direction.dot(local - face.point)) > flush) continue;
        if (const Area area{&body, &face}; area.outside(p) <= flush) areas.push_back(area);
      }
      return false;
    });
  }

  // A face goes on across the feature, so that p is no corner of what is touched.
  bool isInOnePlane() const {
    std::vector<Area> areas;
    for (const Placed* body : beside) addAreas(*body, areas);
    if (areas.empty()) return false;
    if (of_moving == Family::vertex) return true;
    addAreas(fixed, areas);
    const auto holds = [&](const Vec3& q) {
      return std::ranges::any_of(areas, [&](const Area& area) { return area.outside(q) <= flush; });
    };
    if (of_moving == Family::face) return isNoCorner(areas);
    const auto goesOn = [&](const Vec3& step) { return !isOnOwn(step) || holds(p + step); };
    const Vec3 step = ownStep();
    return goesOn(step) && goesOn(-step) && (isOnOwn(step) || isOnOwn(-step));
  }

  // Along the moving edge, or the tangent of the moving rim.
  Vec3 ownStep() const {
    const Vec3 along = moving.k.R * own().direction;
    if (of_moving == Family::rim) return kSurroundings * along.cross(p - moving.world(own().point));
    return kSurroundings * moving.solid->edges[static_cast<std::size_t>(moving_index)].half_length * along;
  }
  bool isOnOwn(const Vec3& step) const {
    if (of_moving == Family::rim) return true;
    const SolidEdge& edge = moving.solid->edges[static_cast<std::size_t>(moving_index)];
    const Vec3 local = moving.k.R.transpose() * (p + step - moving.k.x);
    return std::abs(edge.direction.dot(local - edge.point)) <= edge.half_length;
  }

  // Whether directions along which the areas go from p leave no half of the plane free.
  bool isNoCorner(const std::vector<Area>& areas) const {
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    std::vector<double> angles;
    const auto add = [&](const Vec3& d) { angles.push_back(elementary::atan2(d.dot(v), d.dot(u))); };
    for (const Area& area : areas) {
      if (area.outside(p) < -flush) return true;
      const Solid& solid = *area.body->solid;
      const Mat3& R = area.body->k.R;
      const Vec3 local = R.transpose() * (p - area.body->k.x);
      if (area.face->disc > 0) {
        const Vec3 along = R * area.face->direction.cross(local - area.face->point);
        add(along), add(-along);
        continue;
      }
      for (int i = 0; i < area.face->count; ++i) {
        const Vec3 &from = solid.corner(*area.face, i), &to = solid.corner(*area.face, i + 1);
        const Vec3 side = (to - from).normalized(), arm = local - from;
        if ((arm - side.dot(arm) * side).norm() > flush) continue;
        if ((to - local).norm() > flush) add(R * side);
        if (arm.norm() > flush) add(-(R * side));
      }
    }
    if (angles.empty()) return false;
    std::ranges::sort(angles);
    double widest = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
    return widest <= std::numbers::pi + kSurroundings;
  }
};

}  // namespace

bool isGroundSeam(const Placed& a, const Placed& b, const FeaturePair& f, const GroundBeside& ground, double flush) {
  if (ground.bodies.empty()) return false;
  const auto kind = static_cast<GapKind>(f.kind);
  const Family first = familyOfFirst(kind), second = familyOfSecond(kind);
  if ((ground.of_a ? first : second) == Family::face) return false;
  const ContactPoint c = contactAt(a, b, f);
  if (!c.point.allFinite() || !c.normal.allFinite()) return false;
  const SharpContact contact =
      ground.of_a ? SharpContact{b, a, second, first, f.b, f.a, c.point, -c.normal, ground.bodies, flush}
                  : SharpContact{a, b, first, second, f.a, f.b, c.point, c.normal, ground.bodies, flush};
  return contact.isCovered() || contact.isInOnePlane();
}

}  // namespace carom::ode_bridge_detail
