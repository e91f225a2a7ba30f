// SPDX-License-Identifier: MIT
#include "ode_bridge/touching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_bridge/edges_along.hpp"
#include "ode_bridge/ground_seams.hpp"
#include "ode_bridge/leaf_pairs.hpp"
#include "ode_bridge/near_features.hpp"
#include "ode_bridge/rounding.hpp"
#include "ode_bridge/seams.hpp"

namespace carom::ode_bridge_detail {
namespace {

// Two contacts this near, with normals this alike, are one; a normal may leave the cone of a feature by as much.
constexpr double kSame = 1e-9;
// Edges more parallel than this touch along a line: their ends carry the contact. Rims and edges that cross at a smaller
// angle have no normal.
constexpr double kParallel = 1e-6;

struct Touching {
  const PlacedPiece &a, &b;
  const Witness& witness;
  double tolerance;  ///< of a gap
  double level;      ///< of lying in front
  double scale;
  std::vector<FeaturePair>& found;

  // The features of a piece that lie, as a whole, within tolerance of its furthest extent along a direction (of a rim:
  // one point of it). The marks of a rim count where it stands flat.
  std::vector<FeatureName> frontOf(const PlacedPiece& p, const Vec3& direction) const {
    std::vector<FeatureName> front;
    const Solid& solid = p.solid();
    if (p.halfSpace()) return {{Family::face, 0}};
    const Vec3 d = p.body->k.R.transpose() * direction;
    const double extent = d.dot(supportOf(solid, *p.piece, d).at), furthest = extent - level;
    const auto vertex = [&](int v) { return solid.vertices[static_cast<std::size_t>(v)].point.dot(d) >= furthest; };
    // of a long one the direction, which is known to a share of the tolerance over a small one, takes the ends away
    const double nearly = extent - std::max(level, kSame * scale);
    const auto end = [&](int v) { return solid.vertices[static_cast<std::size_t>(v)].point.dot(d) >= nearly; };
    int marks = 0;
    for (int v : p.featuresOf(Family::vertex)) {
      if (!vertex(v)) continue;
      front.push_back({Family::vertex, v});
      if (isMark(solid, front.back())) ++marks;
    }
    for (int e : p.featuresOf(Family::edge)) {
      const SolidEdge& edge = solid.edges[static_cast<std::size_t>(e)];
      if (edge.from >= 0 ? end(edge.from) && end(edge.to) : liesInFront(edge, d))
        front.push_back({Family::edge, e});
    }
    for (int f : p.featuresOf(Family::face)) {
      const SolidFace& face = solid.faces[static_cast<std::size_t>(f)];
      if (liesInFront(solid, face, d, end)) front.push_back({Family::face, f});
    }
    if (marks < 3) std::erase_if(front, [&](const FeatureName& f) { return isMark(solid, f); });
    for (int r : p.featuresOf(Family::rim)) {
      const Feature& rim = solid.rims[static_cast<std::size_t>(r)];
      if (rim.point.dot(d) + rim.rim * rim.direction.cross(d).norm() >= furthest) front.push_back({Family::rim, r});
    }
    return front;
  }

  static bool isMark(const Solid& solid, const FeatureName& f) {
    return f.family == Family::vertex && solid.vertices[static_cast<std::size_t>(f.index)].mark;
  }

  // The side of a cylinder or cone: the line of it that faces d is across d.
  bool liesInFront(const SolidEdge& side, const Vec3& d) const {
    double along = side.direction.dot(d);
    if (side.apex > 0) {
      const double slant = std::sqrt(side.rim * side.rim + 4 * side.apex * side.apex);
      along = (2 * side.apex * along - side.rim * side.direction.cross(d).norm()) / slant;
    }
    return 2 * side.half_length * std::abs(along) <= level;
  }

  template <class Vertex>
  bool liesInFront(const Solid& solid, const SolidFace& face, const Vec3& d, const Vertex& vertex) const {
    if (face.disc > 0) return face.direction.dot(d) > 0 && face.disc * face.direction.cross(d).norm() <= level;
    if (!face.open && face.direction.dot(d) < 0) return false;
    for (int i = face.first; i < face.first + face.count; ++i)
      if (!vertex(solid.corners[static_cast<std::size_t>(i)])) return false;
    return true;
  }

