// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

// One vertex, swept.
void addBall(PartMaker& part, const Sphere& s) {
  part.dimension(Vec3::Zero(), 1);
  part.vertex(Vec3::Zero(), s.radius);
  Piece& piece = part.piece(Piece::Core::point, Vec3::Zero());
  piece.radius = s.radius;
  part.takeAll(piece);
}

}  // namespace

SolidKind solidRow(KindOf<Sphere>) {
  return {.add = addPart<Sphere, addBall>,
          .name = [](Family, int) -> std::string { return "ball"; },
          .whole = &Solid::ball};
}

}  // namespace carom::solids
