// SPDX-License-Identifier: MIT
// What the directed scenes of docs/gallery.md show: the command solves each, exactly and as it should look.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;

/// An edit of the command, simulated afresh from the file that it wrote.
struct Directed {
  json answer;
  Document document;
  Motion motion;
};

// The first throw that is met will do for the die: a smaller change takes minutes.
Directed direct(const std::string& name) {
  const std::string edited = temporaryPath(name + ".edited.json");
  Directed directed;
  directed.answer =
      runJson({"edit", scenePath(name), "--effort", name == "die-at-rest" ? "fast" : "normal", "-o", edited});
  directed.document = readDocument(edited);
  OdeContacts contacts(directed.document.scene);
  directed.motion = simulate(directed.document.scene, contacts, directed.document.duration);
  return directed;
}

/// The state just before the n-th impact of two bodies.
BodyState before(const Motion& motion, const std::string& name, int n, const std::string& with) {
  const int body = bodyIndex(*motion.scene, name), other = bodyIndex(*motion.scene, with);
  const auto event = motion.findImpact(body, n, other);
  EXPECT_TRUE(event.has_value());
  return motion.stateBefore(event.value_or(0), body);
}

/// The ball is at the end within `reach` of an opening's middle, along both sides, and below `height` of it.
void expectEndsIn(const Motion& motion, const Vec3& middle, double reach, double height) {
  const Vec3 x = motion.stateAt("ball", motion.end).position - middle;
  EXPECT_LE(std::abs(x.x()), reach + 1e-9);
  EXPECT_LE(std::abs(x.y()), reach + 1e-9);
  EXPECT_LT(x.z(), height);
}

class DirectedScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, DirectedScene,
                         testing::Values("book-on-shelf", "hat-on-coatrack", "mug-on-mark", "meeting", "ball-into-cup",
                                         "die-face-down", "only-causes", "curling", "off-the-table", "putt", "bounce",
                                         "rack-of-ten", "rack-of-fifteen", "box-over-edge", "coin", "falling-rod"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

void expectSolvedToItsEnd(const Directed& directed) {
  EXPECT_TRUE(directed.answer["status"].get<std::string>().starts_with("solved")) << directed.answer["message"];
  const auto residual = directed.answer["scaled_residual"].get<double>();
  EXPECT_TRUE(residual <= 1e-9) << residual;
  EXPECT_EQ(directed.motion.status, MotionStatus::complete) << directed.motion.message;
}

TEST_P(DirectedScene, IsSolvedAndItsMotionIsKnownToItsEnd) { expectSolvedToItsEnd(direct(GetParam())); }

TEST(DirectedGallery, TheHatHangsOnThePegAndSpins) {
  const Motion motion = direct("hat-on-coatrack").motion;
  EXPECT_NEAR(motion.stateAt("hat", 0).angular_velocity.y(), 9, 1e-9);
  const BodyState end = motion.stateAt("hat", motion.end);
  const Vec3 tip = end.orientation.conjugate() * (Vec3(-0.1532, 0, 1.5786) - end.position);
  EXPECT_LT(std::hypot(tip.x(), tip.y()), 0.084);
  EXPECT_GT(tip.z(), 0.02);
  EXPECT_LT(tip.z(), 0.108);
}

TEST(DirectedGallery, TheThirdBounceIsOnTheMark) {
  const BodyState mug = before(direct("mug-on-mark").motion, "mug", 3, "table");
  const Vec3 centre = mug.position + mug.orientation * Vec3(0, 0, 0.0475);
  EXPECT_NEAR(centre.x(), 0.4, 1e-9);
  EXPECT_NEAR(centre.y(), -0.05, 1e-9);
}

TEST(DirectedGallery, BallAndCrateMeetAtTheNail) {
  const Motion motion = direct("meeting").motion;
  EXPECT_TRUE(before(motion, "ball", 1, "crate").position.isApprox(Vec3(-0.15, 0, 1.25), 1e-9));
  // Where they touch: a radius further, and half of the crate's height from its centre.
  EXPECT_NEAR(before(motion, "crate", 1, "ball").position.x(), -0.15 + 0.12 + 0.1, 1e-9);
}

TEST(DirectedGallery, TheBallEndsInTheCup) {
  expectEndsIn(direct("ball-into-cup").motion, {0.55, 0, 0}, 0.08 - 0.02, 0.08);
}

TEST(DirectedGallery, TheChosenFaceIsDown) {
  const BodyState die = before(direct("die-face-down").motion, "die", 3, "table");
  EXPECT_LT((die.orientation * Vec3(0, 0, -1)).z(), -0.99);
}

TEST(DirectedGallery, OnlyElasticityAndInertiaChange) {
  const Scene after = direct("only-causes").document.scene;
  const Scene start = readDocument(scenePath("only-causes")).scene;
  for (std::size_t i = 0; i < start.bodies.size(); ++i) {
    EXPECT_EQ(after.bodies[i].position, start.bodies[i].position);
    EXPECT_EQ(after.bodies[i].velocity, start.bodies[i].velocity);
    EXPECT_EQ(after.bodies[i].angular_velocity, start.bodies[i].angular_velocity);
    EXPECT_EQ(after.bodies[i].mass, start.bodies[i].mass);
  }
}

TEST(DirectedGallery, TheStoneRestsOnTheTeeBehindTheGuard) {
  const Motion motion = direct("curling").motion;
  const BodyState end = motion.stateAt("stone", motion.end);
  EXPECT_TRUE(std::hypot(end.position.x() - 10, end.position.y()) <= 1e-9) << end.position.transpose();
  EXPECT_EQ(end.velocity, Vec3(0, 0, 0));
  EXPECT_FALSE(motion.findImpact(2, 1, 1).has_value());
}

TEST(DirectedGallery, TheBallRollsOffTheTableIntoTheCup) {
  expectEndsIn(direct("off-the-table").motion, {1.1, 0.1, 0}, 0.055, 0.08);
}

TEST(DirectedGallery, ThePuttIsAimedUpTheSlopeAndFalls) {
  const Directed putt = direct("putt");
  EXPECT_LT(putt.document.scene.bodies[1].velocity.y(), -0.2);
  expectEndsIn(putt.motion, {3, 0, 0}, 0.0327, -0.05);
}

TEST(DirectedGallery, TheBounceIsThatOfTheClosedForm) {
  const Directed bounce = direct("bounce");
  const double e = bounce.document.scene.materials[0].elasticity, way = 1.65 + 0.5, back = 1.65 + 2;
  EXPECT_NEAR(bounce.document.scene.bodies[2].velocity.x(), (back + e * way) / (0.6 * e), 1e-9);
  EXPECT_EQ(bounce.motion.impacts, 2u);
}

TEST(DirectedGallery, TheLastBallOfTheRackIsAtTheTarget) {
  for (const char* name : {"rack-of-ten", "rack-of-fifteen"}) {
    const Directed rack = direct(name);
    const std::string last = rack.document.scene.bodies.back().name;
    const Vec3 at = rack.motion.stateAt(last, rack.motion.end).position;
    EXPECT_TRUE((at - Vec3(0.9, 0.75, 0)).norm() <= 1e-9) << name << " " << at.transpose();
    EXPECT_GE(rack.motion.impacts, 4u) << name;
  }
}

// Edited only once, which takes long.
TEST(DirectedGallery, TheDieRestsWithTheChosenFaceUp) {
  const Directed directed = direct("die-at-rest");
  expectSolvedToItsEnd(directed);
  const Motion& motion = directed.motion;
  const BodyState end = motion.stateAt("die", motion.end);
  const double up = (end.orientation * Vec3(0, 0, -1)).z();
  EXPECT_TRUE(std::abs(up - 1) <= 1e-12) << up;
  EXPECT_EQ(end.velocity, Vec3(0, 0, 0));
  EXPECT_EQ(end.angular_velocity, Vec3(0, 0, 0));
}

TEST(DirectedGallery, TheBoxTipsOverTheEdgeAndStrikesTheFloorAtTheNail) {
  const Motion motion = direct("box-over-edge").motion;
  const BodyState box = before(motion, "box", 1, "floor");
  EXPECT_TRUE(std::abs(box.position.x() - 0.7) <= 1e-9) << box.position.transpose();
  // It has tipped: its top looks over the edge.
  EXPECT_GT((box.orientation * Vec3::UnitZ()).x(), 0.5);
}

TEST(DirectedGallery, TheCoinRollsOnItsRimToTheNail) {
  const Motion motion = direct("coin").motion;
  const BodyState coin = motion.stateAt("coin", 0.8);
  EXPECT_TRUE(std::hypot(coin.position.x() - 0.12, coin.position.y() - 0.27) <= 1e-9) << coin.position.transpose();
  EXPECT_EQ(motion.world_lines[1].arcs.back().kind(), ArcKind::roll);
}

TEST(DirectedGallery, TheRodComesToLieAtTheNail) {
  const Motion motion = direct("falling-rod").motion;
  const BodyState end = motion.stateAt("rod", motion.end);
  EXPECT_TRUE(std::abs(end.position.x() - 0.2) <= 1e-9) << end.position.transpose();
  EXPECT_TRUE(std::abs(end.position.z() - 0.012) <= 1e-12) << end.position.transpose();
  EXPECT_EQ(end.velocity, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace carom::test
