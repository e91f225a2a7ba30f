// SPDX-License-Identifier: MIT
// Edits by friction from 0 on, against closed forms.

#include "editing/edit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;

// Thrown along a floor 1 m below.
Scene ballWithoutFriction() {
  Scene scene;
  scene.gravity = {0, 0, -10};
  scene.materials = {material("m", 0.5, 0)};
  scene.bodies = {fixedPlane("floor", "m", Vec3::UnitZ(), -1), ball("s", "m", 0.1, {0, 0, 0}, {3, 0, 0})};
  return scene;
}

// x = 3 T - mu (1 + e) sqrt(18) (T - sqrt(0.18)): the coefficient may grow from 0, and the impacts stay the same.
TEST(Edit, FrictionGrowsFromZero) {
  const Scene scene = ballWithoutFriction();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(friction("m"));
  edit.nail("s", 0.6).position({1.7, any, any});
  const EditResult r = edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved) << r.message;
  expectHonest(r, 1, contacts);
  EXPECT_TRUE(std::abs(r.changed[0].after - 0.1 / (1.5 * std::sqrt(18.0) * (0.6 - std::sqrt(0.18)))) <= 1e-9);
  EXPECT_FALSE(r.signature_changed);
  EXPECT_TRUE(r.reliability.reliable) << r.reliability.message;
}

// The same ball, asked to come slower than one that sticks, which keeps 5/7 of its speed: it cannot, and comes so near.
TEST(Edit, FrictionStopsAtSticking) {
  const Scene scene = ballWithoutFriction();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(friction("m"));
  edit.nail("s", 0.6).position({1.5, any, any});
  const EditResult r = edit.solve();
  EXPECT_FALSE(r.solved());
  const double sticking = 3 * std::sqrt(0.18) + 15.0 / 7 * (0.6 - std::sqrt(0.18));
  EXPECT_TRUE(std::abs(r.residual - (sticking - 1.5)) <= 1e-9) << r.residual;
}

// A ball that falls straight down slips with nothing: the derivative by friction says so, and only where it is asked for.
TEST(Edit, FrictionWithoutSlipIsMarked) {
  Scene scene;
  scene.gravity = {0, 0, -10};
  scene.materials = {material("m", 0.5, 0)};
  scene.bodies = {fixedPlane("floor", "m", Vec3::UnitZ(), -1), ball("s", "m", 0.1, {0, 0, 0}, {0, 0, 0})};
  OdeContacts contacts(scene);
  for (const bool asked : {false, true}) {
    Edit edit(scene, contacts, 1);
    edit.vary(elasticity("m"));
    if (asked) edit.vary(friction("m"));
    edit.nail("s", 0.6).position({any, any, -0.7});
    const EditResult r = edit.solve();
    EXPECT_TRUE(r.solved()) << r.message;
    EXPECT_EQ(r.reliability.reliable, !asked || r.scene.materials[0].friction > 0) << r.reliability.message;
  }
}

}  // namespace
}  // namespace carom
