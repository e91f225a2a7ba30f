// SPDX-License-Identifier: MIT
// The search for impacts of bodies that stay in contact with a face: what the face keeps apart is not met, all the rest is,
// at the time at which a step by step approach in extended precision finds it. Paths in contact are arcs under a
// "gravity" along the face.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "adjoint/base/errors.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/brute/numbers.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {
namespace {

using namespace test;
using brute::Real;
using brute::Vector;
using brute::widen;

// Two bodies, the first one on a path of its own.
struct PathBeside {
  PathBeside(Body body, Body other, const Vec3& acceleration)
      : scene(makeScene(Vec3::Zero(), 0.5, 0.2, {std::move(body), std::move(other)})), contacts(scene) {
    contacts.begin(scene);
    for (std::size_t i = 0; i < 2; ++i) models.push_back(modelOf(scene.bodies[i]));
    for (std::size_t i = 0; i < 2; ++i)
      arcs.emplace_back(models[i], Tier::none, acceleration, 0.0, startState(scene.bodies[i], models[i]));
    for (int i = 0; i < 2; ++i) contacts.setPath(i, arcs[static_cast<std::size_t>(i)], 0, 10);
  }
  std::vector<FeaturePair> touching(double reach = 1e-12) { return contacts.touching(0, 1, arcs[0], arcs[1], 0, reach); }
  std::optional<PredictedImpact> beside(const std::vector<FeaturePair>& held, double until) {
    return contacts.firstImpactBeside(0, 1, held, arcs[0], arcs[1], 0, until);
  }
  std::string describe(const FeaturePair& f) { return contacts.geometry()->describe(0, 1, f); }

  Scene scene;
  OdeContacts contacts;
  std::vector<BodyModel> models;
  std::vector<Arc> arcs;
};

using Corners = std::array<Vector, 3>;

// Distance of a point from a triangle (by its edges where the foot is outside).
Real distanceTo(const Corners& t, const Vector& p) {
  const Vector n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  bool inside = true;
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector along = t[(i + 1) % 3] - t[i], to = p - t[i];
    inside = inside && n.cross(along).dot(to) >= 0;
    const Real share = std::clamp(to.dot(along) / along.squaredNorm(), Real(0), Real(1));
    least = std::min(least, (to - share * along).norm());
  }
  return inside ? std::abs(n.dot(p - t[0])) : least;
}

// First time at which the centre x + v t + a t^2/2 is as near as r to one of the triangles: steps that cannot pass it.
std::optional<Real> firstMeeting(const std::vector<Corners>& triangles, const Vec3& x, const Vec3& v, const Vec3& a,
                                 double r, double until) {
  std::optional<Real> first;
  const Real fastest = widen(v).norm() + widen(a).norm() * until;
  for (const Corners& corners : triangles)
    for (Real t = 0; t <= first.value_or(until);) {
      const Real gap = distanceTo(corners, widen(x) + t * widen(v) + t * t / 2 * widen(a)) - Real(r);
      if (gap < 1e-15L) {
        first = t;
        break;
      }
      t += gap / fastest;
    }
  return first;
}

// A floor that goes on in a step or a ramp, up or down, and ends at a wall: the profile across y, cut into triangles
// whose corners in the floor are shaken within it.
struct Terrain {
  Triangles mesh;

