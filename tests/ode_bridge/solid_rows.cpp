// SPDX-License-Identifier: MIT
#include "tests/ode_bridge/solid_rows.h"

#include "ode_bridge/convex_hull.h"
#include "tests/support/solids.h"

namespace carom::test {

Shape randomHull(Random& random, int points) {
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(Vec3(0.1, -0.2, 0.05) + random.vec(0.3));
  return Hull{convexHull(cloud), random.in(0.5, 2), ""};
}

Shape bentStrip(double scale) {
  const Triangles strip{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}},
                        {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
  return Mesh{strip.surface(), scale, ""};
}

namespace {

CompoundPart placed(Random& random, const Shape& shape) { return {shape, random.vec(0.4), random.rotation()}; }

}  // namespace

std::vector<SolidRow> solidRows(std::uint64_t seed) {
  Random random(seed);
  const auto size = [&] { return random.in(0.1, 0.9); };
  const Sphere ball{size()};
  const Box box{{size(), size(), size()}};
  const Capsule capsule{size(), size()};
  const Cylinder cylinder{size(), size()};
  const Shape hull = randomHull(random, 40);
  const Shape torus =
      Mesh{torusTriangles(0.5, 0.2, 9, 5).placed(random.rotation(), random.vec(0.5)).surface(), 1.3, ""};
  const Compound pair{{placed(random, box), placed(random, hull)}};
  const Compound nested{{placed(random, cylinder), placed(random, pair),
                         placed(random, Compound{{placed(random, capsule), placed(random, pair)}}),
                         placed(random, ball), placed(random, torus)}};
  const std::vector<std::pair<std::string, Shape>> shapes{
      {"sphere", ball},  {"box", box},    {"capsule", capsule},          {"cylinder", cylinder},
      {"hull", hull},    {"mesh", torus}, {"open mesh", bentStrip(0.7)}, {"compound", pair},
      {"nested", nested},    {"cone", Cone{size(), size()}},
      {"two cones", Compound{{placed(random, Cone{size(), size()}), placed(random, Cone{size(), size()})}}}};
  std::vector<SolidRow> all;
  for (const auto& [name, shape] : shapes) {
    Body body = makeBall(name, 1, {0, 0, 0});
    body.shape = shape;
    body.inertia = Inertia::fromMoments({1, 1, 1});
    all.push_back({name, body});
    all.push_back({name + " fixed", fixedBody(body)});
    body.center_of_mass = random.vec(0.3);
    all.push_back({name + " with a centre of mass", body});
  }
  return all;
}

}  // namespace carom::test
