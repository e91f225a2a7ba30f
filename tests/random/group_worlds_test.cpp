// SPDX-License-Identifier: MIT
// Two to five balls, boxes, cylinders and capsules that fall on a floor and on each other, and move on each other from there. Whatever they
// come to, none goes into another by 1e-9 m, and energy does not grow by 1e-12 of itself; prints how those end that are not complete.
// CAROM_TEST_SCALE=8 plays 200; CAROM_FIRST_SEED says from where.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "adjoint/flight/trajectory.hpp"
#include "tests/support/group_scenes.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::group_worlds {
namespace {

using namespace test;

constexpr double kPlayed = 1.5;  // s

struct World {
  std::string what;
  Scene scene;
};

World worldOf(std::uint64_t seed) {
  Random random(seed);
  const double elasticities[] = {0, 0.3, 0.5, 0.8}, frictions[] = {0, 0.2, 0.5, 1};
  const double e = elasticities[static_cast<int>(random.in(0, 4))], mu = frictions[static_cast<int>(random.in(0, 4))];
  const int count = 2 + static_cast<int>(random.in(0, 4));
  World world;
  std::vector<Body> bodies = {fixedBody(makeBox("floor", {10, 10, 1}, {0, 0, -0.5}))};
  for (int i = 0; i < count; ++i) {
    const double radius = random.in(0.1, 0.3), x = random.in(-0.15, 0.15), y = random.in(-0.15, 0.15);
    Body body = makeBall("b" + std::to_string(i), radius, {x, y, 0.4 + 0.7 * i});
    const double a = random.in(0.1, 0.25), b = random.in(0.1, 0.25), c = random.in(0.1, 0.5);
    const int kind = static_cast<int>(random.in(0, 4));
    if (kind == 1) body.shape = Box{{2 * a, 2 * b, c}};
    if (kind == 2) body.shape = Cylinder{a, c};
    if (kind == 3) body.shape = Capsule{0.8 * a, 0.8 * c};
    body.mass = random.in(0.5, 3);
    const double turned = random.in(0, 1);
    const Quat turn = random.rotation();
    if (kind > 0 && turned < 0.7) body.orientation = turn;
    body.velocity = random.vec(0.5);
    body.angular_velocity = random.vec(2);
    bodies.push_back(body);
    world.what += "obly"[kind];
  }
  world.scene = makeScene(groups::kDown, e, mu, std::move(bodies));
  return world;
}

std::string saidBy(const Motion& motion) {
  std::string out;
  for (const char c : motion.message)
    if (!(c >= '0' && c <= '9') && c != '.' && c != '-') out += c;
  return std::string(nameOf(motion.status)) + ": " + out.substr(0, 300);
}

TEST(GroupWorlds, KeepApartAndGainNoEnergy) {
  std::map<std::string, std::string> ends;
  int played = 0, complete = 0, grouped = 0;
  double deepest = 0, most = 0;
  const char* first = std::getenv("CAROM_FIRST_SEED");
  const std::uint64_t from = first ? std::strtoull(first, nullptr, 10) : 1;
  for (std::uint64_t seed = from; seed < from + static_cast<std::uint64_t>(scaled(25)); ++seed) {
    const World world = worldOf(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + world.what + ", e " + std::to_string(world.scene.materials[0].elasticity) + ", mu " +
                 std::to_string(world.scene.materials[0].friction));
    const Motion m = groups::playGroups(world.scene, kPlayed);
    ++played;
    const auto [deep, gain] = groups::keptBy(m);
    EXPECT_TRUE(deep <= 1e-9) << deep << " m; " << m.message;
    EXPECT_TRUE(gain <= 1e-12) << gain << "; " << m.message;
    deepest = std::max(deepest, deep), most = std::max(most, gain);
    grouped += std::ranges::any_of(m.world_lines, [](const WorldLine& line) {
      return std::ranges::any_of(line.arcs, [](const Arc& arc) { return arc.trajectory().group() != nullptr; });
    });
    if (m.status == MotionStatus::complete) ++complete;
    else ends[saidBy(m)] += " " + std::to_string(seed);
  }
  std::printf("%d worlds, %d with groups, %d complete; deepest %.2g m, energy %.2g\n", played, grouped, complete, deepest, most);
  for (const auto& [what, seeds] : ends) std::printf("  %s:%s\n", what.c_str(), seeds.c_str());
}

// Worlds that ended before their time: impacts found at once where bodies part and come back (91), contacts that begin to slip without moving, and
// ends that no step is short enough for (the others).
TEST(GroupWorlds, GoOnWhereTheyOnceEnded) {
  for (const std::uint64_t seed : {2, 50, 68, 91, 180}) {
    const World world = worldOf(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + world.what);
    const Motion m = groups::playGroups(world.scene, kPlayed);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    const auto [deep, gain] = groups::keptBy(m);
    EXPECT_TRUE(deep <= 1e-9) << deep;
    EXPECT_TRUE(gain <= 1e-12) << gain;
  }
}

}  // namespace
}  // namespace carom::group_worlds