  Terrain(Random& random, bool ramp, double rise) {
    const std::vector<std::pair<double, double>> profile{
        {-1.5, 0}, {-1.1, 0}, {-0.6, 0}, {-0.2, 0}, {0.3, 0}, {ramp ? 0.8 : 0.3, rise}, {1.3, rise}, {1.3, 1}, {1.8, 1}};
    constexpr int kAcross = 6;
    for (std::size_t i = 0; i < profile.size(); ++i)
      for (int j = 0; j <= kAcross; ++j) {
        const bool shaken = i > 0 && i < 4 && j > 0 && j < kAcross;
        mesh.vertices.push_back({profile[i].first + (shaken ? random.in(-0.1, 0.1) : 0),
                                 -1.5 + 0.5 * j + (shaken ? random.in(-0.1, 0.1) : 0), profile[i].second});
      }
    const auto at = [](std::size_t i, int j) { return static_cast<int>(i) * (kAcross + 1) + j; };
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
      for (int j = 0; j < kAcross; ++j) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
};

struct Roll {
  Vec3 x, v, a;  // of the centre, in the terrain's axes
};

// From anywhere on the floor, or from a vertex or an edge of it.
Roll rollOn(const Terrain& terrain, double r, Random& random) {
  Roll roll{{random.in(-1.2, 0.25 - 2 * r), random.in(-0.8, 0.8), 0}, random.vec(2), random.vec(3)};
  const auto vertex = [&](int i, int j) { return terrain.mesh.vertices[static_cast<std::size_t>(7 * i + j)]; };
  const int i = 1 + random.below(2), j = 2 + random.below(2);
  if (const int kind = random.below(4); kind == 0) {
    roll.x = vertex(i, j);
  } else if (kind == 1) {
    const double share = random.in(0, 1);
    roll.x = (1 - share) * vertex(i, j) + share * vertex(i + 1, j + 1);
  } else if (kind == 2) {
    roll.x = vertex(i, j) + 1e-9 * random.vec(1);
  }
  roll.x.z() = r, roll.v.z() = roll.a.z() = 0;
  roll.v.x() = std::abs(roll.v.x());
  if (random.below(3) == 0) roll.a.setZero();
  return roll;
}

TEST(FirstImpactBeside, BallOnTerrain) {
  int met = 0;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const bool ramp = random.below(2);
    const double rise = random.in(-0.3, 0.3), r = random.in(0.02, 0.12);
    const Terrain terrain(random, ramp, rise);
    const Roll roll = rollOn(terrain, r, random);
    const Quat turn = random.below(3) ? random.rotation() : Quat::Identity();
    const Vec3 shift = random.below(3) ? random.vec(2) : Vec3::Zero();
    Body land = fixedBody(makeBox("terrain", {1, 1, 1}, Vec3::Zero()));
    const Triangles placed = terrain.mesh.placed(turn, shift);
    land.shape = Mesh{placed.surface(), 1, ""};
    PathBeside path(makeBall("ball", r, shift + turn * roll.x, turn * roll.v), land, turn * roll.a);
    const auto held = path.touching();
    ASSERT_EQ(held.size(), 1u);
    std::vector<Corners> others;  // all but those in the floor's plane or below
    for (const auto& t : placed.triangles) {
      const auto z = [&](int k) { return terrain.mesh.vertices[static_cast<std::size_t>(k)].z(); };
      const auto corner = [&](int k) { return widen(placed.vertices[static_cast<std::size_t>(k)]); };
      if (z(t[0]) > 0 || z(t[1]) > 0 || z(t[2]) > 0) others.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
    }
    const auto expected = firstMeeting(others, path.scene.bodies[0].position, path.scene.bodies[0].velocity,
                                       turn * roll.a, r, 1.5);
    const auto found = path.beside(held, 1.5);
    ASSERT_EQ(found.has_value(), expected.has_value()) << (found ? path.describe(found->features) : "");
    if (!found) continue;
    ++met;
    const double error = std::abs(found->time - double(*expected));
    worst = std::max(worst, error);
    // rounding of a coordinate over the speed at which it is met
    EXPECT_TRUE(error <= 2e-12) << error << " at " << found->time << ", " << path.describe(found->features);
  }
  std::printf("[   MET    ] %d of 600, worst time off by %.2g s\n", met, worst);
  EXPECT_GT(met, 200);
}

Body compound(const char* name, const std::vector<std::pair<Vec3, Vec3>>& boxes) {
  Body body = makeBox(name, {1, 1, 1}, Vec3::Zero());
  body.shape = shapeOfBoxes(boxes);
  return fixedBody(body);
}

