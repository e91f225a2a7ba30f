// SPDX-License-Identifier: MIT
// Standing cylinders, cones and prisms that slide straight over the edge of a table tip as a box of the same mass, moments
// and height does: where they are held is the same line, whatever the outline. A rim comes to the edge with the foremost
// point of it, where the two run along each other and cross at no angle; and leaves it so with the last.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>

#include "ode_bridge/convex_hull.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::over_edges {
namespace {

using namespace test;

constexpr double kHeight = 0.1, kRadius = 0.2;
constexpr double kAsBox = 1e-9;  // m, m/s, rad and rad/s

Shape uprightPrism(int corners) {
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i)
    for (const double z : {-kHeight / 2, kHeight / 2}) {
      const double a = 2 * std::numbers::pi * i / corners;
      points.push_back({kRadius * std::cos(a), kRadius * std::sin(a), z});
    }
  return Hull{convexHull(points), 1, ""};
}

Scene overTheEdge(const Shape& shape, double heading) {
  Body body = makeBall("body", 1, {-0.6, 0, kHeight / 2}, {2, 0, 0});
  body.shape = shape;
  body.inertia = Inertia::fromMoments({0.0108, 0.0108, 0.02});
  body.center_of_mass = Vec3::Zero();
  body.orientation = Eigen::AngleAxisd(heading, Vec3::UnitZ());
  return makeScene({0, 0, -9.81}, 0, 0.1, {body, fixedBody(makeBox("table", {1, 2, 1}, {-0.5, 0, -0.5}))});
}

TEST(OverEdges, OutlinesOfAllKindsTipAsABox) {
  const Motion box = play(overTheEdge(Box{{0.36, 0.3, kHeight}}, 0), 0.4);
  ASSERT_EQ(box.status, MotionStatus::complete) << box.message;
  const std::array<std::pair<const char*, Shape>, 6> outlines = {{{"cylinder", Cylinder{kRadius, kHeight}},
                                                                  {"cone", Cone{kRadius, kHeight}},
                                                                  {"24 corners", uprightPrism(24)},
                                                                  {"36 corners", uprightPrism(36)},
                                                                  {"7 corners", uprightPrism(7)},
                                                                  {"4 corners", uprightPrism(4)}}};
  double worst = 0;
  for (const auto& [name, shape] : outlines)
    for (const double heading : {0.0, 1e-9, 1e-5, 1e-2, std::numbers::pi / 4}) {
      SCOPED_TRACE(std::string(name) + ", turned by " + std::to_string(heading));
      const Motion m = play(overTheEdge(shape, heading), 0.4);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      for (const double t : {0.2, 0.22, 0.3, 0.33, 0.36, 0.4}) {
        const BodyState is = m.stateAt(0, t), as = box.stateAt(0, t);
        const Quat turned = is.orientation * Quat(Eigen::AngleAxisd(-heading, Vec3::UnitZ()));
        const double off = std::max({(is.position - as.position).norm(), (is.velocity - as.velocity).norm(),
                                     (is.angular_velocity - as.angular_velocity).norm(), 2 * turned.angularDistance(as.orientation)});
        EXPECT_TRUE(off <= kAsBox) << off << " at " << t;
        worst = std::max(worst, off);
      }
    }
  std::printf("off the box by %.2g at most\n", worst);
}

TEST(OverEdges, RimsLeaveWithDerivatives) {
  for (const bool reverse : {false, true}) {
    Scene scene = overTheEdge(Cylinder{kRadius, kHeight}, 0);
    if (reverse) std::swap(scene.bodies[0], scene.bodies[1]);
    const Motion m = play(scene, 0.6);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.world_lines[reverse ? 1 : 0].arcs.back().kind(), ArcKind::flight);
    expectTransposed(m, 1, 1e-11);
  }
}

}  // namespace
}  // namespace carom::over_edges
