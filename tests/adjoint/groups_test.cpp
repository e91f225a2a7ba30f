// SPDX-License-Identifier: MIT
// Bodies that move on each other in lasting contact (SimulateOptions::groups): motions with a closed form, in both orders of the bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/motion/body_geometry.h"
#include "adjoint/second_order/second_order.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/group_scenes.h"
#include "tests/support/scenes.h"

namespace carom::groups {
namespace {

using namespace test;

// 1 kg at 2 m/s on a plank of 4 kg on ice, mu 0.25: they go on as one after 2 * 4/(5 mu g) s.
TEST(Groups, ABoxComesToRestOnAPlankOnIce) {
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(boxOnPlank(), reverse);
    const Motion m = playGroups(scene, 1);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    const double t = 0.652395514780836;
    expectEntries(m.events[1].time, t, 1e-12, "as one");
    const int box = bodyIndex(scene, "box"), plank = bodyIndex(scene, "plank");
    expectEntries(m.stateAt(plank, t).position.x(), 1 + 0.130479102956167, 1e-12, "plank");
    expectEntries(m.stateAt(box, t).position.x(), 0.652395514780836 + 0.130479102956167, 1e-12, "box");
    expectEntries(m.stateAt(box, 1).velocity, Vec3(0.4, 0, 0), 1e-12, "velocity");
    expectEntries(m.stateAt(plank, 1).velocity, Vec3(0.4, 0, 0), 1e-12, "velocity");
  }
}

// A ball without spin on a box on ice: v' = -mu g, V' = mu g/3, slip v - V - r w comes to 0.
TEST(Groups, ABallRollsOnABoxOnIce) {
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(ballOnBox(), reverse);
    const Motion m = playGroups(scene, 1);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    expectEntries(m.events[1].time, 12 / (23 * 0.3 * kG), 1e-12, "rolls");
    const int ball = bodyIndex(scene, "ball"), box = bodyIndex(scene, "box");
    expectEntries(m.stateAt(ball, 1).velocity, Vec3(34.0 / 23, 0, 0), 1e-12, "ball");
    expectEntries(m.stateAt(box, 1).velocity, Vec3(4.0 / 23, 0, 0), 1e-12, "box");
    expectEntries(m.stateAt(ball, 1).angular_velocity, Vec3(0, 300.0 / 23, 0), 1e-11, "spin");
  }
}

// Three smooth balls of radius 0.5, one on two that touch: they part where c^3 + 3 c = sqrt 3, c the cosine at the centres.
TEST(Groups, ThreeSmoothBallsPart) {
  const double high = std::sqrt(3.0) / 2;
  for (const bool reverse : {false, true}) {
    Scene scene = sceneOf(0.4, {iceFloor(), onIce(withMass(makeBall("left", 0.5, {-0.5, 0, 0.5}), 1)), onIce(withMass(makeBall("right", 0.5, {0.5, 0, 0.5}), 1)),
                                onIce(withMass(makeBall("top", 0.5, {0, 0, 0.5 + high}), 1))});
    if (reverse) std::ranges::reverse(scene.bodies);
    const Motion m = playGroups(scene, 0.6);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_GE(m.events.size(), 2u);
    const double t = 0.533412282614424;
    expectEntries(m.events[1].time, t, 1e-12, "part");
    expectEntries(m.stateAt(bodyIndex(scene, "right"), t).velocity, Vec3(1.20242940289817, 0, 0), 1e-12, "right");
    expectEntries(m.stateAt(bodyIndex(scene, "left"), t).velocity, Vec3(-1.20242940289817, 0, 0), 1e-12, "left");
    expectEntries(m.stateAt(bodyIndex(scene, "top"), t).velocity, Vec3(0, 0, -1.93287976401659), 1e-12, "top");
    for (const double at : {0.2, 0.4, 0.6}) expectEntries(energyOf(m, at), energyOf(m, 0), 1e-12, "energy");
  }
}