// A table of two flush tops with a wall of three boxes along it, and one across at its end.
Body tableWithWalls() {
  return compound("table", {{{1, 2, 0.1}, {-0.5, 0, -0.05}},
                            {{1, 2, 0.1}, {0.5, 0, -0.05}},
                            {{0.6, 0.1, 0.5}, {-0.7, 0.55, 0.2}},
                            {{0.8, 0.1, 0.5}, {0, 0.55, 0.2}},
                            {{0.6, 0.1, 0.5}, {0.7, 0.55, 0.2}},
                            {{0.1, 2, 0.5}, {0.95, 0, 0.2}}});
}

Body turnedAbout(Body body, const Quat& turn) {
  body.position = turn * body.position;
  body.velocity = turn * body.velocity;
  body.orientation = turn * body.orientation;
  return body;
}

// Along the wall, touching it and the flush tops: neither seams nor tops are met, and the wall across is.
TEST(FirstImpactBeside, BallAlongAWallOfBoxes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Quat turn = seed % 3 ? random.rotation() : Quat::Identity();
    const double r = random.in(0.02, 0.1), v = random.in(0.5, 3), start = random.in(-0.9, 0.1);
    const Body ball = makeBall("ball", r, {start, 0.5 - r, r}, {v, 0, 0});
    PathBeside path(turnedAbout(ball, turn), turnedAbout(tableWithWalls(), turn), Vec3::Zero());
    const auto touching = path.touching();
    ASSERT_EQ(touching.size(), 2u);
    const double expected = (0.9 - r - start) / v;
    for (std::size_t kept = 0; kept < 3; ++kept) {  // one of the two, or both
      std::vector<FeaturePair> held = touching;
      if (kept < 2) held = {touching[kept]};
      const auto found = path.beside(held, 5);
      ASSERT_TRUE(found);
      EXPECT_TRUE(std::abs(found->time - expected) <= 1e-12)
          << found->time - expected << ", held " << kept << ": " << path.describe(found->features);
    }
  }
}

TEST(FirstImpactBeside, BallAgainstTheWallOfBoxes) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Quat turn = seed % 3 ? random.rotation() : Quat::Identity();
    const double r = random.in(0.02, 0.1), y = random.in(-0.5, 0.5 - 1.1 * r);
    const Vec3 v(random.in(-0.25, 0.5), random.in(0.5, 2), 0), at(seed % 4 ? random.in(-0.3, 0.3) : 0, y, r);
    PathBeside path(turnedAbout(makeBall("ball", r, at, v), turn), turnedAbout(tableWithWalls(), turn), Vec3::Zero());
    const auto held = path.touching();
    ASSERT_EQ(held.size(), 1u);
    const auto found = path.beside(held, 5);
    ASSERT_TRUE(found);
    const double along = (0.5 - r - y) / v.y(), across = v.x() > 0 ? (0.9 - r - at.x()) / v.x() : 1e9;
    EXPECT_TRUE(std::abs(found->time - std::min(along, across)) <= 2e-12) << path.describe(found->features);
  }
}

TEST(FirstImpactBeside, BlockGlidesTowardsAWall) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Quat turn = seed % 3 ? random.rotation() : Quat::Identity();
    const double yaw = seed % 2 ? 0 : random.in(0, 1.5), v = random.in(1, 3), brake = -random.in(0, 0.2);
    Body block = makeBox("block", {0.2, 0.1, 0.3}, {random.in(-0.6, 0.5), random.in(-0.3, 0.1), 0.15}, {v, 0, 0});
    block.orientation = Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
    const double reach = 0.1 * std::abs(std::cos(yaw)) + 0.05 * std::abs(std::sin(yaw));
    const double room = 0.9 - reach - block.position.x();
    PathBeside path(turnedAbout(block, turn), turnedAbout(tableWithWalls(), turn), turn * Vec3(brake, 0, 0));
    const auto held = path.touching();
    ASSERT_GE(held.size(), 4u);
    const auto found = path.beside(held, 5);
    ASSERT_TRUE(found);
    const double expected = 2 * room / (v + std::sqrt(v * v + 2 * brake * room));
    EXPECT_TRUE(std::abs(found->time - expected) <= 1e-12) << path.describe(found->features);
  }
}

