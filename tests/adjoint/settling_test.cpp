// SPDX-License-Identifier: MIT
// How the time at which a ball's bounces come to an end varies: closed forms, differences of motions simulated anew,
// transposed passes, bodies in reverse order.

#include "adjoint/derivative/settling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::settling {
namespace {

using namespace test;

int settlesIn(const Motion& m) {
  const auto found = std::ranges::find_if(m.events, [](const Event& e) { return e.settles_at.has_value(); });
  EXPECT_NE(found, m.events.end()) << m.message;
  return static_cast<int>(found - m.events.begin());
}

// Thrown onto a slope, with spin: it bounces, settles, and rolls on.
Scene slope() {
  Scene s =
      makeScene({0.2, -0.1, -9.81}, 0.4, 0.3,
                {makeBall("ball", 0.1, {0, 0, 0.6}, {0.5, 0.2, 0.3}), makeBox("slab", {6, 6, 0.2}, {0, 0, -0.1})});
  s.bodies[0].angular_velocity = {1, 5, -2};
  s.bodies[1].fixed = true;
  s.bodies[1].orientation = Quat(Eigen::AngleAxisd(0.1, Vec3(0.6, 0.8, 0)));
  return s;
}

double settlesAfter(const Scene& scene) {
  const Motion m = play(scene, 3);
  return m.events[static_cast<std::size_t>(settlesIn(m))].settles_at.value();
}

TEST(Settling, HasTheDerivativesOfTheClosedForm) {
  for (double e : {0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95}) {
    SCOPED_TRACE(e);
    const double height = 0.8, g = 9.81, t1 = std::sqrt(2 * height / g), ratio = (1 + e) / (1 - e);
    const Motion m =
        play(makeScene({0, 0, -g}, e, 0.3,
                       {makeBall("ball", 0.1, {0, 0, height + 0.1}), makePlane("floor", Vec3::UnitZ(), 0)}),
             60);
    DerivativeTape tape(m);
    const SceneGradient d = settlesAtGradient(tape, settlesIn(m));
    expectEntries(d.materials[0].elasticity, 2 * t1 / ((1 - e) * (1 - e)), 1e-11, "by e", t1 / ((1 - e) * (1 - e)));
    expectEntries(d.bodies[0].position.z(), ratio / (g * t1), 1e-11, "by the height", ratio);
    expectEntries(d.bodies[1].position.z(), -ratio / (g * t1), 1e-11, "by that of the floor", ratio);
    expectEntries(d.bodies[0].velocity.z(), 1 / g, 1e-11, "by the speed", ratio);
    expectEntries(d.gravity.z(), 0.5 * ratio * t1 / g, 1e-11, "by gravity", ratio);
    expectEntries(d.materials[0].friction, 0.0, 1e-12, "by friction");
  }
}

TEST(Settling, IsTheLimitOfDifferences) {
  const Scene scene = slope();
  const Motion m = play(scene, 3);
  DerivativeTape tape(m);
  const SceneGradient d = settlesAtGradient(tape, settlesIn(m));
  const auto difference = [&](const auto& change) {
    const auto at = [&](double h) {
      Scene up = scene, down = scene;
      change(up, h), change(down, -h);
      return (settlesAfter(up) - settlesAfter(down)) / (2 * h);
    };
    return (4 * at(1e-3) - at(2e-3)) / 3;
  };
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    const Vec3 axis = Vec3::Unit(k);
    expectEntries(d.gravity[k], difference([&](Scene& s, double h) { s.gravity += h * axis; }), 1e-8, "gravity");
    expectEntries(d.bodies[0].velocity[k], difference([&](Scene& s, double h) { s.bodies[0].velocity += h * axis; }),
                  1e-8, "velocity");
    expectEntries(d.bodies[0].position[k], difference([&](Scene& s, double h) { s.bodies[0].position += h * axis; }),
                  1e-8, "position");
    expectEntries(d.bodies[1].orientation[k], difference([&](Scene& s, double h) {
                    s.bodies[1].orientation = Quat(Eigen::AngleAxisd(h, axis)) * s.bodies[1].orientation;
                  }),
                  1e-8, "slab's turn", 10);
  }
  expectEntries(d.materials[0].elasticity, difference([](Scene& s, double h) { s.materials[0].elasticity += h; }), 1e-8,
                "elasticity", 10);
}

TEST(Settling, IsTransposedInAnyOrderOfBodies) {
  for (bool reversed : {false, true}) {
    Scene scene = slope();
    if (reversed) std::swap(scene.bodies[0], scene.bodies[1]);
    const Motion m = play(scene, 3);
    const std::string before = m.signature();
    DerivativeTape tape(m);
    const int event = settlesIn(m);
    const SceneGradient gradient = settlesAtGradient(tape, event);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      const SceneTangent direction = randomDirection(scene, random);
      const double rate = settlesAtRate(tape, direction, event);
      const double size = flatten(gradient).cwiseAbs().dot(flatten(direction).cwiseAbs());
      EXPECT_TRUE(std::abs(rate - gradient.dot(direction)) <= 1e-13 * size)
          << "seed " << seed << ": " << rate << " " << rate - gradient.dot(direction) << " of " << size;
    }
    EXPECT_EQ(m.signature(), before);
  }
}

TEST(Settling, IsRefusedWhereItIsNotKnown) {
  const Motion m = play(slope(), 3);
  DerivativeTape tape(m);
  EXPECT_THROW(settlesAtGradient(tape, 0), InputError);
  EXPECT_THROW(settlesAtGradient(tape, static_cast<int>(m.events.size())), InputError);
  Scene lift = slope();
  lift.bodies[1].fixed = false;
  lift.bodies[1].kinematic = true;
  for (const double speed : {0.0, 1e-3}) {  // of the lift: at rest it is ground, and the motion goes on
    lift.bodies[1].velocity = {speed, 0, 0};
    const Motion moves = play(lift, 3);
    DerivativeTape tape_of_lift(moves);
    const auto settles = std::ranges::find_if(moves.events, [](const Event& e) { return e.settles_at.has_value(); });
    ASSERT_NE(settles, moves.events.end()) << moves.message;
    EXPECT_THROW(settlesAtGradient(tape_of_lift, static_cast<int>(settles - moves.events.begin())), NotComputable);
  }
}

}  // namespace
}  // namespace carom::settling