  // Whether the normal n (from b to a) is one that a sharp feature of `p` can push along: the surface near the feature
  // falls away from the contact. `outward` is n for b, -n for a.
  bool inCone(const PlacedPiece& p, const FeatureName& f, const Vec3& outward) const {
    const Solid& solid = p.solid();
    const Vec3 n = p.body->k.R.transpose() * outward;
    const auto at = static_cast<std::size_t>(f.index);
    if (f.family == Family::vertex) {
      const Vec3& v = solid.vertices[at].point;
      for (int i = solid.neighbour_first[at]; i < solid.neighbour_first[at + 1]; ++i) {
        const Vec3 to =
            solid.vertices[static_cast<std::size_t>(solid.neighbours[static_cast<std::size_t>(i)])].point - v;
        if (n.dot(to) > kSame * to.norm()) return false;
      }
      return true;
    }
    if (f.family != Family::edge || p.piece->core != Piece::Core::triangle) return true;
    const SolidEdge& edge = solid.edges[at];
    // what is a valley from the front of a sheet is a ridge from its back
    if (!edge.convex && !solid.faces[static_cast<std::size_t>(edge.left)].open) return false;
    return fallsAway(solid, edge, n);
  }

  // Whether the foot of the contact is on the feature itself, not on its continuation.
  bool onFeature(const PlacedPiece& p, const FeatureName& f, const FeatureName& other, const Vec3& point) const {
    const Solid& solid = p.solid();
    const Vec3 local = p.body->k.R.transpose() * (point - p.body->k.x);
    if (f.family == Family::face) {
      const SolidFace& face = solid.faces[static_cast<std::size_t>(f.index)];
      return (face.count == 0 && face.disc == 0) || outsideFace(solid, face, local) <= 10 * level;
    }
    if (f.family != Family::edge) return true;
    const SolidEdge& edge = solid.edges[static_cast<std::size_t>(f.index)];
    const double along = std::abs(edge.direction.dot(local - edge.point)), room = edge.half_length - along;
    return other.family == Family::edge && level == tolerance ? room > 0 : room >= tolerance - level;
  }

