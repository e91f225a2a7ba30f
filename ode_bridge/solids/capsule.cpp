// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

// Two vertices and the edge between them, swept.
void addCapsule(PartMaker& part, const Capsule& s) {
  part.dimension(Vec3::Zero(), 1);
  part.dimension(Vec3::UnitZ() / s.height);
  const double half = 0.5 * s.height;
  const int low = part.vertex({0, 0, -half}, s.radius), high = part.vertex({0, 0, half}, s.radius);
  SolidEdge& e = part.edge(Vec3::Zero(), Vec3::UnitZ(), half);
  e.radius = s.radius;
  e.from = low;
  e.to = high;
  Piece& piece = part.piece(Piece::Core::segment, Vec3::Zero());
  piece.radius = s.radius;
  part.takeAll(piece);
}

std::string capsuleName(Family family, int i) { return family == Family::edge ? "side" : "end " + signedAxis(i, 2); }

}  // namespace

SolidKind solidRow(KindOf<Capsule>) { return {.add = addPart<Capsule, addCapsule>, .name = capsuleName}; }

}  // namespace carom::solids
