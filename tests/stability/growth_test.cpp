// SPDX-License-Identifier: MIT
// Small changes that grow over many impacts: the gradient stays exact while it grows, and says what an edit can rest
// on.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

// A ball among five fixed ones between four walls.
Scene pinball() {
  std::vector<Body> bodies = {makePlane("left", {1, 0, 0}, -0.5), makePlane("right", {-1, 0, 0}, -0.5),
                              makePlane("near", {0, 1, 0}, -0.5), makePlane("far", {0, -1, 0}, -0.5)};
  int number = 0;
  for (const Vec3& place :
       {Vec3(0.02, 0.01, 0), Vec3(-0.3, 0.28, 0), Vec3(0.27, 0.31, 0), Vec3(-0.29, -0.3, 0), Vec3(0.31, -0.27, 0)})
    bodies.push_back(fixedBody(makeBall("post " + std::to_string(++number), 0.1, place)));
  bodies.push_back(makeBall("ball", 0.03, {-0.4, 0.03, 0}, {0.9, 0.31, 0}));
  return makeScene(Vec3::Zero(), 1, 0, bodies);
}

double endAfter(const Scene& scene, std::size_t impacts) {
  const Motion m = play(scene, 60, impacts + 1);
  return 0.5 * (m.events.at(impacts - 1).time + m.events.at(impacts).time);
}

TEST(Growth, AdjointAndTangentAgreeOverTwentyImpacts) {
  const Scene scene = pinball();
  double before = 0;
  for (const std::size_t impacts : {2u, 6u, 12u, 20u}) {
    SCOPED_TRACE(impacts);
    const double end = endAfter(scene, impacts);
    const Motion m = play(scene, end);
    ASSERT_EQ(m.impacts, impacts);
    const int ball = bodyIndex(scene, "ball");
    const SceneGradient g = gradientOf(m, ball, end, 0);
    SceneTangent direction(scene);
    direction.bodies[static_cast<std::size_t>(ball)].velocity = {0.3, -0.7, 0};
    DerivativeTape tape(m);
    const double rate = tangent(tape, direction).at(ball, Instant::at(end)).position.x();
    const double growth = g.bodies[static_cast<std::size_t>(ball)].velocity.norm() / end;
    expectEntries(g.dot(direction) / growth, rate / growth, 1e-11, "rate over growth");
    EXPECT_GT(growth, before);
    before = growth;
  }
  EXPECT_GT(before, 1e8);
}

// Five centimetres at the end, twelve impacts away: small changes grow a million times.
TEST(Growth, EditsReachAcrossTwelveImpacts) {
  const Scene scene = pinball();
  const double end = endAfter(scene, 12);
  const Vec3 place = play(scene, end).stateAt("ball", end).position;
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, end);
  edit.vary(velocity("ball").only({"x", "y"}));
  edit.nail("ball", end).position(place.x() + 0.03, place.y() - 0.04, any);
  EditOptions options;
  options.tolerance = 1e-6;  // of the ball's size: the end of the motion knows the throw's sixteen digits no better
  options.certify = options.explain = false;
  const EditResult result = edit.solve(options);
  EXPECT_TRUE(result.solved()) << result.message;
  EXPECT_TRUE(result.growth > 1e4) << result.growth;
}

}  // namespace
}  // namespace carom