  bool known(const ContactPoint& c, const FeaturePair& f) const {
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] == f) return true;
      if ((points[i].point - c.point).norm() <= kSame * scale && (points[i].normal - c.normal).norm() <= 1e-6)
        return true;
    }
    return false;
  }

  std::vector<ContactPoint> points;  // of `found`
  std::size_t known_before = 0;

  ContactPoint contactNow(GapKind kind, const FeatureName& f, const FeatureName& g, int sign) const {
    return contactOf(kind, placeFeature(a.solid().feature(f.family, f.index), {a.body->k.x, a.body->k.R}),
                     placeFeature(b.solid().feature(g.family, g.index), {b.body->k.x, b.body->k.R}), sign);
  }

  // Unit tangent of a rim or an edge at a point of it.
  static Vec3 tangentAt(const PlacedPiece& p, const FeatureName& f, const Vec3& point) {
    const Feature& feature = p.solid().feature(f.family, f.index);
    const Vec3 along = p.body->k.R * feature.direction;
    if (f.family == Family::edge) return along;
    return along.cross(point - p.body->world(feature.point)) / feature.rim;
  }

  // Two sharp curves, at least one a rim, that meet at a point have a normal there if they cross.
  bool crossAt(const FeatureName& f, const FeatureName& g, const Vec3& point) const {
    const auto curve = [](const FeatureName& h) { return h.family == Family::rim || h.family == Family::edge; };
    const auto swept = [](const PlacedPiece& p, const FeatureName& h) {
      return isSwept(p.solid().feature(h.family, h.index));
    };
    if (!curve(f) || !curve(g) || swept(a, f) || swept(b, g)) return true;
    return tangentAt(a, f, point).cross(tangentAt(b, g, point)).norm() >= kParallel;
  }

  // The sides of a cone and of what it touches have a point in common only if their lines there cross.
  bool linesCross(const FeatureName& f, const FeatureName& g, const Vec3& n) const {
    if (f.family != Family::edge || g.family != Family::edge) return true;
    const Feature &fa = a.solid().feature(f.family, f.index), &fb = b.solid().feature(g.family, g.index);
    if (fa.apex == 0 && fb.apex == 0) return true;
    return std::abs(n.dot((a.body->k.R * fa.direction).cross(b.body->k.R * fb.direction))) >= kParallel;
  }

  bool tryPair(const FeatureName& f, const FeatureName& g, int sign) {
    const GapKind kind = gapKind(f.family, g.family);
    const ContactPoint c = contactNow(kind, f, g, sign);
    if (!(std::abs(c.gap) <= tolerance) || !c.point.allFinite() || !c.normal.allFinite()) return false;
    if (!crossAt(f, g, c.point) || !linesCross(f, g, c.normal)) return false;
    if (!(separationAlong(a, b, c.normal) >= c.gap - level)) return false;
    if (!inCone(a, f, -c.normal) || !inCone(b, g, c.normal)) return false;
    if (!onFeature(a, f, g, c.point) || !onFeature(b, g, f, c.point)) return false;
    const FeaturePair pair{static_cast<std::int16_t>(kind), f.index, g.index, static_cast<std::int16_t>(sign)};
    if (!known(c, pair)) found.push_back(pair), points.push_back(c);
    return true;
  }

  bool canMeet(const FeatureName& f, const FeatureName& g) const {
    if (!hasKind(f.family, g.family)) return false;
    const Feature &fa = a.solid().feature(f.family, f.index), &fb = b.solid().feature(g.family, g.index);
    const bool face = f.family == Family::face || g.family == Family::face;
    const bool vertex = f.family == Family::vertex || g.family == Family::vertex;
    if (vertex && !face) return isSwept(fa) || isSwept(fb);  // sharp points meet in no general way
    if (face && (f.family == Family::rim || g.family == Family::rim)) return !liesFlat(fa, fb);
    if (f.family == Family::edge && g.family == Family::edge && fa.apex == 0 && fb.apex == 0)
      return (a.body->k.R * fa.direction).cross(b.body->k.R * fb.direction).norm() >= kParallel;
    return true;
  }

  // A rim that lies flat on a face has no lowest point: its marks, and where it crosses the face's border, carry it.
  bool liesFlat(const Feature& fa, const Feature& fb) const {
    const double sine = (a.body->k.R * fa.direction).cross(b.body->k.R * fb.direction).norm();
    return 2 * std::max(fa.rim, fb.rim) * sine <= level;
  }

  void run(const Vec3& n) {
    const std::vector<FeatureName> of_a = frontOf(a, -n), of_b = frontOf(b, n);
    // faces before edges and edges before vertices, so that a contact on a border is the face's
    for (const int wanted : {0, 1, 2})
      for (const FeatureName& f : of_a)
        for (const FeatureName& g : of_b) {
          const bool face = f.family == Family::face || g.family == Family::face;
          const bool vertex = f.family == Family::vertex || g.family == Family::vertex;
          if ((face ? 0 : vertex ? 2 : 1) != wanted || !canMeet(f, g)) continue;
          const GapKind kind = gapKind(f.family, g.family);
          const bool sheet = face && isOpen(f, g);
          for (int branch = 1; branch <= branches(kind); ++branch) {
            tryPair(f, g, branch);
            if (!face || sheet) tryPair(f, g, -branch);
          }
        }
  }

  void runAlongEdges() {
    const std::vector<Vec3> normals = normalsAlongEdges(a, b, witness.n, tolerance, scale);
    level = std::max(tolerance, kSame * scale);  // each is on the border of the other
    for (const Vec3& n : normals) run(n);
    level = tolerance;
  }

  bool isOpen(const FeatureName& f, const FeatureName& g) const {
    if (f.family == Family::face) return a.solid().faces[static_cast<std::size_t>(f.index)].open;
    return b.solid().faces[static_cast<std::size_t>(g.index)].open;
  }
};

// Of a triangle, on the side that n points to.
Vec3 normalOf(const PlacedPiece& triangle, const Vec3& n) {
  const auto face = static_cast<std::size_t>(triangle.featuresOf(Family::face)[0]);
  const Vec3 normal = triangle.body->k.R * triangle.solid().faces[face].direction;
  return normal.dot(n) < 0 ? Vec3(-normal) : normal;
}

double sizeOf(const PlacedPiece& a, const PlacedPiece& b) {
  const double size = a.halfSpace()   ? b.piece->core_radius
                      : b.halfSpace() ? a.piece->core_radius
                                      : a.piece->core_radius + b.piece->core_radius;
  return size + a.piece->radius + b.piece->radius;
}

}  // namespace

void addAlongEdges(const PlacedPiece& a, const PlacedPiece& b, const Witness& witness, double tolerance,
                   std::vector<FeaturePair>& found) {
  Touching touching{a, b, witness, tolerance, tolerance, sizeOf(a, b), found, {}, 0};
  for (const FeaturePair& f : found) touching.points.push_back(contactAt(*a.body, *b.body, f));
  touching.runAlongEdges();
}

