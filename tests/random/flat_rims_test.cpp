// SPDX-License-Identifier: MIT
// Cylinders and cones that come to lie flat on their rims: rocking is impacts of the cap, in closed form, and ends at rest. The
// sweep drops them tilted by 0 to 0.5 rad, with and without spin; what is complete has no more energy than before and lies in
// no plane. CAROM_TEST_SCALE=20 drops 1600.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
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

// Motions beside one that lands flat go round: neither is it followed, nor are there derivatives through it, and both say so.
TEST(FlatRims, DerivativesAndReplaysSayThatTheyEndThere) {
  const Scene scene = cup(0.1, 0, 0);
  const Motion m = play(scene, 1);
  const MotionAlong along = simulateAlong(m, scene, m.geometry, 1);
  EXPECT_FALSE(along.complete);
  EXPECT_NE(along.why_not.find("lie flat"), std::string::npos) << along.why_not;
  try {
    gradientOf(m, 0, 1, 0);
    ADD_FAILURE() << "a derivative";
  } catch (const NotComputable& error) {
    EXPECT_NE(std::string(error.what()).find("lie flat"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carom::flat_rims
