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

Solid solidOf(const Body& body) {
  Solid solid;
  const Vec3 center = centerOfMass(body);
  solid.center_rates = centerOfMassRates(body);
  const bool uneven = std::holds_alternative<Compound>(body.shape) && !body.fixed && !body.center_of_mass;
  if (uneven) solid.uneven = std::make_shared<const Shape>(body.shape);
  solids::addShape(solid, body.shape, {Mat3::Identity(), Vec3::Zero() - center, 0, ""});
  const bool centred = center.isZero(0);
  solid.ball = centred && std::holds_alternative<Sphere>(body.shape);
  solid.box = centred && std::holds_alternative<Box>(body.shape);
  solid.plane = std::holds_alternative<Plane>(body.shape);
  if (solid.box) solid.half = 0.5 * std::get<Box>(body.shape).size;
  solids::addNeighbours(solid);
  solids::addTree(solid);
  return solid;
}

}  // namespace carom::ode_bridge_detail
