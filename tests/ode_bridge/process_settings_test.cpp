// SPDX-License-Identifier: MIT
// What a program has set for its process stays: error handlers of the collision library, cache sizes of Eigen.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

// Of the collision library, whose headers belong to ode_bridge.
extern "C" {
void dSetErrorHandler(void (*)(int, const char*, va_list));
void dError(int, const char*, ...);
void dDebug(int, const char*, ...);
}

namespace carom::test {
namespace {

void simulateTwoBoxes() {
  Scene scene;
  scene.materials.push_back({.name = "m", .elasticity = 0.5, .friction = 0.2});
  for (int i = 0; i < 2; ++i) {
    Body box;
    box.name = i == 0 ? "a" : "b", box.material = "m", box.shape = Box{{0.1, 0.1, 0.1}}, box.mass = 1;
    box.position = {0.3 * i, 0, 1}, box.velocity = {i == 0 ? 1.0 : 0.0, 0, 0};
    scene.bodies.push_back(box);
  }
  OdeContacts contacts(scene);
  EXPECT_FALSE(simulate(scene, contacts, 0.5).events.empty());
}

void ownHandler(int number, const char*, va_list) {
  std::fprintf(stderr, "handled here: %d", number);
  std::_Exit(3);
}

TEST(ProcessSettings, ErrorsOfTheProgramsOwnCallsGoToItsHandler) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT((dSetErrorHandler(ownHandler), simulateTwoBoxes(), dError(7, "own")), testing::ExitedWithCode(3), "handled here: 7");
  EXPECT_EXIT((simulateTwoBoxes(), dSetErrorHandler(ownHandler), dError(8, "own")), testing::ExitedWithCode(3), "handled here: 8");
  EXPECT_EXIT((simulateTwoBoxes(), dError(9, "of %s", "nobody")), testing::ExitedWithCode(1), "ODE Error 9: of nobody");
  EXPECT_DEATH((simulateTwoBoxes(), dDebug(10, "of nobody")), "ODE INTERNAL ERROR 10: of nobody");
}

TEST(ProcessSettings, CacheSizesStay) {
  const std::ptrdiff_t l1 = Eigen::l1CacheSize(), l2 = Eigen::l2CacheSize(), l3 = Eigen::l3CacheSize();
  EXPECT_EQ(l1, 32 * 1024);
  EXPECT_EQ(l2, 256 * 1024);
  Eigen::setCpuCacheSizes(16 * 1024, 128 * 1024, 1024 * 1024);
  simulateTwoBoxes();
  EXPECT_EQ(Eigen::l1CacheSize(), 16 * 1024);
  EXPECT_EQ(Eigen::l2CacheSize(), 128 * 1024);
  EXPECT_EQ(Eigen::l3CacheSize(), 1024 * 1024);
  Eigen::setCpuCacheSizes(l1, l2, l3);
}

}  // namespace
}  // namespace carom::test
