// SPDX-License-Identifier: MIT
// The worlds of one_body_worlds.h seen from a frame that moves uniformly: every ground becomes a kinematic body, and what has a
// closed form on ground that stands still is integrated on one that moves. Where the same impacts happen, states are the same.
// Left out are grounds that are cut: flush pieces that move are not one ground. CAROM_TEST_SCALE=40 plays 2000; CAROM_FIRST_SEED says from where.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "adjoint/base/errors.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/random/one_body_worlds.h"
#include "tests/support/compare.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::one_body_worlds {
namespace {

using namespace test;

constexpr double kFollowed = 0.8;  // s
constexpr std::size_t kStepLimit = 300'000;

// A half-space cannot move: slabs in place of them.
Scene withSlabs(Scene scene) {
  for (Body& body : scene.bodies) {
    const auto* plane = std::get_if<Plane>(&body.shape);
    if (!plane) continue;
    const Vec3 n = plane->normal;
    body.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), n);
    body.position = n * (plane->offset - 5);
    body.shape = Box{Vec3(300, 300, 10)};
  }
  return scene;
}

// All bodies at the same velocity.
Scene carriedBy(const Vec3& V, Scene scene) {
  for (Body& body : scene.bodies) {
    if (body.fixed) body.fixed = false, body.kinematic = true;
    body.velocity += V;
  }
  return scene;
}

Motion followed(const Scene& scene) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.step_limit = kStepLimit;
  return simulate(scene, contacts, kFollowed, options);
}

double largestTangent(const Motion& m, int body) {
  double largest = 1;
  for (int i = 0; i < 12; ++i) {
    const BodyDerivative d = gradientOf(m, body, m.end, i).bodies[static_cast<std::size_t>(body)];
    for (const Vec3& of : {d.position, d.orientation, d.velocity, d.angular_velocity}) largest = std::max(largest, of.cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(MovingFrames, ChangeNothing) {
  int played = 0, ended = 0, others = 0, compared = 0;
  double worst = 0;
  const char* first = std::getenv("CAROM_FIRST_SEED");
  const std::uint64_t from = first ? std::strtoull(first, nullptr, 10) : 1;
  for (std::uint64_t seed = from; seed < from + static_cast<std::uint64_t>(scaled(50)); ++seed) {
    World world = worldOf(seed);
    if (world.what.find("cut") != std::string::npos) continue;
    world.scene = withSlabs(world.scene);
    const Vec3 V = Random(seed).vec(1);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + world.what + ", e " + std::to_string(world.scene.materials[0].elasticity) +
                 ", mu " + std::to_string(world.scene.materials[0].friction));
    const Motion a = followed(world.scene), b = followed(carriedBy(V, world.scene));
    ++played;
    if (a.status != MotionStatus::complete) continue;
    if (b.status != MotionStatus::complete) {
      ++ended;
      std::printf("  seed %d (%s) ends: %s\n", static_cast<int>(seed), world.what.c_str(), b.message.c_str());
      continue;
    }
    if (a.impacts != b.impacts) {
      ++others;
      continue;
    }
    const auto moved = std::ranges::find_if(world.scene.bodies, [](const Body& of) { return !of.fixed; });
    const int body = static_cast<int>(moved - world.scene.bodies.begin());
    double largest = 0;
    try {
      largest = largestTangent(a, body);
    } catch (const NotComputable&) {
      continue;
    }
    ++compared;
    Eigen::Matrix<double, 12, 1> change = changeOf(a.stateAt(body, kFollowed), b.stateAt(body, kFollowed));
    change.head<3>() -= V * kFollowed, change.segment<3>(6) -= V;
    worst = std::max(worst, change.cwiseAbs().maxCoeff() / largest);
    expectEntries(change, Eigen::Matrix<double, 12, 1>::Zero(), 1e-11 * largest, "state");
  }
  std::printf("%d worlds, %d compared, worst %.2g of the largest tangent; %d end on moving ground alone, %d have other impacts\n", played,
              compared, worst, ended, others);
  EXPECT_GE(4 * compared, played);
}

}  // namespace
}  // namespace carom::one_body_worlds
