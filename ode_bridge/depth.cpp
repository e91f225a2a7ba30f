// SPDX-License-Identifier: MIT
#include "ode_bridge/depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ode_bridge/gjk.hpp"

// The separation of two convex pieces along n is a linear function of their poses as long as the same points face each
// other, and as a function of n the largest one is at a normal of the difference of the two pieces: of a face of one of
// them, or where an edge of one crosses one of the other. All of them are tried, since nearest points, of which there are
// none, cannot tell the few that count.

namespace carom::ode_bridge_detail {

namespace {

// Cores that are nearer than this share of their sizes are taken to overlap: nearest points no longer say which way.
constexpr double kNoLongerApart = 1e-9;

bool isThick(const Piece& piece) { return piece.core != Piece::Core::point && piece.core != Piece::Core::segment; }

class DepthSearch {
 public:
  DepthSearch(const PlacedPiece& a, const PlacedPiece& b, double scale) : a_(a), b_(b), scale_(scale) {
    for (const Family family : kFamilies) {
      const auto f = static_cast<std::size_t>(family);
      for (int i : a.featuresOf(family)) placed_a_[f].push_back(placedIn(a, family, i));
      for (int i : b.featuresOf(family)) placed_b_[f].push_back(placedIn(b, family, i));
    }
  }

  Depth run() {
    for (const bool first : {false, true})
      for (const Candidate& f : of(first, Family::face)) face(first, f);
    for (const Family f : kFamilies)
      for (const Family g : kFamilies)
        if (f != Family::face && g != Family::face && hasKind(f, g)) crossings(f, g);
    Depth depth;
    depth.separation = best_;
    std::erase_if(found_, [&](const NearPlace& p) { return p.at.gap < best_ - kSameDepth * scale_; });
    // what stands for a rim that lies flat comes last
    std::stable_sort(found_.begin(), found_.end(), [](const NearPlace& p, const NearPlace& q) {
      return p.mark != q.mark ? q.mark : p.at.gap > q.at.gap;
    });
    if (!found_.empty()) depth.witness = witnessOf(found_.front());
    depth.places = std::move(found_);
    return depth;
  }

 private:
  static constexpr double kRoundingOfDepth = 4e-16;
  // Places whose separations differ by less than this share of the sizes are equal.
  static constexpr double kSameDepth = 1e-13;

  double room() const { return 64 * kRoundingOfDepth * scale_; }
  Pose poseOf(const PlacedPiece& p) const { return {p.body->k.x, p.body->k.R}; }
  // A feature of a piece with its place in the world.
  struct Candidate {
    int index;
    const Feature* feature;
    WorldFeature world;
    bool between_faces = false;  // an edge of a polytope
    Vec3 left = Vec3::Zero(), right = Vec3::Zero();  // their normals, world
    // Whether a direction across the edge may point out of it there.
    bool mayFace(const Vec3& n) const {
      constexpr double kRoom = 1e-9;
      const Vec3 turn = left.cross(right);
      return !between_faces || (left.cross(n).dot(turn) >= -kRoom && n.cross(right).dot(turn) >= -kRoom);
    }
  };
  using Candidates = std::vector<Candidate>;
  Candidate placedIn(const PlacedPiece& p, Family family, int i) const {
    const Feature& f = p.solid().feature(family, i);
    Candidate c{i, &f, placeFeature(f, poseOf(p))};
    if (family != Family::edge || p.piece->core != Piece::Core::polytope) return c;
    const Solid& solid = p.solid();
    const SolidEdge& edge = solid.edges[static_cast<std::size_t>(i)];
    if (edge.left < 0 || edge.right < 0) return c;
    c.between_faces = true;
    c.left = p.body->k.R * solid.faces[static_cast<std::size_t>(edge.left)].direction;
    c.right = p.body->k.R * solid.faces[static_cast<std::size_t>(edge.right)].direction;
    return c;
  }
  const Candidates& of(bool first, Family family) const {
    return (first ? placed_a_ : placed_b_)[static_cast<std::size_t>(family)];
  }

  // Keeps a pair of features at whose gap the pieces lie on both sides of its normal's plane.
  void offer(const FeaturePair& features, const ContactPoint& c, bool mark = false, double handicap = 0) {
    if (!std::isfinite(c.gap) || !c.normal.allFinite() || !c.point.allFinite()) return;
    if (!(c.gap > best_ + handicap - kSameDepth * scale_)) return;
    const double separation = separationAlong(a_, b_, c.normal);
    if (!(separation >= c.gap - room() - handicap)) return;
    best_ = std::max(best_, c.gap);
    found_.push_back({features, c, separation, mark});
  }

