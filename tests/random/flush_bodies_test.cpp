// SPDX-License-Identifier: MIT
// Examples of fixed bodies that lie flush: what goes over them goes as on one plane. tests/random/cut_ground_test.cpp has
// random ones.

#include <gtest/gtest.h>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

Body tile(const std::string& name, const Vec3& size, const Vec3& top) {
  return fixedBody(makeBox(name, size, {top.x(), top.y(), top.z() - size.z() / 2}));
}

// The same motion on what is fixed and on a plane at 0, also with the bodies listed the other way round.
void expectAsOnPlane(const Vec3& gravity, double elasticity, double friction, const Body& body,
                     std::vector<Body> fixed, double duration) {
  const Scene plain = makeScene(gravity, elasticity, friction, {body, makePlane("plane", Vec3::UnitZ(), 0)});
  const Motion expected = play(plain, duration);
  ASSERT_EQ(expected.status, MotionStatus::complete) << expected.message;
  fixed.push_back(body);
  for (const bool reversed : {false, true}) {
    SCOPED_TRACE(reversed ? "reversed" : "as listed");
    if (reversed) std::ranges::reverse(fixed);
    const Motion m = play(makeScene(gravity, elasticity, friction, fixed), duration);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.impacts, expected.impacts);
    for (const double t : {0.25 * duration, 0.5 * duration, 0.75 * duration, duration}) {
      const double difference =
          (flatten(m.stateAt(body.name, t)) - flatten(expected.stateAt(body.name, t))).cwiseAbs().maxCoeff();
      EXPECT_TRUE(difference <= 1e-11) << difference << " at " << t << " s";
    }
  }
}

const Vec3 kDown{0, 0, -9.81};

TEST(FlushBodies, BallRollsOverTwoTiles) {
  Body ball = makeBall("ball", 0.1, {0, 0, 0.1}, {1, 0, 0});
  ball.angular_velocity = {0, 10, 0};
  expectAsOnPlane(kDown, 0.3, 0.3, ball, {tile("t0", {0.5, 2, 0.2}, {0, 0, 0}), tile("t1", {0.5, 2, 0.2}, {0.5, 0, 0})}, 0.6);
}

TEST(FlushBodies, SmoothBallCrossesASeam) {
  Body ball = makeBall("ball", 0.125, {-0.5, 0, 0.125}, {1, 0, 0});
  ball.angular_velocity = {0, 8, 0};
  expectAsOnPlane(kDown, 0.3, 0, ball, {tile("l", {2, 2, 1}, {-1, 0, 0}), tile("r", {2, 2, 1}, {1, 0, 0})}, 1);
}

TEST(FlushBodies, BallRollsAlongASeamAndOverACorner) {
  std::vector<Body> tiles;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      tiles.push_back(tile("t" + std::to_string(tiles.size()), {1, 1, 0.3}, {x, y, 0}));
  for (const Vec3& v : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, -1, 0)}) {
    Body ball = makeBall("ball", 0.1, Vec3(0, 0, 0.1) - 0.3 * v, v);
    ball.angular_velocity = Vec3::UnitZ().cross(v) / 0.1;
    expectAsOnPlane(kDown, 0.3, 0.3, ball, tiles, 0.6);
  }
}

TEST(FlushBodies, BlockSlidesOverTwoBoxes) {
  const Body block = makeBox("block", {0.4, 0.4, 0.4}, {-0.6, 0, 0.2}, {2, 0, 0});
  expectAsOnPlane(kDown, 0, 0.2, block, {tile("l", {1, 2, 1}, {-0.5, 0, 0}), tile("r", {1, 2, 1}, {0.5, 0, 0})}, 2);
}

TEST(FlushBodies, BlockSlidesFromAPlaneOverASunkBox) {
  const Body block = makeBox("block", {0.4, 0.4, 0.4}, {-0.6, 0, 0.2}, {2, 0, 0});
  expectAsOnPlane(kDown, 0, 0.2, block, {makePlane("ground", Vec3::UnitZ(), 0), tile("r", {1, 2, 1}, {0.5, 0, 0})}, 2);
}