// 1 kg on 2 kg down a slope of 0.3 rad, mu 0.1 below: as one where mu between is 0.2, each by itself where it is 0.05.
TEST(Groups, TwoBlocksSlideDown) {
  const double a = 0.3, T = 0.5;
  const auto sliding = [&](double between, bool reverse) {
    Scene scene = sceneOf(between, {fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5})), withMass(makeBox("low", {2, 1, 0.2}, {0, 0, 0.1}), 2),
                                    withMass(makeBox("high", {0.5, 0.5, 0.2}, {0, 0, 0.3}), 1)},
                          kG * Vec3(std::sin(a), 0, -std::cos(a)));
    scene.materials[1].friction = 0.1;
    scene.materials[1].combine_friction = Combine::minimum;
    scene.bodies[0].material = "ice";
    if (between < 0.1) {  // the floor's 0.1 is not the least there
      scene.materials[0].combine_friction = Combine::maximum;
      scene.materials[1].combine_friction = Combine::maximum;
    }
    if (reverse) std::ranges::reverse(scene.bodies);
    return scene;
  };
  for (const bool reverse : {false, true}) {
    const Scene one = sliding(0.2, reverse), two = sliding(0.05, reverse);
    const Motion m = playGroups(one, T), n = playGroups(two, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(n.status, MotionStatus::complete) << n.message;
    for (const char* name : {"low", "high"}) expectEntries(m.stateAt(bodyIndex(one, name), T).velocity.x(), 1.96186813151552 * T, 1e-12, name);
    expectEntries(n.stateAt(bodyIndex(two, "high"), T).velocity.x(), 2.43046067943163 * T, 1e-12, "high");
    expectEntries(n.stateAt(bodyIndex(two, "low"), T).velocity.x(), 1.72757185755747 * T, 1e-12, "low");
  }
}

// A plank of 2 kg on two rollers of 1 kg on a slope of 0.1 rad: 12/11 g sin 0.1.
TEST(Groups, APlankRollsOnRollers) {
  const double T = 0.4;
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(plankOnRollers(), reverse);
    const Motion m = playGroups(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    expectEntries(m.stateAt(bodyIndex(scene, "plank"), T).velocity, Vec3(1.06839907342405 * T, 0, 0), 1e-12, "plank");
    expectEntries(m.stateAt(bodyIndex(scene, "front"), T).velocity, Vec3(1.06839907342405 * T / 2, 0, 0), 1e-12, "roller");
    expectEntries(energyOf(m, T), energyOf(m, 0), 1e-12, "energy");
  }
}

// Four thin boxes in a row: each that falls meets the next, and pushes it over while it slides down on it.
TEST(Groups, DominoesFall) {
  const Scene scene = dominoRow(4);
  const double T = 0.3;
  const Motion m = playGroups(scene, T);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  for (int b = 1; b < 5; ++b) EXPECT_LT(m.stateAt(b, T).position.z(), 0.0245) << "d" << b - 1;
  const auto* geometry = dynamic_cast<const BodyGeometry*>(m.geometry.get());
  ASSERT_TRUE(geometry);
  double before = energyOf(m, 0);
  for (int i = 1; i <= 50; ++i) {
    const double t = T * i / 50, energy = energyOf(m, t);
    EXPECT_LE(energy, before + 1e-13);
    before = energy;
    for (int a = 0; a < 5; ++a)
      for (int b = a + 1; b < 5; ++b) {
        const auto pose = [&](int body) {
          const BodyState s = m.stateAt(body, t);
          return Pose{s.position, s.orientation.toRotationMatrix()};
        };
        EXPECT_LE(geometry->overlap(a, b, pose(a), pose(b)), 1e-11) << a << " and " << b << " at " << t;
      }
  }
}

// Without them motions end, and second derivatives are not there yet.
TEST(Groups, CanBeLeftOut) {
  const Scene scene = boxOnPlank();
  const Motion m = playGroups(scene, 0.5);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_FALSE(hasSecondOrder(m));
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.groups = false;
  EXPECT_EQ(simulate(scene, contacts, 0.5, options).status, MotionStatus::unresolved_contact);
}

}  // namespace
}  // namespace carom::groups
