// SPDX-License-Identifier: MIT
// Motions of which some paths are taken over from that of nearly the same scene: the motion is the one that is worked
// out anew, but for rounding.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom {
namespace {

using namespace test;

constexpr double kKnownDuration = 1.2;
// Impacts at corners may multiply what rounding left by a hundred each.
constexpr double kTime = 1e-8;
// Of a scene in which most bodies meet the floor alone.
constexpr std::uint64_t kQuiet = 1;
// With fewer the shares that are asked for are left to chance.
const int kKnownScenes = std::max(9, scaled(30));

/// Bodies of several kinds above a floor, in pairs that often meet; contact lasts where bounces have become low.
Scene thrownPairs(std::uint64_t seed) {
  Random random(31 * seed);
  std::vector<Body> bodies{makePlane("floor", Vec3::UnitZ(), 0)};
  const int count = 4 + random.below(5);
  for (int i = 0; i < count; ++i) {
    const std::string name = "body " + std::to_string(i);
    const Vec3 at(0.8 * (i / 2), 0.45 * (i % 2) + random.in(-0.05, 0.05), random.in(0.3, 0.7));
    Body body = makeBall(name, random.in(0.08, 0.15), at);
    if (const int kind = random.below(3); kind == 1) {
      body.shape = Box{Vec3(0.15, 0.15, 0.15) + random.vec(0.05)};
    } else if (kind == 2) {
      body.shape = Cylinder{random.in(0.07, 0.12), random.in(0.1, 0.25)};
    }
    body.orientation = random.rotation();
    body.velocity = Vec3(random.in(-0.3, 0.3), i % 2 ? -random.in(0, 0.5) : random.in(0, 0.5), random.in(-1, 1));
    body.angular_velocity = random.vec(4);
    body.kinematic = i >= 2 && random.below(12) == 0;
    bodies.push_back(body);
  }
  Scene scene = makeScene({0, 0, -9.81}, random.in(0.1, 0.5), random.in(0.1, 0.6), bodies);
  if (random.below(3) == 0) scene.tilts.push_back({"body 0", 1, Vec2(random.in(-0.1, 0.1), random.in(-0.1, 0.1))});
  return scene;
}

/// The same, but for one body: another velocity, mass or size, or another tilt.
Scene changed(Scene scene, std::uint64_t seed) {
  Random random(77 * seed);
  Body& body = scene.bodies[1 + static_cast<std::size_t>(random.below(static_cast<int>(scene.bodies.size()) - 1))];
  const int kind = random.below(4);
  if (kind == 0) {
    body.mass = 1.3;
  } else if (kind == 1 && std::holds_alternative<Sphere>(body.shape)) {
    std::get<Sphere>(body.shape).radius *= 0.97;
  } else if (kind == 2 && !scene.tilts.empty()) {
    scene.tilts[0].value.x() += 0.02;
  } else {
    body.velocity += random.vec(1.5);
  }
  return scene;
}

Motion playAlong(const Scene& scene, const Motion& known, double duration = kKnownDuration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.baseline = &known;
  return simulate(scene, contacts, duration, options);
}

/// Bodies of which every arc of `a` begins with the same bits in `b`, and none lacks before the end of `a`.
int bodiesWithTheSameBits(const Motion& a, const Motion& b) {
  const auto same = [](const Arc& x, const Arc& y) {
    const State &s = x.startState(), &t = y.startState();
    return x.start() == y.start() && s.x == t.x && s.q.coeffs() == t.q.coeffs() && s.v == t.v && s.L == t.L;
  };
  int count = 0;
  for (std::size_t i = 0; i < a.world_lines.size(); ++i) {
    const auto &of_a = a.world_lines[i].arcs, &of_b = b.world_lines[i].arcs;
    const bool begins = of_a.size() <= of_b.size() && std::equal(of_a.begin(), of_a.end(), of_b.begin(), same);
    const bool lacks = of_a.size() < of_b.size() && of_b[of_a.size()].start() < a.end;
    count += !a.scene->bodies[i].fixed && begins && !lacks;
  }
  return count;
}

void expectTheSame(const Motion& found, const Motion& expected) {
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.message, expected.message);
  ASSERT_EQ(found.events.size(), expected.events.size());
  EXPECT_EQ(found.impacts, expected.impacts);
  EXPECT_EQ(found.event_count, expected.event_count);
  for (std::size_t b = 0; b < found.world_lines.size(); ++b) {
    const WorldLine &f = found.world_lines[b], &x = expected.world_lines[b];
    ASSERT_EQ(f.events.size(), x.events.size());
    ASSERT_EQ(f.arcs.size(), x.arcs.size());
    for (std::size_t k = 0; k < f.events.size(); ++k) {
      const Event &e = found.events[static_cast<std::size_t>(f.events[k])],
                  &was = expected.events[static_cast<std::size_t>(x.events[k])];
      EXPECT_TRUE(std::abs(e.time - was.time) <= kTime) << e.time << " " << was.time;
      EXPECT_EQ(e.kind, was.kind);
      EXPECT_EQ(e.find(static_cast<int>(b))->arc, static_cast<int>(k));
    }
  }
  for (std::size_t e = 1; e < found.events.size(); ++e) EXPECT_TRUE(found.events[e - 1].time <= found.events[e].time);
}

