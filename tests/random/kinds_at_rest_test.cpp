// SPDX-License-Identifier: MIT
// Random throws of every kind of shape onto a table with a wall end at rest, go on rolling, or end with a sentence that
// says why. Prints which, how often and how long it took; CAROM_TEST_SCALE=150 throws 300 of each kind.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>

#include "adjoint/motion/body_geometry.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scaled.h"
#include "tests/support/throws.h"

namespace carom {
namespace {

using namespace test;

constexpr std::array<double, 4> kBounces = {0, 0.2, 0.5, 0.85};
constexpr std::array<double, 3> kRubs = {0.1, 0.4, 1};
constexpr double kDeepest = 1e-9;    // of the size of the body
constexpr double kAsked = 5;         // s
constexpr std::size_t kMostWork = 3'000'000;

Scene thrownAtWall(const ShapeMaker& maker, std::uint64_t seed) {
  Random random(seed);
  Body body = makeBall("body", 1, Vec3::Zero());
  body.shape = maker.make(random, false);
  body.position = {random.in(-0.6, 0.2), random.in(-0.4, 0.4),
                   kindOf(body.shape).boundingRadius(body.shape) + random.in(0.05, 0.5)};
  body.orientation = random.rotation();
  body.velocity = random.vec(1) + Vec3(random.in(0, 2), 0, 0);
  body.angular_velocity = random.vec(5);
  const Body table = fixedBody(makeBox("table", {4, 3, 0.1}, {0, 0, -0.05}));
  const Body wall = fixedBody(makeBox("wall", {0.1, 3, 0.6}, {1.2, 0, 0.3}));
  const double e = kBounces[static_cast<std::size_t>(random.below(4))];
  const double mu = kRubs[static_cast<std::size_t>(random.below(3))];
  return makeScene({0, 0, -9.81}, e, mu, {body, table, wall, makePlane("floor", Vec3::UnitZ(), -0.8)});
}

// The same for all sentences that differ by their numbers alone.
std::string withoutNumbers(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (digit && !out.empty() && out.back() == '#') continue;
    const bool in_number = (c == '.' || c == '-' || c == 'e' || c == '+') && !out.empty() && out.back() == '#';
    if (!in_number || c == '.') out += digit ? '#' : c;
    if (out.ends_with("#.#")) out.erase(out.size() - 2);
  }
  return out;
}

// Deepest overlap with what stands still at the end, over the size of the body.
double overlapAtEnd(const Motion& m) {
  const auto& geometry = dynamic_cast<const BodyGeometry&>(*m.geometry);
  const auto poseAtEnd = [&](std::size_t body) {
    const Kinematics k = m.world_lines[body].arcs.back().kinematicsAt(m.end);
    return Pose{k.x, k.R};
  };
  double deepest = 0;
  for (std::size_t b = 1; b < m.world_lines.size(); ++b)
    deepest = std::max(deepest, geometry.overlap(0, static_cast<int>(b), poseAtEnd(0), poseAtEnd(b)));
  const Shape& shape = m.scene->bodies[0].shape;
  return deepest / kindOf(shape).boundingRadius(shape);
}

class KindsAtRest : public testing::TestWithParam<ShapeMaker> {};

TEST_P(KindsAtRest, OrASentenceSaysWhyNot) {
  std::map<std::string, std::pair<int, std::uint64_t>> ends;
  std::vector<double> took;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(2)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = thrownAtWall(GetParam(), seed);
    OdeContacts contacts(scene);
    SimulateOptions options;
    options.impact_limit = 100000;
    options.step_limit = kMostWork;
    const auto began = std::chrono::steady_clock::now();
    Motion m;
    ASSERT_NO_THROW(m = simulate(scene, contacts, kAsked, options));
    took.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    if (took.back() > 5) std::printf("%s, seed %d: %.1f s\n", GetParam().name, static_cast<int>(seed), took.back());
    const bool complete = m.status == MotionStatus::complete;
    EXPECT_TRUE(complete || !m.message.empty());
    EXPECT_TRUE(complete ? m.end == kAsked : m.end < kAsked) << m.end;
    const double deepest = overlapAtEnd(m);
    // unresolved_impact says itself that the bodies overlap where nothing was seen to meet
    EXPECT_TRUE(deepest <= kDeepest || m.status == MotionStatus::unresolved_impact) << deepest << " of the size, after " << m.end << " s: " << m.message;
    auto& end = ends[complete ? nameOf(m.world_lines[0].arcs.back().kind())
                              : std::string(nameOf(m.status)) + ": " + withoutNumbers(m.message)];
    if (end.first++ == 0) end.second = seed;
  }
  std::ranges::sort(took);
  std::printf("%s: %zu throws, median %.3f s, longest %.3f s\n", GetParam().name, took.size(), took[took.size() / 2],
              took.back());
  for (const auto& [what, count] : ends)
    std::printf("  %4d %s (first seed %d)\n", count.first, what.c_str(), static_cast<int>(count.second));
}

std::vector<ShapeMaker> movingKinds() {
  std::vector<ShapeMaker> kinds;
  for (const ShapeMaker& maker : shapeMakers())
    if (maker.moves) kinds.push_back(maker);
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Kinds, KindsAtRest, testing::ValuesIn(movingKinds()),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace carom
