// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

// The side is an edge swept by the radius; then come two discs and their rims, first the lower ones.
void addCylinder(PartMaker& part, const Cylinder& s) {
  part.dimension({1 / s.radius, 1 / s.radius, 0}, 1, 1);
  part.dimension(Vec3::UnitZ() / s.height);
  const double r = s.radius, half = 0.5 * s.height;
  for (double z : {-half, half}) part.marks(r, z);
  part.edge(Vec3::Zero(), Vec3::UnitZ(), half).radius = r;
  for (double side : {-1., 1.}) {
    const Vec3 normal = side * Vec3::UnitZ();
    part.face(half * normal, normal).disc = r;
    part.rim(half * normal, normal, r);
  }
  Piece& piece = part.piece(Piece::Core::frustum, Vec3::Zero());
  piece.half_length = half;
  piece.rho = piece.rho_high = r;
  part.takeAll(piece);
}

std::string cylinderName(Family family, int i) {
  switch (family) {
    case Family::vertex:
      return "mark " + std::to_string(i % 4) + " of rim " + signedAxis(i / 4, 2);
    case Family::edge:
      return "side";
    case Family::face:
      return "cap " + signedAxis(i, 2);
    case Family::rim:
      return "rim " + signedAxis(i, 2);
  }
  return {};
}

}  // namespace

SolidKind solidRow(KindOf<Cylinder>) { return {.add = addPart<Cylinder, addCylinder>, .name = cylinderName}; }

}  // namespace carom::solids
