// SPDX-License-Identifier: MIT
// What lies on a face is held at the ends, corners and crossings that bound the contact, however it is turned; and what
// touches at the start of a scene is placed in contact.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {
namespace {

using namespace test;

Body shaped(Body body, Shape shape) {
  body.shape = std::move(shape);
  return body;
}

Quat aboutX(double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitX())); }
Quat aboutZ(double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }

Body turned(Body body, const Quat& q) {
  body.orientation = q;
  return body;
}

constexpr double kQuarter = 0.5 * std::numbers::pi;

// Boxes of a table; its tops at z = 0 lie flush.
Body table(const std::vector<std::pair<Vec3, Vec3>>& boxes) {
  return fixedBody(shaped(makeBox("table", {1, 1, 1}, Vec3::Zero()), shapeOfBoxes(boxes)));
}
Body twoTops() { return table({{{1, 2, 0.1}, {-0.5, 0, -0.05}}, {{1, 2, 0.1}, {0.5, 0, -0.05}}}); }
Body oneTop() { return fixedBody(makeBox("table", {2, 2, 0.1}, {0, 0, -0.05})); }
Body floorPlane() { return makePlane("table", Vec3::UnitZ(), 0); }
Body tiles() {  // a grid of triangles with vertices at all multiples of 0.25
  Triangles t;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) t.vertices.push_back({0.25 * i - 1, 0.25 * j - 1, 0});
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const int k = 9 * i + j;
      t.triangles.push_back({k, k + 9, k + 10});
      t.triangles.push_back({k, k + 10, k + 1});
    }
  return fixedBody(shaped(makeBox("table", {1, 1, 1}, Vec3::Zero()), Mesh{t.surface(), 1, ""}));
}

struct Lying {
  const char* name;
  Body body;
  std::vector<Vec3> points;  // where z is the height of the face, 0
};

std::vector<Vec3> ring(double r, const Vec3& at) {
  return {at + Vec3(r, 0, 0), at + Vec3(0, r, 0), at + Vec3(-r, 0, 0), at + Vec3(0, -r, 0)};
}

std::vector<Lying> lying(const Vec3& at) {
  const auto body = [&](const Shape& shape, double height, const Quat& q = Quat::Identity()) {
    return turned(shaped(makeBox("body", {1, 1, 1}, at + height * Vec3::UnitZ()), shape), q);
  };
  const auto around = [&](std::vector<Vec3> points) {
    for (Vec3& p : points) p += at;
    return points;
  };
  const Quat side = aboutX(kQuarter);
  return {{"ball", body(Sphere{0.1}, 0.1), around({{0, 0, 0}})},
          {"capsule", body(Capsule{0.05, 0.2}, 0.05, side), around({{0, 0.1, 0}, {0, -0.1, 0}})},
          {"cylinder", body(Cylinder{0.05, 0.2}, 0.05, side), around({{0, 0.1, 0}, {0, -0.1, 0}})},
          {"cylinder on end", body(Cylinder{0.1, 0.2}, 0.1), ring(0.1, at)},
          {"cone on end", body(Cone{0.1, 0.2}, 0.1), ring(0.1, at)},
          {"box", body(Box{{0.2, 0.1, 0.3}}, 0.15), around({{0.1, 0.05, 0}, {-0.1, 0.05, 0}, {-0.1, -0.05, 0}, {0.1, -0.05, 0}})},
          {"box askew", body(Box{{0.2, 0.2, 0.3}}, 0.15, aboutZ(0.5 * kQuarter)), ring(0.1 * std::sqrt(2.0), at)}};
}

struct Pair {
  Pair(Body body, Body below, const Quat& turn = Quat::Identity(), const Vec3& shift = Vec3::Zero()) {
    for (Body* b : {&body, &below}) {
      if (auto* plane = std::get_if<Plane>(&b->shape)) {
        *b = makePlane(b->name, turn * plane->normal, (turn * plane->normal).dot(shift));
        continue;
      }
      b->position = shift + turn * b->position;
      b->orientation = (turn * b->orientation).normalized();
    }
    scene = makeScene(Vec3::Zero(), 0.5, 0.2, {body, below});
  }

  // Contact points as they lie before the turn, and their features.
  void expect(const std::vector<Vec3>& wanted, const Quat& turn, const Vec3& shift) {
    OdeContacts contacts(scene);
    contacts.begin(scene);
    const BodyModel ma = modelOf(scene.bodies[0]), mb = modelOf(scene.bodies[1]);
    const Arc a(ma, Tier::none, Vec3::Zero(), 0, startState(scene.bodies[0], ma));
    const Arc b(mb, Tier::none, Vec3::Zero(), 0, startState(scene.bodies[1], mb));
    const auto found = contacts.touching(0, 1, a, b, 0, 1e-12);
    const Kinematics ka = a.kinematicsAt(0), kb = b.kinematicsAt(0);
    std::string all;
    std::vector<bool> seen(wanted.size(), false);
    for (const FeaturePair& f : found) {
      const ContactPoint c = contacts.geometry()->contact(0, 1, f, {ka.x, ka.R}, {kb.x, kb.R});
      const Vec3 p = turn.inverse() * (c.point - shift);
      all += contacts.geometry()->describe(0, 1, f) + "; ";
      EXPECT_TRUE((c.normal - turn * Vec3::UnitZ()).norm() <= 2e-6) << all;
      bool known = false;
      for (std::size_t i = 0; i < wanted.size(); ++i)
        if ((p - wanted[i]).norm() <= 1e-11) known = true, seen[i] = true;
      EXPECT_TRUE(known) << all << p.transpose();
    }
    EXPECT_EQ(found.size(), wanted.size()) << all;
    EXPECT_TRUE(std::find(seen.begin(), seen.end(), false) == seen.end()) << all;
    const auto placed = contacts.placed();
    ASSERT_EQ(placed.size(), 1u);
    EXPECT_EQ(placed[0].features.size(), found.size());
    EXPECT_TRUE(contacts.overlaps().empty());
  }