/// Sequences that differ, as those of a rattle do after rounding, are not compared.
struct Tally {
  int compared = 0, otherwise = 0, taken = 0, given_back = 0;
  void add(const Scene& scene, const Scene& other) {
    const Motion known = play(scene, kKnownDuration), expected = play(other, kKnownDuration), found = playAlong(other, known);
    if (known.status != MotionStatus::complete) {
      EXPECT_EQ(found.taken_over, 0u);
      return;
    }
    taken += static_cast<int>(found.taken_over);
    EXPECT_GE(bodiesWithTheSameBits(found, known), static_cast<int>(found.taken_over));
    const Motion at_once = playAlong(other, known, 1e-9);  // nobody has met anybody yet
    EXPECT_GE(at_once.taken_over, found.taken_over);
    given_back += at_once.taken_over > found.taken_over;
    if (found.signature() != expected.signature()) {
      ++otherwise;
      return;
    }
    ++compared;
    expectTheSame(found, expected);
  }
};

TEST(KnownPaths, AreThoseThatAreWorkedOut) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kKnownScenes); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = thrownPairs(seed), other = changed(scene, seed);
    tally.add(scene, other);
    Scene reversed = scene, other_reversed = other;
    std::ranges::reverse(reversed.bodies);
    std::ranges::reverse(other_reversed.bodies);
    tally.add(reversed, other_reversed);
  }
  EXPECT_GT(tally.compared, 10 * tally.otherwise);
  EXPECT_GT(tally.taken, 2 * tally.compared);
  EXPECT_GT(tally.given_back, tally.compared / 20);
}

// With many bodies neighbours are listed in windows.
TEST(KnownPaths, AmongManyAreTheSame) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kKnownScenes / 4); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Scene scene = thrownPairs(seed);
    for (int i = 0; i < 45; ++i)
      scene.bodies.push_back(fixedBody(makeBox("far " + std::to_string(i), {0.5, 0.5, 0.5}, {0.6 * (i % 9), 3 + 0.6 * (i / 9), 1})));
    tally.add(scene, changed(scene, seed));
  }
  EXPECT_GT(tally.compared, 10 * tally.otherwise);
  EXPECT_GT(tally.taken, tally.compared);
}

TEST(KnownPaths, HaveTheSameDerivatives) {
  const int scenes = std::max(12, scaled(12));
  int compared = 0, transposed = 0;  // the latter of short motions, which have lost no digits to corners yet
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scenes); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = thrownPairs(seed), other = changed(scene, seed);
    const Motion known = play(scene, 0.5), expected = play(other, 0.5), found = playAlong(other, known, 0.5);
    if (found.taken_over == 0 || found.signature() != expected.signature()) continue;
    ++compared;
    const Motion first = playAlong(other, play(scene, 0.3), 0.3);
    if (first.taken_over > 0 && first.events.size() <= 4) ++transposed, expectTransposed(first, seed);
    for (int body : movingBodies(other)) {
      const auto end = [&](const Motion& m) { return flatten(gradientOf(m, body, 0.45, static_cast<int>(seed % 12))); };
      expectEntries(end(found), end(expected), 1e-7, other.bodies[static_cast<std::size_t>(body)].name, 10);
    }
  }
  EXPECT_GT(compared, scenes / 2);
  EXPECT_GT(transposed, scenes / 6);
}

