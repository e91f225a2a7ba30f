// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

// One face without end, which has no dimensions.
void addHalfSpace(PartMaker& part, const Plane& s) {
  part.face(s.offset * s.normal, s.normal);
  part.takeAll(part.piece(Piece::Core::half_space, s.offset * s.normal));
}

}  // namespace

SolidKind solidRow(KindOf<Plane>) {
  return {.add = addPart<Plane, addHalfSpace>,
          .name = [](Family, int) -> std::string { return "plane"; },
          .whole = &Solid::plane};
}

}  // namespace carom::solids
