// SPDX-License-Identifier: MIT
// Random stacks on random carriers: lifts, turntables, belts that run and turn, belts of lifts, two lifts, two flush belts. They
// ride where the same stack rests on a floor; places are those of the carrier's motion, whatever the order of the bodies, and
// mirrored where the scene is. CAROM_TEST_SCALE=40 plays 2000; CAROM_FIRST_SEED says from where.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::carried_stacks {
namespace {

using namespace test;

const Vec3 kUp = Vec3::UnitZ();

// Bodies of one motion: v of the place x, turning at w there while x goes on at `go`.
struct Ridden {
  Scene scene;
  Vec3 x = Vec3::Zero(), go = Vec3::Zero(), w = Vec3::Zero();
  bool endless = false;
  const char* what = "";
};

Body slab(const char* name, double x, const Vec3& size) { return fixedBody(makeBox(name, size, {x, 0, -size.z() / 2})); }
Body lifted(Body body, const Vec3& v, double omega = 0) {
  body.fixed = false, body.kinematic = true, body.mass.reset();
  body.velocity = v, body.angular_velocity = {0, 0, omega};
  return body;
}

// Boxes on each other, each a little aside.
std::vector<Body> stackOf(Random& random, double length) {
  std::vector<Body> boxes;
  Vec3 at(0.2 * random.vec(1).x(), 0.2 * random.vec(1).y(), 0);
  for (int i = 0, n = 2 + random.below(4); i < n; ++i) {
    const Vec3 size(i == 0 ? length : random.in(0.2, 0.6), random.in(0.2, 0.6), random.in(0.1, 0.3));
    at.z() += size.z() / 2;
    Body box = makeBox("box" + std::to_string(i), size, at);
    box.mass = random.in(0.3, 3);
    if (i > 0) box.orientation = Quat(Eigen::AngleAxisd(random.in(-0.4, 0.4), kUp));
    boxes.push_back(box);
    at += Vec3(random.in(-0.12, 0.12), random.in(-0.12, 0.12), size.z() / 2);
  }
  return boxes;
}

Ridden sceneOf(std::uint64_t seed) {
  Random random(seed);
  Ridden out;
  const int kind = random.below(7);
  const double omega = random.in(-0.8, 0.8), speed = random.in(0.05, 0.3);
  const Vec3 V = random.vec(1), level(speed, 0, 0);
  std::vector<Body> supports;
  switch (kind) {
    case 0: supports = {lifted(slab("lift", 0, {3, 3, 0.2}), V)}, out.go = V, out.endless = true, out.what = "lift"; break;
    case 1: supports = {lifted(slab("table", 0, {3, 3, 0.2}), V, omega)}, out.go = V, out.w.z() = omega, out.endless = true, out.what = "turntable"; break;
    case 2: supports = {slab("belt", 0, {3, 3, 0.2})}, supports[0].surface_velocity = level, out.go = level, out.what = "belt"; break;
    case 3:
      supports = {slab("table", 0, {3, 3, 0.2})}, supports[0].surface_angular_velocity.z() = omega, supports[0].surface_velocity = 0.1 * level;
      out.w.z() = omega, out.x = kUp.cross(Vec3(0.1 * level)) / omega, out.what = "belt that turns";
      break;
    case 4: supports = {lifted(slab("lift", 0, {3, 3, 0.2}), V)}, supports[0].surface_velocity = level, out.go = V + level, out.what = "belt of a lift"; break;
    case 5: supports = {lifted(slab("left", -0.5, {0.3, 2, 0.2}), V), lifted(slab("right", 0.5, {0.3, 2, 0.2}), V)}, out.go = V, out.endless = true, out.what = "two lifts"; break;
    default:
      supports = {slab("first", -1, {2.4, 3, 0.2}), slab("second", 1.2, {2, 3, 0.2})};
      for (Body& body : supports) body.surface_velocity = level;
      out.go = level, out.what = "two belts";
  }
  std::vector<Body> boxes = stackOf(random, kind == 5 ? 1.4 : 0.5);
  for (Body& box : boxes) {
    box.velocity = out.go + out.w.cross(Vec3(box.position - out.x));
    box.angular_velocity = out.w;
  }
  supports.insert(supports.end(), boxes.begin(), boxes.end());
  out.scene = makeScene({0, 0, -9.81}, 0.3, random.in(0.2, 0.9), std::move(supports));
  return out;
}

// On supports that stand.
Scene standing(Scene scene) {
  for (Body& body : scene.bodies) {
    if (body.kinematic) body.kinematic = false, body.fixed = true;
    body.velocity.setZero(), body.angular_velocity.setZero(), body.surface_velocity.setZero(), body.surface_angular_velocity.setZero();
  }
  return scene;
}

Scene mirrored(Scene scene) {
  const auto along = [](Vec3& v) { v.y() = -v.y(); };
  const auto about = [](Vec3& w) { w.x() = -w.x(), w.z() = -w.z(); };
  for (Body& body : scene.bodies) {
    along(body.position), along(body.velocity), along(body.surface_velocity), about(body.angular_velocity), about(body.surface_angular_velocity);
    body.orientation = Quat(body.orientation.w(), -body.orientation.x(), body.orientation.y(), -body.orientation.z());
  }
  return scene;
}

TEST(CarriedStacks, RideWhereTheyRest) {
  const double T = 8;
  int rest = 0, over = 0, falls = 0;
  const char* first = std::getenv("CAROM_FIRST_SEED");
  const std::uint64_t from = first ? std::strtoull(first, nullptr, 10) : 1;
  for (std::uint64_t seed = from; seed < from + static_cast<std::uint64_t>(scaled(50)); ++seed) {
    const Ridden ridden = sceneOf(seed);
    const Scene& scene = ridden.scene;
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + ridden.what);
    Scene reversed = scene;
    std::ranges::reverse(reversed.bodies);
    const Motion floor = playLasting(standing(scene), 0.01), m = playLasting(scene, T), back = playLasting(reversed, T), image = playLasting(mirrored(scene), T);
    const bool stands = floor.status == MotionStatus::complete;
    EXPECT_EQ(back.status, m.status) << m.message << " / " << back.message;
    EXPECT_EQ(image.status, m.status) << m.message << " / " << image.message;
    expectEntries(back.end, m.end, 1e-11, "ends in the other order");
    expectEntries(image.end, m.end, 1e-11, "ends mirrored");
    if (!stands) {
      ++falls;
      EXPECT_NE(m.status, MotionStatus::complete);
      continue;
    }
    const bool ends = m.status != MotionStatus::complete;
    if (ends) {
      ++over;
      EXPECT_FALSE(ridden.endless && ridden.w.isZero(0)) << m.message;
      EXPECT_TRUE(m.message.find("come to its end") != std::string::npos || !ridden.w.isZero(0)) << m.message;
    } else {
      ++rest;
    }
    const double t = m.end;
    const Quat turn(Eigen::AngleAxisd(ridden.w.z() * t, kUp));
    const Vec3 x = ridden.x + t * ridden.go;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Body& body = scene.bodies[b];
      if (body.fixed || body.kinematic) continue;
      const Vec3 at = x + turn * Vec3(body.position - ridden.x);
      const BodyState state = m.stateAt(static_cast<int>(b), t);
      expectEntries(state.position, at, 1e-12, body.name.c_str());
      expectEntries(state.velocity, Vec3(ridden.go + ridden.w.cross(Vec3(at - x))), 1e-12, body.name.c_str());
      expectEntries(state.angular_velocity, ridden.w, 1e-12, body.name.c_str());
    }
  }
  std::printf("%d ride, %d come to an end, %d do not stand\n", rest, over, falls);
  EXPECT_GE(2 * rest, scaled(50) / 2);
}

}  // namespace
}  // namespace carom::carried_stacks