// Of the motion that is known nothing is needed afterwards.
TEST(KnownPaths, OutliveTheMotionTheyAreOf) {
  const Scene scene = thrownPairs(kQuiet), other = changed(scene, kQuiet);
  auto known = std::make_unique<Motion>(play(scene, kKnownDuration));
  const Motion found = playAlong(other, *known), copy = playAlong(other, found);
  known.reset();
  ASSERT_GT(found.taken_over, 0u);
  EXPECT_EQ(copy.taken_over, movingBodies(other).size());
  EXPECT_EQ(bodiesWithTheSameBits(copy, found), static_cast<int>(movingBodies(other).size()));
  expectTransposed(playAlong(other, play(scene, 0.3), 0.3), kQuiet);
}

Scene ballAndBlock(double speed) {
  return makeScene({0, 0, -9.81}, 0.5, 0.4,
                   {makePlane("floor", Vec3::UnitZ(), 0), makeBall("ball", 0.1, {-1, 0, 0.1}, {speed, 0, 0}),
                    makeBox("block", {0.2, 0.4, 0.3}, {0, 0, 0.15}), makeBox("other", {0.2, 0.4, 0.3}, {0, 2, 0.15})});
}

// A block at rest is known to stay where it is, until a ball comes to strike it.
TEST(KnownPaths, AreGivenUpWhereTheyAreMet) {
  const Scene slow = ballAndBlock(0.2), fast = ballAndBlock(2);
  const Motion known = play(slow, 1);
  ASSERT_EQ(known.status, MotionStatus::complete) << known.message;
  const Motion slower = playAlong(ballAndBlock(0.1), known, 1);
  EXPECT_EQ(slower.taken_over, 2u);
  EXPECT_EQ(slower.stateAt("block", 1).position, known.stateAt("block", 1).position);
  const Motion found = playAlong(fast, known, 1), expected = play(fast, 1);
  EXPECT_EQ(found.taken_over, 1u);
  EXPECT_EQ(found.signature(), expected.signature());
  EXPECT_GT(found.stateAt("block", 1).position.x(), 0.01);
  for (const char* body : {"ball", "block", "other"})
    expectEntries(flatten(found.stateAt(body, 1)), flatten(expected.stateAt(body, 1)), 1e-12, body);
  EXPECT_GT(found.steps, expected.steps) << "the attempt counts";
}

TEST(KnownPaths, OfADifferentWorldAreOfNoUse) {
  const Scene scene = thrownPairs(kQuiet), other = changed(scene, kQuiet);
  const Motion known = play(scene, kKnownDuration), expected = play(other, kKnownDuration);
  const auto refused = [&](const Motion& motion, const Scene& is, const char* why) {
    SCOPED_TRACE(why);
    const Motion found = playAlong(is, motion), alone = play(is, kKnownDuration);
    EXPECT_EQ(found.taken_over, 0u);
    EXPECT_EQ(found.signature(), alone.signature());
    EXPECT_EQ(bodiesWithTheSameBits(found, alone), static_cast<int>(movingBodies(is).size()));
  };
  EXPECT_GT(playAlong(other, known).taken_over, 0u);
  Scene heavier = other;
  heavier.gravity.z() *= 1.01;
  refused(known, heavier, "gravity");
  Scene lower = other;
  std::get<Plane>(lower.bodies[0].shape).offset = -0.01;
  refused(known, lower, "what is fixed");
  Scene smoother = other;
  smoother.materials[0].friction *= 0.9;
  refused(known, smoother, "material");
  refused(play(scene, 0.9 * kKnownDuration), other, "too short");
  refused(play(scene, kKnownDuration, 2), other, "ended early");
  Scene one_less = other;
  one_less.bodies.pop_back();
  one_less.tilts.clear();
  refused(known, one_less, "bodies");
}

}  // namespace
}  // namespace carom
