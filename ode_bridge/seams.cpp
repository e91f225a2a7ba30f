// SPDX-License-Identifier: MIT
#include "ode_bridge/seams.hpp"

#include <algorithm>
#include <cmath>

#include "ode_bridge/contact_at.hpp"
#include "ode_bridge/near_features.hpp"

namespace carom::ode_bridge_detail {
namespace {

// How far beyond an edge a face has to go on, as a share of the size of the piece; and how alike normals are in one
// plane.
constexpr double kBeyond = 1e-6, kAlike = 1e-9;

// One of the two bodies, and its pieces that touch the other one.
struct TouchedBody {
  const Placed& body;
  const std::vector<int>& pieces;

  const Solid& solid() const { return *body.solid; }
  Vec3 local(const Vec3& p) const { return body.k.R.transpose() * (p - body.k.x); }
};

// Whether a face of another piece goes on beyond the edge at p, in the plane of the edge's face `own`, towards `out`.
bool goesOn(const TouchedBody& side, const SolidFace& own, const Vec3& p, const Vec3& out, double flush) {
  const Solid& solid = side.solid();
  return std::any_of(side.pieces.begin(), side.pieces.end(), [&](int index) {
    const Piece& piece = solid.pieces[static_cast<std::size_t>(index)];
    const double step = kBeyond * piece.core_radius;
    const Vec3 beyond = p + step * out;
    const auto faces = solid.featuresOf(piece, Family::face);
    return std::any_of(faces.begin(), faces.end(), [&](int f) {
      const SolidFace& face = solid.faces[static_cast<std::size_t>(f)];
      return &face != &own && (face.direction - own.direction).norm() <= kAlike &&
             std::abs(face.direction.dot(p - face.point)) <= flush && (face.count > 0 || face.disc > 0) &&
             outsideFace(solid, face, beyond) < -0.5 * step;  // surely: not at a corner of both
    });
  });
}

// Whether edge e is no border at p (solid's axes), where it is touched along `outward`.
bool isSeam(const TouchedBody& side, int e, const Vec3& p, const Vec3& outward, double flush) {
  const Solid& solid = side.solid();
  const SolidEdge& edge = solid.edges[static_cast<std::size_t>(e)];
  const auto direction = [&](int f) -> const Vec3& { return solid.faces[static_cast<std::size_t>(f)].direction; };
  if (edge.left >= 0 && edge.right >= 0 && (direction(edge.left) - direction(edge.right)).norm() <= kAlike) return true;
  for (const auto& [f, along] : {std::pair{edge.left, -1.0}, std::pair{edge.right, 1.0}}) {
    if (f < 0) continue;
    const SolidFace& own = solid.faces[static_cast<std::size_t>(f)];
    if (!(own.direction.dot(outward) > 1 - kAlike)) continue;
    if (goesOn(side, own, p, along * own.direction.cross(edge.direction), flush)) return true;
  }
  return false;
}

// Whether a vertex of a mesh has only flat edges around it, as far as the triangles that touch tell.
bool isFlat(const TouchedBody& side, int v) {
  const Solid& solid = side.solid();
  return std::all_of(side.pieces.begin(), side.pieces.end(), [&](int index) {
    const Piece& piece = solid.pieces[static_cast<std::size_t>(index)];
    const auto vertices = solid.featuresOf(piece, Family::vertex);
    if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) return true;
    if (piece.core != Piece::Core::triangle) return false;
    const auto edges = solid.featuresOf(piece, Family::edge);
    return std::none_of(edges.begin(), edges.end(), [&](int e) {
      const SolidEdge& edge = solid.edges[static_cast<std::size_t>(e)];
      return edge.convex && (edge.from == v || edge.to == v);
    });
  });
}

// A contact of a ball (a swept vertex) with a sharp border, beside one of it with a face whose plane that lies in.
bool besideFace(const Placed& a, const Placed& b, const FeaturePair& f, const FeaturePair& other, double flush) {
  const auto kind = static_cast<GapKind>(f.kind), kind_other = static_cast<GapKind>(other.kind);
  const Vec3 p = contactAt(a, b, f).point;
  const auto on = [&](const Placed& body, int face) {
    const SolidFace& plane = body.solid->faces[static_cast<std::size_t>(face)];
    return std::abs((body.k.R * plane.direction).dot(p - body.world(plane.point))) <= flush;
  };
  const auto isFace = [&](Family family) { return family == Family::face; };
  if (isFace(familyOfFirst(kind)) || isFace(familyOfSecond(kind))) return false;
  const auto ball = [](const Placed& body, int v) { return body.solid->vertices[static_cast<std::size_t>(v)].radius > 0; };
  if (kind_other == kPointPlane && familyOfFirst(kind) == Family::vertex)
    return f.a == other.a && ball(a, f.a) && on(b, other.b);
  if (kind_other == kPlanePoint && familyOfSecond(kind) == Family::vertex)
    return f.b == other.b && ball(b, f.b) && on(a, other.a);
  return false;
}

}  // namespace

bool isBesideFace(const Placed& a, const Placed& b, const FeaturePair& f, const std::vector<FeaturePair>& touching,
                  double flush) {
  return std::any_of(touching.begin(), touching.end(),
                     [&](const FeaturePair& other) { return besideFace(a, b, f, other, flush); });
}

void dropSeams(const Placed& a, const Placed& b, const std::vector<int>& pieces_a, const std::vector<int>& pieces_b,
               double flush, std::vector<FeaturePair>& found) {
  const TouchedBody of_a{a, pieces_a}, of_b{b, pieces_b};
  const auto crosses = [](Family f) { return f == Family::edge || f == Family::rim; };
  const auto dropped = [&](const FeaturePair& f) {
    const auto kind = static_cast<GapKind>(f.kind);
    const Family first = familyOfFirst(kind), second = familyOfSecond(kind);
    if (first == Family::vertex && isFlat(of_a, f.a)) return true;
    if (second == Family::vertex && isFlat(of_b, f.b)) return true;
    if (first == Family::face || second == Family::face) return false;
    if (crosses(first) && crosses(second)) {
      const ContactPoint c = contactAt(a, b, f);
      return (first == Family::edge && isSeam(of_a, f.a, of_a.local(c.point), a.k.R.transpose() * -c.normal, flush)) ||
             (second == Family::edge && isSeam(of_b, f.b, of_b.local(c.point), b.k.R.transpose() * c.normal, flush));
    }
    return isBesideFace(a, b, f, found, flush);
  };
  std::vector<FeaturePair> kept;
  std::copy_if(found.begin(), found.end(), std::back_inserter(kept), [&](const FeaturePair& f) { return !dropped(f); });
  if (!kept.empty()) found = std::move(kept);
}

}  // namespace carom::ode_bridge_detail
