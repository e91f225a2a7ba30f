// SPDX-License-Identifier: MIT
// Random scenes as files of others have them: collision filters, shares of gravity, kinematic bodies, and bodies that
// overlap at the start.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/motion/body_geometry.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom {
namespace {

using namespace test;

constexpr int kSamples = 60;
const int kWorlds = scaled(260);
constexpr double kDepth = 1e-9;

Scene randomWorld(std::uint64_t seed) {
  Random random(7919 * seed);
  RandomScene options;
  options.bodies = 3 + random.below(4);
  options.friction = random.below(3) > 0;
  Scene s = randomScene(seed, options);
  const std::vector<CollisionFilter> filters = {{},
                                                {{"a"}, {}, {}},
                                                {{"b"}, {}, {"a"}},
                                                {{"a", "b"}, {"b"}, {}},
                                                {{}, {"a"}, {}}};
  const auto anyOf = [&](const auto& list) { return list[static_cast<std::size_t>(random.below(static_cast<int>(list.size())))]; };
  for (Body& body : s.bodies) {
    if (random.below(3) == 0) body.collision_filter = anyOf(filters);
    if (random.below(2) == 0) body.gravity_factor = random.in(-0.5, 1.5);
  }
  for (int i = 0; i < options.bodies; ++i) {
    Body& body = s.bodies[static_cast<std::size_t>(i)];
    if (random.below(4) > 0) continue;
    body.kinematic = true;
    body.velocity *= 0.3;
    if (random.below(2) == 0) body.mass.reset();
    if (random.below(2) == 0) body.center_of_mass = random.vec(0.05);
  }
  if (random.below(3) == 0) {  // far off, a crate lands flat, half on a lift and half on a ledge
    const double falls = random.in(0, 2);
    Body crate = makeBox("crate", {0.4, 0.3, 0.2}, {5, random.in(-0.2, 0.2), 0.6}, {0, 0, -falls});
    Body lift = makeBox("lift", {1, 2, 0.2}, {4.5, 0, 0.1}, {-random.in(0, 0.1), random.in(-0.3, 0.3), 0});
    if (random.below(2) == 0) lift.velocity.z() = random.in(-0.2, 0.3);
    lift.kinematic = true;
    s.bodies.insert(s.bodies.end(), {crate, lift, fixedBody(makeBox("ledge", {1, 2, 0.2}, {5.5, 0, 0.1}))});
  }
  if (random.below(2) == 0) s.bodies.push_back(fixedBody(makeBox("step", {0.6, 0.5, 0.3}, {0.4, 0.3, 0.1})));
  if (random.below(2) == 0) {  // one body into another
    Body& moved = s.bodies[static_cast<std::size_t>(random.below(options.bodies))];
    const Vec3 off = random.vec(0.15);
    moved.position = s.bodies[static_cast<std::size_t>(random.below(options.bodies))].position + off;
  }
  return s;
}

const StartOverlap* overlapOf(const Motion& m, int a, int b) {
  for (const StartOverlap& o : m.overlaps)
    if (o.a == std::min(a, b) && o.b == std::max(a, b)) return &o;
  return nullptr;
}

Pose poseAt(const Motion& m, int body, double t) {
  const auto& arcs = m.world_lines[static_cast<std::size_t>(body)].arcs;
  const Kinematics k = arcs[static_cast<std::size_t>(m.arcAt(body, t))].kinematicsAt(t);
  return {k.x, k.R};
}

// Velocity of the contact just after event e, of a relative to b.
Vec3 velocityAfter(const Motion& m, const Event& e, const Contact& c) {
  Vec3 u = Vec3::Zero();
  for (const int body : {c.a, c.b}) {
    const Participant* p = e.find(body);
    if (!p) continue;
    const Arc& next = m.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(p->next())];
    const Kinematics k = next.kinematicsOf(p->stays ? p->before : next.startState());
    u += (body == c.a ? 1.0 : -1.0) * (k.v + k.w.cross(c.at.point - k.x));
  }
  return u;
}

