// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

// The side is an edge swept by the radius; then come two discs and their rims, first the lower ones. A rim that lies
// flat on a face has no point that touches first, so four marks stand on it as vertices: they serve landings that are
// flat exactly, and nothing else, and are nobody's neighbours.
void addCylinder(PartMaker& part, const Cylinder& s) {
  part.dimension({1 / s.radius, 1 / s.radius, 0}, 1, 1);
  part.dimension(Vec3::UnitZ() / s.height);
  const double r = s.radius, half = 0.5 * s.height;
  for (double z : {-half, half})
    for (const Vec3& mark : {Vec3(r, 0, z), Vec3(0, r, z), Vec3(-r, 0, z), Vec3(0, -r, z)}) part.vertex(mark);
  part.edge(Vec3::Zero(), Vec3::UnitZ(), half).radius = r;
  for (double side : {-1., 1.}) {
    const Vec3 normal = side * Vec3::UnitZ();
    part.face(half * normal, normal).disc = r;
    part.rim(half * normal, normal, r);
  }
  Piece& piece = part.piece(Piece::Core::cylinder, Vec3::Zero());
  piece.half_length = half;
  piece.rho = r;
  part.takeAll(piece);
}

}  // namespace carom::solids
