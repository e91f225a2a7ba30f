// SPDX-License-Identifier: MIT
#include "ode_bridge/held_faces.hpp"

#include <algorithm>
#include <cmath>

#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {
namespace {

// What is within so many tolerances of contact of a held plane lies in it.
constexpr double kInPlane = 10;

const Piece& pieceOf(const Placed& body, int piece) { return body.solid->pieces[static_cast<std::size_t>(piece)]; }

// Of a pair of features the plane of the face, where there is one.
double levelOf(const Placed& a, const Placed& b, const FeaturePair& f, const ContactPoint& c) {
  const auto kind = static_cast<GapKind>(f.kind);
  const auto through = [&](const Placed& body, int face) {
    return c.normal.dot(body.world(body.solid->faces[static_cast<std::size_t>(face)].point) - b.k.x);
  };
  if (familyOfSecond(kind) == Family::face) return through(b, f.b);
  if (familyOfFirst(kind) == Family::face) return through(a, f.a);
  return c.normal.dot(c.point - b.k.x);
}

}  // namespace

HeldFaces::HeldFaces(const Placed& a, const Placed& b, std::span<const FeaturePair> held) {
  planes_.reserve(held.size());
  for (const FeaturePair& f : held) {
    const auto kind = static_cast<GapKind>(f.kind);
    const Side of_a{a, familyOfFirst(kind), f.a}, of_b{b, familyOfSecond(kind), f.b};
    const ContactPoint c = contactAt(a, b, f);
    if (!c.normal.allFinite() || !std::isfinite(c.gap)) continue;
    planes_.push_back({of_a, of_b, c.normal, levelOf(a, b, f, c),
                       kInPlane * touchTolerance(a, b) + std::abs(c.gap)});
  }
}

bool HeldFaces::holds(const Side& side, int piece) {
  const auto features = side.body.solid->featuresOf(pieceOf(side.body, piece), side.family);
  return std::find(features.begin(), features.end(), side.feature) != features.end();
}

// Whether a piece lies beyond a level along n, and goes on doing so: its body does not turn, or its contact is held.
bool HeldFaces::staysBeyond(const Side& side, int piece, const Vec3& n, double level, double room) {
  if (holds(side, piece)) return true;
  const PlacedPiece p{&side.body, &pieceOf(side.body, piece)};
  if (side.body.spin > 0 || p.halfSpace()) return false;
  return -extentAlong(p, -n) - p.piece->radius >= level - room;
}

bool HeldFaces::keepApart(int piece_a, int piece_b) const {
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const double from_a = plane.n.dot(plane.b.body.k.x - plane.a.body.k.x);
    return staysBeyond(plane.a, piece_a, plane.n, plane.level + from_a, plane.room) &&
           staysBeyond(plane.b, piece_b, -plane.n, -plane.level, plane.room);
  });
}

}  // namespace carom::ode_bridge_detail
