// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

// Marks of the rim and the apex, the side as a tapered edge, the base and its rim.
void addCone(PartMaker& part, const Cone& s) {
  const double r = s.radius, half = 0.5 * s.height;
  part.dimension({1 / r, 1 / r, 0}, 0, 1);
  part.dimension(Vec3::UnitZ() / s.height, 0, 0, 0.5);
  part.marks(r, -half);
  part.vertex({0, 0, half});
  SolidEdge& side = part.edge(Vec3::Zero(), Vec3::UnitZ(), half);
  side.rim = r;
  side.apex = half;
  part.face({0, 0, -half}, -Vec3::UnitZ()).disc = r;
  part.rim({0, 0, -half}, -Vec3::UnitZ(), r);
  Piece& piece = part.piece(Piece::Core::frustum, Vec3::Zero());
  piece.half_length = half;
  piece.rho = r;
  part.takeAll(piece);
}

std::string coneName(Family family, int i) {
  switch (family) {
    case Family::vertex:
      return i == 4 ? "apex" : "mark " + std::to_string(i) + " of rim";
    case Family::edge:
      return "side";
    case Family::face:
      return "base";
    case Family::rim:
      return "rim";
  }
  return {};
}

}  // namespace

SolidKind solidRow(KindOf<Cone>) { return {.add = addPart<Cone, addCone>, .name = coneName}; }

}  // namespace carom::solids
