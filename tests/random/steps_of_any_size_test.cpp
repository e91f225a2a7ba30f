// SPDX-License-Identifier: MIT
// Bodies that fall on steps of boxes, in scenes of micrometres to kilometres. CAROM_TEST_SCALE=20 drops 1000.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

// A mesh of a prism, two triangles a side, whose caps are fans.
Shape meshOfPrism(int corners, double radius, double half) {
  std::vector<Vec3> points;
  for (const double z : {-half, half})
    for (int i = 0; i < corners; ++i) {
      const double a = 2 * std::numbers::pi * i / corners;
      points.push_back({radius * std::cos(a), radius * std::sin(a), z});
    }
  std::vector<std::array<int, 3>> triangles;
  for (int i = 1; i + 1 < corners; ++i) triangles.push_back({0, i + 1, i}), triangles.push_back({corners, corners + i, corners + i + 1});
  for (int i = 0; i < corners; ++i) {
    const int j = (i + 1) % corners;
    triangles.push_back({i, j, corners + i}), triangles.push_back({j, corners + j, corners + i});
  }
  return Mesh{meshSurface(points, triangles), 1, ""};
}

// Four steps of boxes and a plane below them.
Scene onSteps(Body body, double unit, double elasticity, double friction) {
  std::vector<Body> bodies;
  for (int i = 0; i < 4; ++i)
    bodies.push_back(fixedBody(makeBox("b" + std::to_string(i), unit * Vec3(2, 12, 1), unit * Vec3(2 * i - 3, 0, -0.5 - i))));
  bodies.push_back(makePlane("p4", Vec3::UnitZ(), -5 * unit));
  bodies.push_back(std::move(body));
  return makeScene({0, 0, -19.62 * unit}, elasticity, friction, bodies);
}

MotionStatus statusOn(const Scene& scene, double duration, std::string& message) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.step_limit = 400'000;
  const Motion m = simulate(scene, contacts, duration, options);
  message = m.message;
  return m.status;
}

// 13-tie-of-edges, handed over: a mesh of a prism of seven sides on steps of 0.17 mm once ended as `unresolved_impact`.
TEST(StepsOfAnySize, ThatWereHandedOver) {
  constexpr double kUnit = 8.732260020015026e-05;
  Body body = makeBall("k0", 1, {2.6204434689458856e-05, -9.722315149427916e-05, 0.0002902434276126287},
                       {-2.3401979904645828e-05, -5.42354656007523e-05, 0.00010214605247497648});
  body.shape = meshOfPrism(7, 0.0001047871202401803, 5.72944692825043e-05);
  body.mass = 0.0001643015648874776;
  body.orientation = Quat(0.1575456553227362, 0.40848741409309963, -0.0002477159530960793, -0.8990647015945341).normalized();
  Scene scene = onSteps(body, kUnit, 0, 0.2);
  scene.materials[0].tangential_elasticity = 1;
  std::string message;
  // it settles in cascades: lowest bounces that are not of its size leave out events
  EXPECT_EQ(statusOn(scene, 10, message), MotionStatus::complete) << message;
}

TEST(StepsOfAnySize, CarryWhatFallsOnThem) {
  std::map<std::string, int> ends;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(4)); ++seed)
    for (const double unit : {1e-6, 8.7e-5, 1e-3, 1.0, 1e3}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", unit " + std::to_string(unit));
      Random r(seed);
      Body body = makeBall("body", unit, unit * Vec3(r.in(-2, 2), r.in(-2, 2), 3.5));
      const int kind = r.below(4);
      if (kind == 0) body.shape = Box{unit * Vec3(r.in(0.5, 2), r.in(0.5, 2), r.in(0.5, 2))};
      if (kind == 1) body.shape = Capsule{unit * r.in(0.3, 1), unit * r.in(0.5, 2)};
      if (kind > 1) body.shape = meshOfPrism(3 + r.below(8), unit * r.in(0.6, 1.5), unit * r.in(0.3, 1));
      body.orientation = r.rotation();
      body.velocity = unit * r.vec(1.5);
      if (r.below(2)) body.angular_velocity = r.vec(3);
      std::string message;
      const MotionStatus status = statusOn(onSteps(body, unit, 0.3 * r.below(3), 0.2 * r.below(3)), 4, message);
      ++ends[nameOf(status)];
      EXPECT_NE(status, MotionStatus::unresolved_impact) << message;
    }
  for (const auto& [what, n] : ends) std::printf("%s %d  ", what.c_str(), n);
  std::printf("\n");
}

}  // namespace
}  // namespace carom
