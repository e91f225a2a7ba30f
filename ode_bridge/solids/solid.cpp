// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/solid.hpp"

#include "adjoint/scene/body_model.h"
#include "ode_bridge/solids/parts.hpp"

namespace carom::ode_bridge_detail {

const Feature& Solid::feature(Family family, int index) const {
  const auto i = static_cast<std::size_t>(index);
  switch (family) {
    case Family::edge:
      return edges[i];
    case Family::face:
      return faces[i];
    case Family::rim:
      return rims[i];
    case Family::vertex:
      break;
  }
  return vertices[i];
}

std::size_t Solid::count(Family family) const {
  return std::array{vertices.size(), edges.size(), faces.size(), rims.size()}[static_cast<std::size_t>(family)];
}

Solid solidOf(const Body& body) {
  Solid solid;
  const Vec3 center = centerOfMass(body);
  solid.center_rates = centerOfMassRates(body);
  if (kindOf(body.shape).of_parts && !body.fixed && !body.center_of_mass)
    solid.uneven = std::make_shared<const Shape>(body.shape);
  solids::addShape(solid, body.shape, {Mat3::Identity(), Vec3::Zero() - center, 0, ""});
  const auto whole = solids::rowOf(body.shape).whole;
  if (whole && center.isZero(0)) solid.*whole = true;
  if (solid.box) solid.half = solid.vertices.back().point;
  solids::addNeighbours(solid);
  solids::addTree(solid);
  return solid;
}

}  // namespace carom::ode_bridge_detail