TEST(FlushBodies, BlockSlidesOverAGap) {
  const Body block = makeBox("block", {0.4, 0.4, 0.4}, {-0.6, 0, 0.2}, {2, 0, 0});
  for (const double gap : {1e-3, 0.1}) {
    SCOPED_TRACE(gap);
    expectAsOnPlane(kDown, 0, 0.1, block, {tile("l", {1, 2, 1}, {-0.5, 0, 0}), tile("r", {2, 2, 1}, {1 + gap, 0, 0}), makePlane("low", Vec3::UnitZ(), -1)}, 1.5);
  }
}

TEST(FlushBodies, BallBouncesOnASeam) {
  for (const double beside : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(beside);
    Body ball = makeBall("ball", 0.1, {beside, 0.2, 0.6}, {0, 0.3, 0});
    ball.angular_velocity = {3, 1, 2};
    expectAsOnPlane(kDown, 0.6, 0.3, ball, {tile("l", {1, 2, 1}, {-0.5, 0, 0}), tile("r", {1, 2, 1}, {0.5, 0, 0})}, 1);
  }
}

// A body that stands on a closed mesh to the last bit is in touch with it, and not inside.
TEST(FlushBodies, BlockStandsOnAMesh) {
  const std::vector<Vec3> corners{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {-3, -3, -1}, {3, -3, -1}, {3, 3, -1}, {-3, 3, -1}};
  Body ground = makeBox("ground", {1, 1, 1}, Vec3::Zero());
  ground.shape = Mesh{meshSurface(corners, {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {0, 4, 5}, {0, 5, 1}, {1, 5, 6}, {1, 6, 2},
                                            {2, 6, 7}, {2, 7, 3}, {3, 7, 4}, {3, 4, 0}}), 1, ""};
  expectAsOnPlane(kDown, 0.2, 0.3, makeBox("block", {0.5, 0.4, 0.2}, {0.2, 0.5, 0.1}, {1, 0, 0}), {fixedBody(ground)}, 0.5);
}

// The lower edge of a block lies along a flat inner edge of the mesh.
TEST(FlushBodies, EdgeLiesAlongAFlatEdgeOfAMesh) {
  const std::vector<Vec3> corners{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {-3, 0, 0}, {3, 0, 0}};
  Body ground = makeBox("ground", {1, 1, 1}, Vec3::Zero());
  ground.shape = Mesh{meshSurface(corners, {{0, 1, 5}, {0, 5, 4}, {4, 5, 2}, {4, 2, 3}}), 1, ""};
  for (const double beside : {0.0, 1e-9}) {
    SCOPED_TRACE(beside);
    Body block = makeBox("block", {0.5, 0.25, 0.125}, {-1, 0.125 + beside, 0.0625}, {2, -0.5, 0});
    block.angular_velocity = {0, 0, -1};
    expectAsOnPlane(kDown, 0.2, 0.3, block, {fixedBody(ground)}, 1);
  }
}

// What of tiles moved alone makes of a seam has no derivative; a tile that nothing crosses has one.
TEST(FlushBodies, PosesOfSinglePiecesAreMarked) {
  Body ball = makeBall("ball", 0.1, {-0.4, 0, 0.1}, {1, 0, 0});
  ball.angular_velocity = {0, 10, 0};
  const Scene scene = makeScene(kDown, 0, 0.3, {ball, tile("l", {1, 2, 1}, {-0.5, 0, 0}), tile("r", {1, 2, 1}, {0.5, 0, 0}), tile("far", {1, 2, 1}, {1.5, 0, 0})});
  const Motion m = play(scene, 0.8);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const auto reliableBy = [&](int body) {
    const StateSeed seed = seedOf(0, Instant::at(0.8), 0);
    Reliability r;
    adjoint(m, std::span(&seed, 1), &r);
    r.askPlace(body);
    EXPECT_TRUE(r.reliable || !r.message.empty());
    return r.reliable;
  };
  EXPECT_TRUE(reliableBy(0));
  EXPECT_FALSE(reliableBy(1));
  EXPECT_FALSE(reliableBy(2));
  EXPECT_TRUE(reliableBy(3));
}