  Scene scene;
};

TEST(Touching, WhatLiesOnAFace) {
  for (const Body& below : {floorPlane(), oneTop(), tiles(), twoTops()})
    for (const Lying& on : lying({0.37, -0.41, 0}))
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(std::string(on.name) + " on " + std::to_string(below.shape.index()) + ", seed " + std::to_string(seed));
        Random random(seed);
        const Quat turn = seed ? random.rotation() : Quat::Identity();
        const Vec3 shift = seed ? random.vec(1) : Vec3::Zero();
        Pair(on.body, below, turn, shift).expect(on.points, turn, shift);
      }
}

// Over the seam of flush parts, and over edges and vertices of coplanar triangles: the same contacts.
TEST(Touching, AcrossASeam) {
  for (const double x : {0.0, 1e-14, 1e-12, -1e-9, 1e-7, -3e-7, 0.01})
    for (const Body& below : {twoTops(), tiles()})
      for (const Lying& on : lying({x, 0, 0}))
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
          SCOPED_TRACE(std::string(on.name) + " at " + std::to_string(x * 1e9) + " nm on " +
                       std::to_string(below.shape.index()) + ", seed " + std::to_string(seed));
          Random random(seed);
          const Quat turn = seed ? random.rotation() : Quat::Identity();
          const Vec3 shift = seed ? random.vec(1) : Vec3::Zero();
          Pair(on.body, below, turn, shift).expect(on.points, turn, shift);
        }
}

// A block that overhangs the border stands on the corners of what both have in common.
TEST(Touching, OverhangingBlock) {
  for (const Body& below : {oneTop(), twoTops()})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const Quat turn = seed ? random.rotation() : Quat::Identity();
      const Vec3 shift = seed ? random.vec(1) : Vec3::Zero();
      Pair(makeBox("body", {0.4, 0.3, 0.2}, {0.9, 0.2, 0.1}), below, turn, shift)
          .expect({{0.7, 0.05, 0}, {0.7, 0.35, 0}, {1, 0.05, 0}, {1, 0.35, 0}}, turn, shift);
      Pair(makeBox("body", {0.4, 0.4, 0.2}, {0.9, 0.9, 0.1}), below, turn, shift)
          .expect({{0.7, 0.7, 0}, {1, 0.7, 0}, {0.7, 1, 0}, {1, 1, 0}}, turn, shift);
    }
}

// Of bodies whose coordinates are 1 m, in a unit of length.
std::size_t countPlaced(double gap, std::size_t* overlaps = nullptr, double unit = 1) {
  const double z = 0.1 + gap;
  const Scene scene =
      makeScene({0, 0, -9.8 * unit}, 0.5, 0.2,
                {makeBox("block", unit * Vec3(0.2, 0.2, 0.2), unit * Vec3(1, 0, z)), makeBall("ball", unit * 0.1, unit * Vec3(-1, 0, z)),
                 floorPlane(), fixedBody(makeBox("wall", unit * Vec3(0.2, 1, 1), unit * Vec3(-5, 0, 0.5)))});
  OdeContacts contacts(scene);
  contacts.begin(scene);
  if (overlaps) *overlaps = contacts.overlaps().size();
  const auto placed = contacts.placed();
  for (const PlacedContact& p : placed) EXPECT_EQ(p.features.size(), p.a == 0 ? 4u : 1u) << gap;
  EXPECT_TRUE(std::is_sorted(placed.begin(), placed.end(), [](auto& p, auto& q) { return p.a < q.a; }));
  return placed.size();
}

TEST(Placed, WithinSoMuch) {
  std::size_t overlaps = 0;
  for (const double unit : {1e-6, 1e-3, 1.0, 1e3}) {
    SCOPED_TRACE(unit);
    for (const double gap : {0.0, 1e-16, 9e-13, -1e-13, -1e-12, -1e-11, -1e-10, -9e-10}) {
      EXPECT_EQ(countPlaced(gap, &overlaps, unit), 2u) << gap;
      EXPECT_EQ(overlaps, 0u) << gap;
    }
    for (const double gap : {2e-12, 1e-9, 1e-3}) EXPECT_EQ(countPlaced(gap, nullptr, unit), 0u) << gap;
    EXPECT_EQ(countPlaced(-2e-9, &overlaps, unit), 0u);
    EXPECT_EQ(overlaps, 2u);
  }
}

// Those that part or slide are listed, too; those that never collide are not.
TEST(Placed, WhateverTheyDo) {
  Scene scene = makeScene({0, 0, -9.8}, 0.5, 0.2, {floorPlane(), makeBall("ball", 0.1, {0, 0, 0.1}, {1, 0, 2})});
  OdeContacts contacts(scene);
  contacts.begin(scene);
  ASSERT_EQ(contacts.placed().size(), 1u);
  EXPECT_EQ(contacts.placed()[0].a, 0);
  EXPECT_EQ(contacts.placed()[0].b, 1);
  for (Body& body : scene.bodies) body.collision_filter = {{"x"}, {}, {"x"}};
  contacts.begin(scene);
  EXPECT_TRUE(contacts.placed().empty());
}

}  // namespace
}  // namespace carom