  // Of the first body or of the second.
  void face(bool first, const Candidate& f) {
    const bool open = (first ? a_ : b_).solid().faces[static_cast<std::size_t>(f.index)].open;
    for (int sign = 1; sign >= (open ? -1 : 1); sign -= 2) {
      const std::size_t before = found_.size();
      for (const bool marks : {false, true}) {
        if (found_.size() > before) break;  // marks stand in for what has no point of its own
        for (const Family family : {Family::vertex, Family::rim})
          for (const Candidate& g : of(!first, family)) {
            if (family == Family::vertex && g.feature->mark != marks) continue;
            const GapKind kind = first ? gapKind(Family::face, family) : gapKind(family, Family::face);
            const Candidate &one = first ? f : g, &two = first ? g : f;
            offer({static_cast<std::int16_t>(kind), one.index, two.index, static_cast<std::int16_t>(sign)},
                  contactOf(kind, one.world, two.world, sign), marks);
          }
      }
    }
  }

  void crossings(Family f, Family g) {
    const GapKind kind = gapKind(f, g);
    const bool edges = f == Family::edge && g == Family::edge, vertex = f == Family::vertex || g == Family::vertex;
    for (const Candidate& one : of(true, f))
      for (const Candidate& two : of(false, g)) {
        // sharp vertices have no normal of their own
        if (vertex && !isSwept(*one.feature) && !isSwept(*two.feature)) continue;
        if (one.feature->mark || two.feature->mark) continue;
        double handicap = 0;
        Vec3 across = Vec3::Zero();
        if (edges) {
          across = one.world.direction.cross(two.world.direction);
          const double sine = across.norm();
          if (!(sine > 1e-12)) continue;
          across /= sine;
          handicap = kRoundingOfDepth * scale_ / sine;
        }
        const bool sharp = one.between_faces && two.between_faces;
        const bool may_face[] = {!sharp || (one.mayFace(-across) && two.mayFace(across)),
                              !sharp || (one.mayFace(across) && two.mayFace(-across))};
        for (int branch = 1; branch <= branches(kind); ++branch)
          for (const int sign : {branch, -branch})
            if (may_face[sign > 0 ? 0 : 1])
              offer({static_cast<std::int16_t>(kind), one.index, two.index, static_cast<std::int16_t>(sign)},
                    contactOf(kind, one.world, two.world, sign), false, handicap);
      }
  }

  // The normal turns with a face, or with an edge that meets what is round; across two edges it stays so.
  Witness witnessOf(const NearPlace& place) const {
    const auto kind = static_cast<GapKind>(place.features.kind);
    const Family f = familyOfFirst(kind), g = familyOfSecond(kind);
    const auto fixes = [](Family family) { return family == Family::face || family == Family::edge; };
    Witness w;
    w.n = place.at.normal;
    w.separation = place.separation;
    w.distance = place.at.gap;
    w.features = place.features;
    if (f == Family::edge && g == Family::edge) {
      const Feature &fa = a_.solid().feature(f, place.features.a), &fb = b_.solid().feature(g, place.features.b);
      w.frame = fa.apex > 0 || fb.apex > 0 ? Witness::Frame::tapered : Witness::Frame::crossed;
      w.edge_a = a_.body->k.R * fa.direction, w.edge_b = b_.body->k.R * fb.direction;
    } else if (fixes(g)) {
      w.frame = Witness::Frame::body_b;
    } else if (fixes(f)) {
      w.frame = Witness::Frame::body_a;
    }
    return w;
  }

  PlacedPiece a_, b_;
  std::array<Candidates, 4> placed_a_, placed_b_;  // by Family
  double scale_, best_ = -std::numeric_limits<double>::infinity();
  std::vector<NearPlace> found_;
};

}  // namespace

std::optional<Depth> depthOf(const PlacedPiece& a, const PlacedPiece& b) {
  const Vec3 between = a.body->world(a.piece->center) - b.body->world(b.piece->center);
  const CoreDistance points = coreDistance(a, b, between.isZero(0) ? Vec3::UnitZ() : between);
  const double size = a.piece->core_radius + b.piece->core_radius;
  if (!points.overlap && points.upper > kNoLongerApart * size) return std::nullopt;
  // balls and capsules whose middles meet: every direction across is as good
  if (!isThick(*a.piece) && !isThick(*b.piece)) return Depth{-a.piece->radius - b.piece->radius, {}, std::nullopt};
  Depth depth = DepthSearch(a, b, size + a.piece->radius + b.piece->radius + between.norm()).run();
  if (depth.places.empty()) depth.separation = -a.piece->radius - b.piece->radius;
  return depth;
}

}  // namespace carom::ode_bridge_detail
