// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "ode_bridge/ode_contacts.h"
#include "tests/random/scenes.h"
#include "tests/random/solid.h"

// Two bodies are found to overlap at the start exactly when they do, as tests/random/solid.h sees it.

namespace carom::brute {
namespace {

bool overlaps(const Scene& scene) { return !OdeContacts(scene).overlaps().empty(); }

// Least separation of all pairs that are not both fixed, m.
Real leastSeparation(const Scene& scene) {
  Real least = 1e30L;
  const auto place = [](const Body& b) {
    return Placement{widen(b.position), b.orientation.cast<Real>().normalized().toRotationMatrix()};
  };
  for (const Body& a : scene.bodies)
    for (const Body& b : scene.bodies)
      if (&a < &b && !(a.fixed && b.fixed))
        least = std::min(least, separation(solidOf(a.shape), place(a), solidOf(b.shape), place(b)).value);
  return least;
}

TEST(Overlap, isFoundExactly) {
  int overlapping = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Scene scene = randomScene(1 + seed % 50).scene;
    std::mt19937_64 engine(seed);
    const auto uniform = [&] { return 2 * static_cast<double>(engine() >> 11) * 0x1p-53 - 1; };
    Body& moved = scene.bodies.back();
    const Body& other = scene.bodies[engine() % (scene.bodies.size() - 1)];
    const double scale = 0.6 * (kindOf(moved.shape).boundingRadius(moved.shape) +
                                std::min(0.3, kindOf(other.shape).boundingRadius(other.shape)));
    const double x = uniform(), y = uniform(), z = uniform();
    moved.position = other.position + scale * Vec3(x, y, z);
    const Real least = leastSeparation(scene);
    if (std::abs(least) < 1e-9L) continue;
    EXPECT_EQ(overlaps(scene), least < 0) << "seed " << seed << ", separation " << static_cast<double>(least);
    ++(least < 0 ? overlapping : apart);
  }
  EXPECT_GT(overlapping, 200);
  EXPECT_GT(apart, 200);
}

}  // namespace
}  // namespace carom::brute