TEST(Worlds, MeetWhomTheyMayAndNobodyElse) {
  int events = 0, joint = 0, overlapping = 0, parted = 0, with_kinematic = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kWorlds); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Motion m = play(randomWorld(seed), 0.8, 60);
    const auto& bodies = m.scene->bodies;
    const auto body = [&](int i) -> const Body& { return bodies[static_cast<std::size_t>(i)]; };
    for (const Event& e : m.events) {
      ++events;
      joint += e.mode == ImpactMode::joint;
      with_kinematic += std::any_of(e.participants.begin(), e.participants.end(),
                                    [&](const Participant& p) { return body(p.body).kinematic; });
      for (const Contact& c : e.contacts) {
        EXPECT_TRUE(mayCollide(body(c.a), body(c.b))) << m.describeEvent(static_cast<int>(&e - m.events.data()));
        const StartOverlap* o = overlapOf(m, c.a, c.b);
        EXPECT_TRUE(!o || (o->parted && *o->parted <= e.time)) << "they have not parted yet at " << e.time;
        const double leaving = c.at.normal.dot(velocityAfter(m, e, c));
        EXPECT_TRUE(leaving >= -1e-9 * (1 + std::abs(c.approach))) << "approaches after the impact at " << leaving;
        const double rebound = leaving + c.pair.elasticity * c.approach;
        EXPECT_TRUE(e.contacts.size() > 1 || std::abs(rebound) <= 1e-9 * (1 + std::abs(c.approach))) << rebound;
      }
    }
    overlapping += static_cast<int>(m.overlaps.size());
    for (const StartOverlap& o : m.overlaps) parted += o.parted.has_value();
    const auto& geometry = dynamic_cast<const BodyGeometry&>(*m.geometry);
    for (int i = 0; i <= kSamples; ++i) {
      const double t = m.end * i / kSamples;
      for (int a = 0; a < static_cast<int>(bodies.size()); ++a)
        for (int b = a + 1; b < static_cast<int>(bodies.size()); ++b) {
          if (!mayCollide(body(a), body(b))) continue;
          const StartOverlap* o = overlapOf(m, a, b);
          const double depth = geometry.overlap(a, b, poseAt(m, a, t), poseAt(m, b, t));
          if (o && (!o->parted || t < *o->parted)) {
            EXPECT_TRUE(depth > 0 || (o->parted && t > *o->parted - 1e-9)) << "apart at " << t << " already";
          } else {
            EXPECT_TRUE(depth <= kDepth) << body(a).name << " and " << body(b).name << " overlap by " << depth << " at " << t;
          }
        }
    }
    for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
      if (!body(b).kinematic) continue;
      const BodyState end = m.stateAt(b, m.end);
      const Vec3 arm = centerOfMass(body(b)), w = body(b).angular_velocity;
      const Mat3 R0 = body(b).orientation.toRotationMatrix();
      const Mat3 R = Eigen::AngleAxisd(m.end * w.norm(), w.normalized()).toRotationMatrix() * R0;
      const Vec3 place = body(b).position + R0 * arm + m.end * body(b).velocity - R * arm;
      EXPECT_TRUE((end.position - place).norm() <= 1e-12);
      EXPECT_TRUE((end.orientation.toRotationMatrix() - R).norm() <= 1e-11);
      EXPECT_EQ(end.velocity, body(b).velocity);
    }
  }
  EXPECT_GT(events, 5 * kWorlds);
  EXPECT_GT(joint, kWorlds / 4);
  EXPECT_GT(with_kinematic, kWorlds / 2);
  EXPECT_GT(overlapping, kWorlds / 8);
  EXPECT_GT(parted, kWorlds / 20);
}

TEST(Worlds, InReverseOrderAreTheSame) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kWorlds); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = randomWorld(seed);
    Scene reversed = scene;
    std::reverse(reversed.bodies.begin(), reversed.bodies.end());
    const Motion m = play(scene, 0.8, 4), r = play(reversed, 0.8, 4);
    ASSERT_EQ(m.overlaps.size(), r.overlaps.size());
    ASSERT_EQ(m.events.size(), r.events.size());
    for (std::size_t i = 0; i < m.events.size(); ++i)
      EXPECT_TRUE(std::abs(m.events[i].time - r.events[i].time) <= 1e-9) << m.events[i].time << " " << r.events[i].time;
  }
}

// With many bodies neighbours are listed in another way.
TEST(Worlds, AmongManyAreTheSame) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kWorlds / 2); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = randomWorld(seed);
    Scene crowded = scene;
    for (int i = 0; i < 45; ++i)
      crowded.bodies.push_back(fixedBody(makeBox("far" + std::to_string(i), {1, 1, 1}, {2.0 * i, 0, 60})));
    SimulateOptions options;
    options.impact_limit = 4;
    options.lowest_bounce = 1e-11;  // by default it grows with the coordinates of what is far off
    OdeContacts few(scene), many(crowded);
    const Motion m = simulate(scene, few, 0.8, options), c = simulate(crowded, many, 0.8, options);
    ASSERT_EQ(m.overlaps.size(), c.overlaps.size());
    for (std::size_t i = 0; i < m.overlaps.size(); ++i) {
      ASSERT_EQ(m.overlaps[i].parted.has_value(), c.overlaps[i].parted.has_value());
      EXPECT_NEAR(m.overlaps[i].parted.value_or(0), c.overlaps[i].parted.value_or(0), 1e-9);
    }
    ASSERT_EQ(m.events.size(), c.events.size());
    for (std::size_t i = 0; i < m.events.size(); ++i) EXPECT_NEAR(m.events[i].time, c.events[i].time, 1e-10);
  }
}

TEST(Worlds, DerivativesAreTransposed) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(40)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Motion m = play(randomWorld(seed), 0.8, 3);
    if (m.events.empty()) continue;
    expectTransposed(m, seed);
  }
}

}  // namespace
}  // namespace carom
