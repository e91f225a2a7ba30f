// SPDX-License-Identifier: MIT
#include "adjoint/scene/body_model.h"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/gaps.hpp"

namespace carom {

using namespace ode_bridge_detail;

namespace {

// What lies inside a closed mesh without touching it overlaps, by a depth that its triangles do not tell.
Shape withHulls(const Shape& shape) {
  if (const auto* mesh = std::get_if<Mesh>(&shape); mesh && mesh->surface && mesh->surface->closed)
    return Hull{convexHull(mesh->surface->vertices), mesh->scale, ""};
  const auto* compound = std::get_if<Compound>(&shape);
  if (!compound) return shape;
  Compound with = *compound;
  for (CompoundPart& part : with.parts) part.shape = withHulls(part.shape);
  return with;
}

// The centre of mass stays that of the body as written, and so do its rates.
Solid solidWithHulls(const Body& body) {
  Body with = body;
  with.shape = withHulls(body.shape);
  if (!body.fixed) with.center_of_mass = centerOfMass(body);
  Solid solid = solidOf(with);
  solid.center_rates = centerOfMassRates(body);
  if (kindOf(body.shape).of_parts && !body.fixed && !body.center_of_mass)
    solid.uneven = std::make_shared<const Shape>(body.shape);
  return solid;
}

}  // namespace

std::shared_ptr<const ContactGeometry> FeatureGeometry::ofTwo(const Body& first, const Body& second) const {
  std::vector<Solid> solids;
  solids.push_back(solidWithHulls(first));
  solids.push_back(solidWithHulls(second));
  return std::make_shared<FeatureGeometry>(std::move(solids));
}

}  // namespace carom