TEST(FirstImpactBeside, NothingElseToMeet) {
  const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
  PathBeside ball(makeBall("ball", 0.1, {0, 0, 0.1}, {1, 0, 0}), floor, {-0.3, 0, 0});
  EXPECT_FALSE(ball.beside(ball.touching(), 10));
  PathBeside block(makeBox("block", {0.2, 0.2, 0.2}, {0, 0, 0.1}), floor, Vec3::Zero());
  EXPECT_FALSE(block.beside(block.touching(), 10));
  Body roller = makeBox("roller", {1, 1, 1}, {0, 0, 0.1}, {1, 0, 0});
  roller.shape = Capsule{0.1, 0.5};
  roller.orientation = Quat(Eigen::AngleAxisd(0.5 * M_PI, Vec3::UnitX()));
  roller.angular_velocity = {0, 10, 0};
  PathBeside rolling(roller, fixedBody(makeBox("slab", {4, 4, 1}, {0, 0, -0.5})), Vec3::Zero());
  ASSERT_EQ(rolling.touching().size(), 2u);
  EXPECT_FALSE(rolling.beside(rolling.touching(), 1));
}

TEST(FirstImpactBeside, ChecksItsArguments) {
  PathBeside path(makeBall("ball", 0.1, {0, 0, 0.1}), makePlane("floor", Vec3::UnitZ(), 0), Vec3::Zero());
  EXPECT_THROW(path.beside({{0, 0, 7, 1}}, 1), InputError);
  EXPECT_THROW(path.beside({{0, 0, 0, 1}}, kInfinity), InputError);
}

// A ball at the border of a table (at x = 1) that flies on: the gap is 0 there and grows with t^2.
struct OverTheEdge {
  OverTheEdge(const Quat& turn, double r, const Vec3& v, const Vec3& g, double sinks)
      : path(turnedAbout(makeBall("ball", r, {1, 0.1, r - sinks}, v), turn),
             turnedAbout(fixedBody(makeBox("table", {2, 2, 0.75}, {0, 0, -0.375})), turn), turn * g) {}
  std::optional<PredictedImpact> first(double until) {
    return path.contacts.firstImpact(0, 1, path.arcs[0], path.arcs[1], 0, until);
  }
  PathBeside path;
};

TEST(LeavesTheBorder, FliesFreely) {
  const double g = 9.81;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Quat turn = seed % 3 ? random.rotation() : Quat::Identity();
    const double r = random.in(0.01, 0.2), v = std::sqrt(g * r) * (1 + std::pow(10, random.in(-4, 1)));
    const double up = (random.below(3) - 1) * 1e-17, sinks = (random.below(3) - 1) * 1e-16;
    OverTheEdge ball(turn, r, {v, random.in(-1, 1), up}, {0, 0, -g}, sinks);
    const auto found = ball.first(3);
    EXPECT_FALSE(found) << found->time << " " << ball.path.describe(found->features);
  }
}

// Too slow to fly, it falls on the edge from the start on.
TEST(LeavesTheBorder, SlowerOnesPressOnTheEdgeAtOnce) {
  const double g = 9.81;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Quat turn = seed % 3 ? random.rotation() : Quat::Identity();
    const double r = random.in(0.01, 0.2), v = std::sqrt(g * r) * random.in(0, 0.99);
    OverTheEdge ball(turn, r, {v, 0, 0}, {0, 0, -g}, 0);
    const auto found = ball.first(3);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 0) << ball.path.describe(found->features);
  }
}

// It misses the border by its own height and finds the side of the table when it is drawn back.
TEST(LeavesTheBorder, FindsWhatComesLater) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Quat turn = seed % 3 ? random.rotation() : Quat::Identity();
    const double r = random.in(0.02, 0.08), v = random.in(2, 3), back = random.in(8, 12);
    OverTheEdge ball(turn, r, {v, 0, 0}, {-back, 0, -9.81}, 0);
    const Triangles sides = boxTriangles({2, 2, 0.75}).placed(turn, turn * Vec3(0, 0, -0.375));
    std::vector<Corners> corners;
    for (const auto& t : sides.triangles) {
      const auto corner = [&](int k) { return widen(sides.vertices[static_cast<std::size_t>(k)]); };
      corners.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
    }
    // the answer of small steps, from when it is clear of the edge
    const double clear = 0.01;
    const Vec3 g = turn * Vec3(-back, 0, -9.81), x = ball.path.scene.bodies[0].position, u = turn * Vec3(v, 0, 0);
    const auto later = firstMeeting(corners, x + clear * u + 0.5 * clear * clear * g, u + clear * g, g, r, 2);
    const auto found = ball.first(2);
    ASSERT_EQ(found.has_value(), later.has_value());
    if (!found) continue;
    EXPECT_TRUE(std::abs(found->time - clear - double(*later)) <= 1e-12) << ball.path.describe(found->features);
  }
}