void addTouching(const PlacedPiece& a, const PlacedPiece& b, const Witness& witness, double tolerance,
                 std::vector<FeaturePair>& found) {
  if (a.piece->core == Piece::Core::point && b.piece->core == Piece::Core::point && found.empty()) {
    found.push_back(witness.features);
    return;
  }
  const double scale = sizeOf(a, b);
  Touching touching{a, b, witness, tolerance, tolerance, scale, found, {}, 0};
  for (const FeaturePair& f : found) touching.points.push_back(contactAt(*a.body, *b.body, f));
  touching.known_before = found.size();
  touching.run(witness.n);
  const auto sheet = [](const PlacedPiece& p) { return p.piece->core == Piece::Core::triangle; };
  // what stands on the edge between two triangles of a plane is soonest parted from each by a direction that leans
  for (const PlacedPiece* p : {&a, &b})
    if (sheet(*p) && found.size() == touching.known_before) touching.run(normalOf(*p, witness.n));
  if (found.size() > touching.known_before || witness.distance > tolerance) return;
  // on a border by less than rounding: look again with room for it
  touching.level = std::max(tolerance, kSame * scale);
  touching.run(witness.n);
  if (!found.empty() || sheet(a) || sheet(b) || witness.features.kind < 0) return;
  const auto kind = static_cast<GapKind>(witness.features.kind);
  const FeatureName f{familyOfFirst(kind), witness.features.a}, g{familyOfSecond(kind), witness.features.b};
  const ContactPoint c = touching.contactNow(kind, f, g, witness.features.sign);
  if (std::abs(c.gap) <= tolerance && c.point.allFinite() && c.normal.allFinite() &&
      touching.onFeature(a, f, g, c.point) && touching.onFeature(b, g, f, c.point))
    found.push_back(witness.features);
}

namespace {

// A contact of two pieces.
struct Candidate {
  FeaturePair features;
  ContactPoint at;
  double scale;
  bool kept = false;

  bool onFace() const {
    const auto kind = static_cast<GapKind>(features.kind);
    return familyOfFirst(kind) == Family::face || familyOfSecond(kind) == Family::face;
  }
  bool sameAs(const Candidate& o) const {
    return features == o.features || ((at.point - o.at.point).norm() <= kSame * std::min(scale, o.scale) &&
                                      (at.normal - o.at.normal).norm() <= 1e-6);
  }
};

// Of contacts that are one, one is kept: that with a face, where a border is one of them.
std::vector<FeaturePair> oneEach(std::vector<Candidate>& all) {
  for (const bool faces : {true, false})
    for (Candidate& c : all)
      if (c.onFace() == faces)
        c.kept = std::none_of(all.begin(), all.end(), [&](const Candidate& o) { return o.kept && o.sameAs(c); });
  std::vector<FeaturePair> found;
  for (const Candidate& c : all)
    if (c.kept) found.push_back(c.features);
  return found;
}

}  // namespace

std::vector<FeaturePair> touchingFeatures(const Placed& a, const Placed& b, double reach, const GroundBeside& ground) {
  std::vector<Candidate> all;
  std::vector<FeaturePair> of_pieces;
  std::vector<int> pieces_a, pieces_b;
  const double deepest = kOverlap * touchTolerance(a, b);
  eachLeafPair(a, b, reach, [&](const PlacedPiece& p, const PlacedPiece& q) {
    const Witness witness = findWitness(p, q);
    if (!(witness.separation <= reach)) return;
    // what overlaps by so little touches; features that lie in front do so to within the overlap
    const double overlap = witness.separation >= -deepest ? -witness.separation : 0;
    of_pieces.clear();
    addTouching(p, q, witness, std::max(reach, 2 * overlap), of_pieces);
    addAlongEdges(p, q, witness, std::max(reach, 2 * overlap), of_pieces);
    for (const FeaturePair& f : of_pieces) {
      const ContactPoint c = contactAt(a, b, f);
      if (c.gap <= reach) all.push_back({f, c, sizeOf(p, q)});
    }
    for (auto& [pieces, piece] : {std::pair{&pieces_a, &p}, std::pair{&pieces_b, &q}})
      pieces->push_back(static_cast<int>(piece->piece - piece->solid().pieces.data()));
  });
  std::vector<FeaturePair> found = oneEach(all);
  if (found.size() > 1 && pieces_a.size() > 1) dropSeams(a, b, pieces_a, pieces_b, 10 * reach, found);
  if (!ground.bodies.empty())
    std::erase_if(found, [&](const FeaturePair& f) { return isGroundSeam(a, b, f, ground, 10 * reach); });
  return found;
}

}  // namespace carom::ode_bridge_detail
