// SPDX-License-Identifier: MIT
// Cylinders and cones that come to lie flat on their rims: rocking is impacts of the cap, in closed form, and ends at rest. The
// sweep drops them tilted by 0 to 0.5 rad, with and without spin; no motion has more energy than before or lies in a plane.
// CAROM_TEST_SCALE=20 drops 640.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::flat_rims {
namespace {

using namespace test;

constexpr double kCupRadius = 0.032, kCupHeight = 0.045, kCupMass = 0.2, kCupInertia = 0.0006;

// An empty cup whose centre of mass is 45 mm above its base, let go on its rim, tilted by so much about x turned by `heading`,
// and turned about its own axis.
Scene cup(double tilt, double heading, double about_axis) {
  Body body = makeBall("cup", 1, Vec3::Zero());
  body.shape = Cylinder{kCupRadius, 0.2};
  body.mass = kCupMass;
  body.center_of_mass = Vec3(0, 0, kCupHeight - 0.1);
  body.inertia = Inertia::fromMoments({kCupInertia, kCupInertia, 0.00012});
  body.orientation = Eigen::AngleAxisd(heading, Vec3::UnitZ()) * Eigen::AngleAxisd(tilt, Vec3::UnitX()) *
                     Eigen::AngleAxisd(about_axis, Vec3::UnitZ());
  body.position.z() = 0.1 * std::cos(tilt) + kCupRadius * std::sin(tilt);
  return makeScene({0, 0, -9.81}, 0, 0.6, {body, makePlane("floor", Vec3::UnitZ(), 0)});
}

constexpr double kAboutRim = kCupInertia + kCupMass * (kCupHeight * kCupHeight + kCupRadius * kCupRadius);

// Height of the centre of mass on the rim.
double heightAt(double tilt) { return kCupHeight * std::cos(tilt) + kCupRadius * std::sin(tilt); }
double rateFrom(double highest) {
  return std::sqrt(2 * kCupMass * 9.81 * (heightAt(highest) - kCupHeight) / kAboutRim);
}

// From the highest tilt to flat: with tilt = highest (1 - s^2) the integrand is smooth; Simpson's rule.
double timeFrom(double highest) {
  const auto integrand = [&](double s) {
    const double tilt = highest * (1 - s * s);
    const double half = 0.5 * (highest + tilt), fall = -2 * kCupHeight * std::sin(half) + 2 * kCupRadius * std::cos(half);
    const double share = s > 0 ? std::sin(0.5 * highest * s * s) / (s * s) : 0.5 * highest;  // of fall, over s^2
    return 2 * highest / std::sqrt(2 * kCupMass * 9.81 * fall * share / kAboutRim);
  };
  constexpr int kParts = 2000;
  double sum = integrand(0) + integrand(1);
  for (int i = 1; i < kParts; ++i) sum += (i % 2 ? 4 : 2) * integrand(static_cast<double>(i) / kParts);
  return sum / (3 * kParts);
}

// The tilt at which it stops that leaves flat at so many rad/s.
double highestOf(double rate) {
  double low = 0, high = 0.3;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (rateFrom(middle) < rate ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Each landing leaves 1 - 2 m r^2/I of the rate, I that about a point of the rim.
TEST(FlatRims, ACupRocksToRest) {
  const double keeps = 1 - 2 * kCupMass * kCupRadius * kCupRadius / kAboutRim, tilt = 10 * std::numbers::pi / 180;
  EXPECT_NEAR(keeps, 0.6614, 5e-5);
  for (const double heading : {0.0, 0.4})
    for (const double about_axis : {0.0, 0.3, std::numbers::pi / 4}) {
      SCOPED_TRACE("heading " + std::to_string(heading) + ", turned by " + std::to_string(about_axis));
      const Motion m = play(cup(tilt, heading, about_axis), 4);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      double time = timeFrom(tilt), rate = rateFrom(tilt);
      ASSERT_GT(m.events.size(), 10u);
      for (int landing = 1; landing <= 6; ++landing) {
        const Event& event = m.events[static_cast<std::size_t>(landing)];
        EXPECT_NE(event.kind, EventKind::transition);
        EXPECT_NEAR(event.time, time, 1e-11) << landing;
        EXPECT_NEAR(m.stateBefore(landing, 0).angular_velocity.norm(), rate, 1e-10 * rate) << landing;
        EXPECT_NEAR(m.stateAfter(landing, 0).angular_velocity.norm(), keeps * rate, 1e-10 * rate) << landing;
        rate *= keeps;
        time += 2 * timeFrom(highestOf(rate));
      }
      const BodyState end = m.stateAt(0, 4);
      EXPECT_NEAR(end.position.z(), 0.1, 1e-12);
      EXPECT_LT((end.orientation * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-12);
      EXPECT_EQ(end.velocity, Vec3::Zero());
      EXPECT_EQ(end.angular_velocity, Vec3::Zero());
      EXPECT_NEAR(m.events.back().time, 0.402, 1e-4);
    }
}

// Coins that were dropped tilted, and a cylinder off a table that lands on its edge and tips over to its cap.
TEST(FlatRims, ThatWereHandedOver) {
  for (const double tilt : {1e-9, 1e-6, 1e-3, 0.01, 0.1})
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE("tilt " + std::to_string(tilt) + ", friction " + std::to_string(friction));
      Body coin = makeBall("coin", 1, {0, 0, 0.5});
      coin.shape = Cylinder{0.3, 0.02};
      coin.orientation = Eigen::AngleAxisd(tilt, Vec3::UnitX());
      const Motion m = play(makeScene({0, 0, -9.81}, 0.3, friction, {coin, makePlane("p", Vec3::UnitZ(), 0)}), 5);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      const BodyState end = m.stateAt(0, 5);
      EXPECT_NEAR(end.position.z(), 0.01, 1e-12);
      EXPECT_LT(end.velocity.norm(), 1e-12);
      EXPECT_EQ(end.angular_velocity, Vec3::Zero());
    }
  Body log = makeBall("log", 1, {-0.6, 0, 0.1}, {2, 0, 0});
  log.shape = Cylinder{0.1, 0.3};
  log.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  const Motion m = play(makeScene({0, 0, -9.81}, 0, 0.1, {makePlane("p", Vec3::UnitZ(), -2), fixedBody(makeBox("table", {1, 2, 1}, {-0.5, 0, -0.5})), log}), 2);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_NEAR(m.stateAt(2, 2).position.z(), -1.85, 1e-12);
}

// Motions beside one that lands flat go round: it is not followed, and says so.
TEST(FlatRims, ReplaysSayThatTheyEndThere) {
  const Scene scene = cup(0.1, 0, 0);
  const Motion m = play(scene, 1);
  const MotionAlong along = simulateAlong(m, scene, m.geometry, 1);
  EXPECT_FALSE(along.complete);
  EXPECT_NE(along.why_not.find("became flat"), std::string::npos) << along.why_not;
}

// A cylinder that slides on its cap, whichever way its marks are turned. Friction presses it on the front of the cap: as long as that is
// within the disc it slides on flat and stops as a block does; else it tips over the foremost point of its rim.
TEST(FlatRims, SlideFlatOrTipWhereverTheirMarksAre) {
  constexpr double kSpeed = 1, kTime = 0.1;
  for (const double share : {0.75, 0.95, 1.05, 1.2}) {  // of the radius, ahead of the middle
    SCOPED_TRACE("share " + std::to_string(share));
    std::optional<BodyState> first;
    for (const double about_axis : {0.0, 0.2, 0.5, 0.785, 1.3}) {
      SCOPED_TRACE("turned by " + std::to_string(about_axis));
      Body body = makeBall("body", 1, {0, 0, 0.1}, {kSpeed, 0, 0});
      body.shape = Cylinder{0.1, 0.2};
      body.orientation = Eigen::AngleAxisd(about_axis, Vec3::UnitZ());
      const Motion m = play(makeScene({0, 0, -9.81}, 0, share, {body, makePlane("p", Vec3::UnitZ(), 0)}), share < 1 ? 1 : kTime);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      const BodyState early = m.stateAt(0, kTime);
      if (share < 1) {
        EXPECT_EQ(early.angular_velocity, Vec3::Zero());
        EXPECT_NEAR(m.stateAt(0, 1).position.x(), kSpeed * kSpeed / (2 * share * 9.81), 1e-12);
        continue;
      }
      EXPECT_GT(early.angular_velocity.y(), 0.1);
      EXPECT_NEAR(early.angular_velocity.x(), 0, 1e-11);
      if (!first) first = early;
      EXPECT_LT((early.position - first->position).norm(), 1e-11);
      EXPECT_LT((early.velocity - first->velocity).norm(), 1e-10);
      EXPECT_LT((early.angular_velocity - first->angular_velocity).norm(), 1e-9);
    }
  }
}

// It stays on a slope as steep as its disc carries it, where the line of its weight goes down between two marks.
TEST(FlatRims, RestWhereTheDiscCarriesThem) {
  for (const double about_axis : {0.0, 0.4, 0.785}) {
    const Eigen::AngleAxisd leaning(std::atan(0.95), Vec3::UnitX());
    Body body = makeBall("body", 1, leaning * Vec3(0, 0, 0.1));
    body.shape = Cylinder{0.1, 0.2};
    body.orientation = leaning * Eigen::AngleAxisd(about_axis, Vec3::UnitZ());
    const Motion m = play(makeScene({0, 0, -9.81}, 0, 2, {body, makePlane("p", leaning * Vec3::UnitZ(), 0)}), 1);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.stateAt(0, 1).velocity, Vec3::Zero());
    EXPECT_LT((m.stateAt(0, 1).position - body.position).norm(), 1e-12);
  }
}

struct Findings {
  double depth = 0;   // m, of the lowest point below the plane
  double growth = 0;  // of energy, as a share of the first
};

// How far a body reaches along -n.
double lowestPoint(const Shape& shape, const BodyState& s, const Vec3& n) {
  const Vec3 d = s.orientation.inverse() * n;
  const double across = std::hypot(d.x(), d.y());
  if (const auto* c = std::get_if<Cylinder>(&shape)) return n.dot(s.position) - 0.5 * c->height * std::abs(d.z()) - c->radius * across;
  const auto& c = std::get<Cone>(shape);
  return n.dot(s.position) + std::min(0.5 * c.height * d.z(), -0.5 * c.height * d.z() - c.radius * across);
}

// At 2000 times, and just after every event.
Findings findingsOf(const Motion& m, const Vec3& n) {
  Findings found;
  const BodyModel& model = (*m.models)[0];
  std::vector<double> times;
  for (int i = 0; i <= 2000; ++i) times.push_back(std::min(m.end, m.end * i / 2000));
  for (const Arc& arc : m.world_lines[0].arcs)
    for (const double later : {0.0, 1e-9, 1e-6}) times.push_back(std::min(m.end, arc.start() + later));
  std::ranges::sort(times);
  double last = 0, unit = 0;
  for (const double t : times) {
    const State s = m.world_lines[0].arcs[static_cast<std::size_t>(m.arcAt(0, t))].stateAt(t);
    const double energy = kineticEnergy(model, s) - model.mass * m.scene->gravity.dot(s.x);
    if (unit == 0) unit = kineticEnergy(model, s) + model.mass * m.scene->gravity.norm() * 0.1, last = energy;
    found.growth = std::max(found.growth, (energy - last) / unit);
    last = energy;
    found.depth = std::max(found.depth, -lowestPoint(m.scene->bodies[0].shape, m.stateAt(0, t), n));
  }
  return found;
}

Scene dropped(std::uint64_t seed, bool is_cone, bool is_planar, Vec3& n) {
  Random r(seed);
  Body body = makeBall("body", 1, Vec3::Zero());
  const double radius = r.in(0.03, 0.3), height = radius * (r.below(2) ? r.in(0.02, 0.3) : r.in(0.3, 6));
  if (is_cone) body.shape = Cone{radius, height};
  else body.shape = Cylinder{radius, height};
  constexpr std::array<double, 8> kTilts = {0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-2, 0.1, 0.5};
  const double tilt = kTilts[static_cast<std::size_t>(r.below(8))], heading = r.below(2) ? 0 : r.in(0, 6.28),
               about_axis = r.below(2) ? 0 : r.in(0, 6.28), slope = r.below(3) ? 0 : r.in(0, 0.3);
  const Eigen::AngleAxisd leaning(slope, Vec3(std::cos(heading), std::sin(heading), 0));
  n = leaning * Vec3::UnitZ();
  body.orientation = leaning * Eigen::AngleAxisd(heading, Vec3::UnitZ()) * Eigen::AngleAxisd(tilt, Vec3::UnitX()) *
                     Eigen::AngleAxisd(about_axis, Vec3::UnitZ());
  if (!is_planar) {
    body.velocity = r.vec(r.below(2) ? 0 : 1);
    body.angular_velocity = r.below(2) ? Vec3(0, 0, r.in(-10, 10)) : r.vec(r.below(2) ? 0.1 : 3);
  }
  constexpr std::array<double, 4> kBounces = {0, 1e-9, 0.3, 0.9};
  constexpr std::array<double, 5> kRubs = {0, 1e-9, 0.2, 1, 10};
  const double e = kBounces[static_cast<std::size_t>(r.below(4))], mu = kRubs[static_cast<std::size_t>(r.below(5))];
  BodyState start;
  start.orientation = body.orientation;
  body.position = -lowestPoint(body.shape, start, n) * n + Vec3(0, 0, r.below(3) == 0 ? 0 : r.in(0, 0.3));
  return makeScene({0, 0, -9.81}, e, mu, {body, makePlane("p", n, 0)});
}

// What an instant of 1e-10 s joins may be laid flat from so far apart.
constexpr double kDeepestOfInstant = 1e-9;

TEST(FlatRims, DropsKeepTheirEnergyAndStayAbove) {
  for (const bool is_cone : {false, true})
    for (const bool is_planar : {true, false}) {
      int complete = 0, all = 0;
      Findings worst;
      for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(8)); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed) + (is_cone ? ", cone" : ", cylinder") + (is_planar ? ", planar" : ""));
        Vec3 n;
        const Scene scene = dropped(seed, is_cone, is_planar, n);
        OdeContacts contacts(scene);
        SimulateOptions options;
        options.step_limit = 300'000;
        options.lowest_bounce = 1e-12;  // of less, as small bodies have by themselves, more of these end in rounding
        const Motion m = simulate(scene, contacts, 2, options);
        const Findings found = findingsOf(m, n);
        EXPECT_TRUE(found.depth <= kDeepestOfInstant) << found.depth << "; " << nameOf(m.status) << " " << m.message;
        EXPECT_TRUE(found.growth <= 1e-10) << found.growth << "; " << nameOf(m.status) << " " << m.message;
        EXPECT_FALSE(m.message.empty());
        ++all;
        complete += m.status == MotionStatus::complete;
        worst.depth = std::max(worst.depth, found.depth), worst.growth = std::max(worst.growth, found.growth);
      }
      EXPECT_GE(complete, 0.7 * all);
      std::printf("%s, %s: %d of %d complete, worst depth %.2g m, energy %.2g\n", is_cone ? "cones" : "cylinders",
                  is_planar ? "planar" : "any", complete, all, worst.depth, worst.growth);
    }
}

}  // namespace
}  // namespace carom::flat_rims