TEST(StartsInContact, PartsOrFallsAtOnce) {
  for (const double speed : {0.0, 1e-17, -1e-17, 1e-18, -1e-18})
    for (const double along : {0.0, 0.3, 3.0})
      for (const double gap : {0.0, 1e-17, -1e-16, 1e-16})
        for (const bool box : {false, true})
          for (const double pull : {1.0, -1.0, 1e-3, -1e-3, 9.81, -9.81}) {
            Body body = makeBall("body", 0.1, {0, 0, 0.1 + gap}, {along, 0, speed});
            if (box) body.shape = Box{{0.2, 0.2, 0.2}};
            for (const Body& below : {makePlane("floor", Vec3::UnitZ(), 0), fixedBody(makeBox("slab", {9, 9, 1}, {0, 0, -0.5}))}) {
              PathBeside path(body, below, {0, 0, pull});
              const auto found = path.contacts.firstImpact(0, 1, path.arcs[0], path.arcs[1], 0, 1);
              EXPECT_EQ(found.has_value(), pull < 0) << speed << " " << along << " " << gap << " " << pull << " " << box;
              if (!found) continue;
              EXPECT_EQ(found->time, 0) << speed << " " << along << " " << gap << " " << pull << " " << box;
            }
          }
}

// Thrown up from a gap of 0, it comes back when it comes back.
TEST(StartsInContact, ReturnsLater) {
  for (const double speed : {1e-6, 1e-3, 1.0}) {
    PathBeside path(makeBox("body", {0.2, 0.2, 0.2}, {0, 0, 0.1}, {0.3, 0, speed}),
                    fixedBody(makeBox("slab", {9, 9, 1}, {0, 0, -0.5})), {0, 0, -9.81});
    const auto found = path.contacts.firstImpact(0, 1, path.arcs[0], path.arcs[1], 0, 1);
    ASSERT_TRUE(found);
    EXPECT_TRUE(std::abs(found->time - 2 * speed / 9.81) <= 1e-15 / speed + 1e-13) << speed << ": " << found->time;
  }
}

// What rests is hit by what flies: it has no acceleration, the other one has.
TEST(RestingBody, IsHitByFlyingBalls) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double r = 0.05, until = 2;
    const Vec3 g(0, 0, -9.81), at = random.vec(1) + Vec3(0, 0, 1.5), v = random.vec(3);
    Body box = makeBox("box", {0.4, 0.5, 0.3}, Vec3::Zero());
    box.orientation = random.rotation();
    PathBeside path(makeBall("ball", r, at, v), box, g);
    path.arcs[1] = Arc(path.models[1], Tier::none, Vec3::Zero(), 0, startState(path.scene.bodies[1], path.models[1]));
    path.contacts.setPath(1, path.arcs[1], 0, until);
    const Triangles sides = boxTriangles({0.4, 0.5, 0.3}).placed(box.orientation, Vec3::Zero());
    std::vector<Corners> corners;
    for (const auto& t : sides.triangles) {
      const auto corner = [&](int k) { return widen(sides.vertices[static_cast<std::size_t>(k)]); };
      corners.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
    }
    const auto expected = firstMeeting(corners, at, v, g, r, until);
    const auto found = path.contacts.firstImpact(0, 1, path.arcs[0], path.arcs[1], 0, until);
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (found) worst = std::max(worst, std::abs(found->time - double(*expected)));
  }
  EXPECT_TRUE(worst <= 1e-12) << worst;
}

}  // namespace
}  // namespace carom
