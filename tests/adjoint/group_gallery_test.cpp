// SPDX-License-Identifier: MIT
// What people build first of bodies that move on each other: books, towers, seesaws, racks, dice. All of it keeps apart and gains no energy.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compare.h"
#include "tests/support/group_scenes.h"
#include "tests/support/scenes.h"

namespace carom::groups {
namespace {

using namespace test;

void expectKept(const Motion& m) {
  const Kept kept = keptBy(m);
  EXPECT_TRUE(kept.deepest <= 1e-9) << kept.deepest;
  EXPECT_TRUE(kept.gain <= 1e-12) << kept.gain;
}

Body floorOf() { return fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5})); }

// A book lies on another one that is pushed: they slide on each other, over an edge of the lower one, until they go on as one, and stop.
TEST(GroupGallery, ABookSlidesOverTheEdgeOfAnother) {
  for (const bool reverse : {false, true}) {
    const Body lower = makeBox("lower", {0.3, 0.2, 0.03}, {0, 0, 0.015}, {1.5, 0, 0}), upper = makeBox("upper", {0.2, 0.15, 0.03}, {0, 0, 0.045});
    const Scene scene = inOrder(makeScene(kDown, 0, 0.3, {floorOf(), withMass(lower, 1), withMass(upper, 0.7)}), reverse);
    const Motion m = playGroups(scene, 0.5);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const double a = 0.72 * kG, b = 0.3 * kG, t = 1.5 / (a + b), v = b * t, stop = v / b;
    const double x = 1.5 * t - a * t * t / 2 + v * stop / 2, y = b * t * t / 2 + v * stop / 2;
    expectEntries(m.stateAt(bodyIndex(scene, "lower"), 0.5).position, Vec3(x, 0, 0.015), 1e-12, "lower");
    expectEntries(m.stateAt(bodyIndex(scene, "upper"), 0.5).position, Vec3(y, 0, 0.045), 1e-12, "upper");
    expectKept(m);
  }
}

// Faces of one size that slide off each other in any direction: all four corners leave at once, crossings and the other's corners come in.
TEST(GroupGallery, FacesOfOneSizeSlideOffEachOther) {
  for (const double angle : {0.0, 0.3, 1.1, 2.5}) {
    SCOPED_TRACE(angle);
    Body upper = makeBox("upper", {0.2, 0.2, 0.05}, {0, 0, 0.075}, {0.8 * std::cos(angle), 0.8 * std::sin(angle), 0});
    const Scene scene = makeScene(kDown, 0, 0.4, {floorOf(), withMass(makeBox("lower", {0.2, 0.2, 0.05}, {0, 0, 0.025}), 2), withMass(upper, 0.5)});
    const Motion m = playGroups(scene, 0.3);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    // the lower one rests: 0.4 (2 + 0.5) g holds more than 0.4 0.5 g
    const double s = 0.64 / (2 * 0.4 * kG);
    expectEntries(m.stateAt(2, 0.3).position, Vec3(s * std::cos(angle), s * std::sin(angle), 0.075), 1e-11, "upper");
    expectKept(m);
  }
}

// Ten balls that touch, broken by an eleventh: contacts that forces on a body by itself would let part press by the friction of others.
TEST(GroupGallery, ABallBreaksARack) {
  constexpr double r = 0.028;
  std::vector<Body> bodies = {floorOf()};
  for (int row = 0; row < 4; ++row)
    for (int k = 0; k <= row; ++k)
      bodies.push_back(withMass(makeBall("b" + std::to_string(bodies.size()), r, {row * r * std::sqrt(3.0), (k - row / 2.0) * 2 * r, r}), 0.17));
  Body cue = withMass(makeBall("cue", r, {-0.5, 0.003, r}), 0.17);
  cue.velocity = Vec3(3, 0, 0);
  bodies.push_back(cue);
  const Motion m = playGroups(makeScene(kDown, 0.9, 0.2, bodies), 2);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  expectKept(m);
}

// A plank on a roller with a box on one end, onto the other end of which a ball falls.
TEST(GroupGallery, ASeesaw) {
  Body roller = withMass(makeBox("roller", {1, 1, 1}, {0, 0, 0.05}), 2);
  roller.shape = Cylinder{0.05, 0.2};
  roller.orientation = Quat(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitX()));
  const Scene scene = makeScene(kDown, 0.2, 0.6, {floorOf(), roller, withMass(makeBox("plank", {1, 0.2, 0.02}, {0, 0, 0.11}), 1), withMass(makeBox("load", {0.1, 0.1, 0.1}, {-0.4, 0, 0.17}), 0.5), withMass(makeBall("ball", 0.05, {0.4, 0, 0.8}), 0.5)});
  const Motion m = playGroups(scene, 2);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  expectKept(m);
}

// A board that leans on a heavy box, and pushes it away as it slides down.
TEST(GroupGallery, ABoardSlidesDownABox) {
  Body board = withMass(makeBox("board", {0.02, 0.1, 0.5}, {0.1, 0, 0.2498}), 1);
  board.orientation = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
  const Motion m = playGroups(makeScene(kDown, 0.1, 0.2, {floorOf(), withMass(makeBox("box", {0.1, 0.3, 0.4}, {0.3, 0, 0.2}), 5), board}), 2);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  expectKept(m);
}

}  // namespace
}  // namespace carom::groups
