// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/simulate/simulate.h"
#include "editing/problem/rows/region_rows.hpp"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

/// Bodies that fly, and regions that they are near to.
namespace carom::shape_regions {

using editing_detail::BoundRegion;

inline Motion fly(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  return simulate(scene, contacts, duration);
}

inline Body shaped(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity,
                   const Vec3& spin) {
  Body body;
  body.name = name, body.shape = shape, body.mass = 1, body.position = position, body.velocity = velocity;
  body.angular_velocity = spin;
  return body;
}

inline Vec3 anyVector(test::Random& random, double size) {
  return {random.in(-size, size), random.in(-size, size), random.in(-size, size)};
}

/// One of every kind that can move, in turn.
inline Shape anyShape(test::Random& random, std::uint64_t which) {
  const double size = random.in(0.05, 0.3);
  switch (which % 7) {
    case 0: return Sphere{size};
    case 1: return Capsule{0.3 * size, 2 * size};
    case 2: return Cylinder{size, random.in(0.05, 0.6)};
    case 3: return Cone{size, random.in(0.1, 0.6)};
    case 4: {
      Compound compound;
      compound.parts = {{Box{{size, 0.1, 0.1}}, {0.2, 0, 0}}, {Sphere{0.5 * size}, {-0.2, 0.1, 0}}};
      return compound;
    }
    case 5: {
      std::vector<Vec3> points;
      for (int k = 0; k < 12; ++k) points.push_back(anyVector(random, size + 0.05));
      return Hull{convexHull(points), 1, ""};
    }
    default: return Box{{size, random.in(0.05, 0.4), random.in(0.05, 0.6)}};
  }
}

/// A body that flies past the origin, turning.
inline Scene anyFlight(std::uint64_t seed) {
  test::Random random(seed);
  Body body = shaped("body", anyShape(random, seed), {-1, random.in(-0.6, 0.6), random.in(-0.3, 0.6)},
                     {random.in(1, 3), random.in(-1, 1), random.in(0, 4)}, anyVector(random, seed % 5 == 0 ? 30 : 6));
  body.orientation = Quat(1, random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)).normalized();
  Scene scene;
  scene.bodies = {std::move(body)};
  return scene;
}

inline BoundRegion anyRegion(std::uint64_t seed, Region::Side side) {
  test::Random random(1000 + seed);
  BoundRegion bound{{}, 0.05, 0.95, 0.02};
  bound.region.side = side;
  bound.region.keep = Region::Keep::shape;
  bound.region.shape = Sphere{random.in(0.1, 0.5)};
  if (seed % 2 == 0) bound.region.shape = Box{Vec3(random.in(0.1, 0.8), random.in(0.1, 0.8), random.in(0.1, 0.8))};
  bound.region.position = {random.in(-0.5, 0.8), random.in(-0.3, 0.3), random.in(-0.2, 0.6)};
  bound.region.orientation = Quat(1, random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)).normalized();
  return bound;
}

/// The region as a body that stands still.
inline Body regionBody(const Region& region) {
  Body body;
  body.name = "region", body.fixed = true;
  body.shape = std::visit([](const auto& shape) { return Shape(shape); }, region.shape);
  body.position = region.position, body.orientation = region.orientation;
  return body;
}

}  // namespace carom::shape_regions
