// SPDX-License-Identifier: MIT
// Cones against closed forms: falls on apex, base, rim and side, and what they do to the motion.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/motion/body_geometry.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr double kRadius = 0.3, kHeight = 0.8, kGravity = 10, kElasticity = 0.6;

// A frictionless fall of a cone of mass 2; `fall` is the height of its lowest point.
Scene falling(const Quat& orientation, double height) {
  Body cone = makeBall("cone", 1, {0.1, -0.2, height});
  cone.shape = Cone{kRadius, kHeight};
  cone.mass = 2;
  cone.orientation = orientation;
  return makeScene({0, 0, -kGravity}, kElasticity, 0, {cone, makePlane("floor", Vec3::UnitZ(), 0)});
}

Quat turnedAbout(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); }

TEST(Cone, BouncesOnItsApexAndOnItsBase) {
  for (const bool on_apex : {false, true}) {
    SCOPED_TRACE(on_apex ? "apex" : "base");
    const Scene scene = falling(on_apex ? Quat(0, 1, 0, 0) : Quat::Identity(), 1.4);
    const double fall = 1.4 - kHeight / 2, t = std::sqrt(2 * fall / kGravity), v = kGravity * t;
    const Motion m = play(scene, 1.5 * t, 1);
    ASSERT_EQ(m.events.size(), 1u);
    expectEntries(m.events[0].time, t, 1e-14, "time");
    EXPECT_EQ(m.events[0].contacts.size(), on_apex ? 1u : 4u);
    const BodyState after = m.stateAt(0, 1.25 * t);
    expectEntries(after.velocity, Vec3(0, 0, kElasticity * v - kGravity * 0.25 * t), 1e-12, "velocity");
    expectEntries(after.angular_velocity, Vec3::Zero(), 1e-12, "it stays upright");
    EXPECT_NE(m.describeEvent(0).find(on_apex ? "apex" : "mark"), std::string::npos) << m.describeEvent(0);
  }
}

// Tilted by a: the rim's lowest point R (+-r, 0, -h/2), seen from the centre of mass R (0, 0, -h/4). With the lever x
// across the impulse P = (1 + e) v/(1/m + x^2/I), the velocity becomes -v + P/m and the spin P x/I.
TEST(Cone, TurnsAboutTheCentreOfMassWhenItsRimStrikes) {
  for (const double a : {0.2, 0.7, -0.4, 1.2}) {
    SCOPED_TRACE("tilt " + std::to_string(a));
    const double side = a > 0 ? 1 : -1, m = 2, inertia = 3. / 80 * m * (4 * kRadius * kRadius + kHeight * kHeight);
    const double low = -kHeight / 2 * std::cos(a) - kRadius * std::abs(std::sin(a));
    const double t = std::sqrt(2 * (2 + low) / kGravity), v = kGravity * t;
    const Motion motion = play(falling(turnedAbout(Vec3::UnitY(), a), 2), 1.01 * t, 1);
    ASSERT_EQ(motion.events.size(), 1u);
    expectEntries(motion.events[0].time, t, 1e-14, "time");
    const double x = side * kRadius * std::cos(a) - kHeight / 4 * std::sin(a);
    const double P = (1 + kElasticity) * v / (1 / m + x * x / inertia);
    const Event& event = motion.events[0];
    ASSERT_EQ(event.contacts.size(), 1u);
    EXPECT_NE(motion.describeEvent(0).find("rim"), std::string::npos) << motion.describeEvent(0);
    const BodyState after = motion.stateAt(0, t * (1 + 1e-12));
    expectEntries(after.angular_velocity, Vec3(0, -x * P / inertia, 0), 1e-9, "spin");
    expectEntries(after.velocity, Vec3(0, 0, -v + P / m), 1e-9, "velocity of the centre of mass");
  }
}

// The side leans by b from the axis, tan b = r/h. Before a floor under which the cone is tilted by a the side is below
// the rim where cos(a - b) > 0, and that changes by r and h as b does.
TEST(Cone, LimitsOfItsRimAndApexAndTheirRatesBySize) {
  for (const double a : {0.2, 0.7, -0.4, 1.2, 1.9, 2.8, -3.0}) {
    SCOPED_TRACE("tilt " + std::to_string(a));
    const Motion motion = play(falling(turnedAbout(Vec3::UnitY(), a), 2), 1, 1);
    ASSERT_EQ(motion.events.size(), 1u);
    const Contact& c = motion.events[0].contacts[0];
    const auto bodies = std::dynamic_pointer_cast<const BodyGeometry>(motion.geometry);
    ASSERT_TRUE(bodies);
    const BodyState at = motion.stateAt(0, motion.events[0].time);
    const Mat3 R = at.orientation.toRotationMatrix();
    const Pose cone{at.position - kHeight / 4 * R.col(2), R}, floor{Vec3::Zero(), Mat3::Identity()};
    const std::vector<FeatureLimit> limits = bodies->limits(c.a, c.b, c.features, cone, floor);
    const auto side = std::find_if(limits.begin(), limits.end(), [](const FeatureLimit& limit) {
      return limit.beyond.find("side") != std::string::npos;
    });
    ASSERT_TRUE(side != limits.end());
    const double square = kRadius * kRadius + kHeight * kHeight, b = std::atan2(kRadius, kHeight);
    const Vec3 n = cone.R.transpose() * c.at.normal;
    const bool on_apex = std::abs(a) > 2;
    const double way = on_apex ? -1 : 1;
    EXPECT_EQ(side->beyond.find("apex") != std::string::npos, on_apex);
    expectEntries(side->normal_weight.dot(n), way * std::cos(std::abs(a) - b), 1e-14, "value");
    ASSERT_EQ(side->normal_rates.cols(), 2);
    expectEntries(Vec2(side->normal_rates.transpose() * n),
                  Vec2(way * std::sin(std::abs(a) - b) / square * Vec2(kHeight, -kRadius)), 1e-13,
                  "rates by radius and height");
    expectEntries(Vec2(side->normal_rates.transpose() * side->normal_weight), Vec2::Zero().eval(), 1e-14,
                  "it stays unit");
  }
}

}  // namespace
}  // namespace carom