// A seam between unlike materials: derivatives through the crossing against differences.
TEST(FlushBodies, CrossesToAnotherMaterial) {
  for (const bool block : {false, true}) {
    SCOPED_TRACE(block ? "block" : "ball");
    Body body = block ? makeBox("body", {0.4, 0.3, 0.2}, {-0.6, 0, 0.1}, {2, 0, 0}) : makeBall("body", 0.1, {-0.4, 0, 0.1}, {2, 0, 0});
    Scene scene = makeScene(kDown, 0, 0.3, {body, tile("l", {1, 2, 1}, {-0.5, 0, 0}), tile("r", {1, 2, 1}, {0.5, 0, 0})});
    scene.materials.push_back(makeMaterial("n", 0, 0.6));
    scene.materials[0].friction = 0.1;
    scene.bodies[2].material = "n";
    const double end = 0.5;
    const Motion m = play(scene, end);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const SceneGradient g = gradientOf(m, 0, end, 0);
    const auto place = [&](double v, double mu, double nu, double shift) {
      Scene s = scene;
      s.bodies[0].velocity.x() += v, s.materials[0].friction += mu, s.materials[1].friction += nu;
      for (const int b : {1, 2}) s.bodies[static_cast<std::size_t>(b)].position.x() += shift;
      return play(s, end).stateAt("body", end).position.x();
    };
    const double h = 1e-5;
    const double by_v = (place(h, 0, 0, 0) - place(-h, 0, 0, 0)) / (2 * h), by_mu = (place(0, h, 0, 0) - place(0, -h, 0, 0)) / (2 * h),
                 by_nu = (place(0, 0, h, 0) - place(0, 0, -h, 0)) / (2 * h), by_x = (place(0, 0, 0, h) - place(0, 0, 0, -h)) / (2 * h);
    EXPECT_TRUE(std::abs(g.bodies[0].velocity.x() - by_v) <= 1e-7) << g.bodies[0].velocity.x() << " " << by_v;
    EXPECT_TRUE(std::abs(g.materials[0].friction - by_mu) <= 1e-7) << g.materials[0].friction << " " << by_mu;
    EXPECT_TRUE(std::abs(g.materials[1].friction - by_nu) <= 1e-7) << g.materials[1].friction << " " << by_nu;
    const double pieces = g.bodies[1].position.x() + g.bodies[2].position.x();
    EXPECT_TRUE(std::abs(pieces - by_x) <= 1e-7) << pieces << " " << by_x;
    EXPECT_TRUE(std::abs(by_nu) > 1e-3 && std::abs(by_x) > 1e-3);
  }
}

// A lip of a micrometre is a step.
TEST(FlushBodies, StepIsMet) {
  Body ball = makeBall("ball", 0.1, {-0.3, 0, 0.1}, {1, 0, 0});
  ball.angular_velocity = {0, 10, 0};
  const Motion m = play(makeScene(kDown, 0, 0.3, {ball, tile("l", {1, 2, 1}, {-0.5, 0, 0}), tile("r", {1, 2, 1}, {0.5, 0, 1e-6})}), 0.6);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_TRUE(m.stateAt("ball", 0.5).velocity.x() < 0.99999) << m.stateAt("ball", 0.5).velocity.x();
  EXPECT_TRUE(m.stateAt("ball", 0.6).position.z() > 0.1 + 0.9e-6) << m.stateAt("ball", 0.6).position.z();
}

}  // namespace
}  // namespace carom
