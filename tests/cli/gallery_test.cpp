// SPDX-License-Identifier: MIT
// What the scenes of docs/gallery.md show: each motion is known to its end, and what it is there for comes about.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

Motion motionOf(const std::string& name) {
  const Document document = readDocument(scenePath(name));
  OdeContacts contacts(document.scene);
  return simulate(document.scene, contacts, document.duration);
}

// A point of the world in the axes of a body.
Vec3 seenFrom(const BodyState& body, const Vec3& world) {
  return body.orientation.conjugate() * (world - body.position);
}

double energyAt(const Motion& motion, double t) {
  double sum = 0;
  for (std::size_t i = 0; i < motion.world_lines.size(); ++i) {
    const BodyModel& model = (*motion.models)[i];
    if (!model.moving) continue;
    const BodyState s = motion.stateAt(static_cast<int>(i), t);
    const Mat3 R_WG = s.orientation.toRotationMatrix();
    const Vec3 w = model.R_BG * R_WG.transpose() * s.angular_velocity, x = s.position + R_WG * model.center;
    sum += 0.5 * model.mass * s.velocity.squaredNorm() + 0.5 * model.inertia.dot(w.cwiseAbs2()) -
           model.mass * motion.scene->gravity.dot(x);
  }
  return sum;
}

class Gallery : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, testing::Values("hat", "mug", "dice", "bowling", "ball_in_cup"),
                         [](const auto& scene) { return scene.param; });

TEST_P(Gallery, IsKnownToItsEndAndGainsNoEnergy) {
  const Motion motion = motionOf(GetParam());
  EXPECT_EQ(motion.status, MotionStatus::complete) << motion.message;
  EXPECT_GE(motion.events.size(), 5u);
  double before = energyAt(motion, 0);
  const double rounding = 1e-12 * std::abs(before);
  for (const Event& event : motion.events) {
    const double after = energyAt(motion, event.time);
    EXPECT_TRUE(after <= before + rounding) << "at " << event.time << " s: " << after - before << " J more";
    before = after;
  }
}

TEST(GalleryScene, TheHatHangsOnThePeg) {
  const Motion motion = motionOf("hat");
  const Vec3 tip = seenFrom(motion.stateAt("hat", motion.end), Vec3(-0.1532, 0, 1.5786));
  EXPECT_LT(std::hypot(tip.x(), tip.y()), 0.084);
  EXPECT_GT(tip.z(), 0.02);
  EXPECT_LT(tip.z(), 0.108);
}

TEST(GalleryScene, TheSpoonFallsIntoTheMug) {
  const Motion motion = motionOf("mug");
  const BodyState spoon = motion.stateAt("spoon", 0.29);
  const Vec3 end = seenFrom(motion.stateAt("mug", 0.29), spoon.position - spoon.orientation * Vec3(0, 0, 0.055));
  EXPECT_LT(std::hypot(end.x(), end.y()), 0.033);
  EXPECT_GT(end.z(), 0.009);
  EXPECT_LT(end.z(), 0.09);
}

TEST(GalleryScene, TheDiceStayOnTheTable) {
  const Motion motion = motionOf("dice");
  for (const Body& body : motion.scene->bodies) {
    if (body.fixed) continue;
    const Vec3 x = motion.stateAt(body.name, motion.end).position;
    EXPECT_LT(std::abs(x.x()), 0.3) << body.name;
    EXPECT_LT(std::abs(x.y()), 0.21) << body.name;
    EXPECT_GT(x.z(), 0.0079) << body.name;
  }
}

TEST(GalleryScene, AllPinsFall) {
  const Motion motion = motionOf("bowling");
  for (int pin = 1; pin <= 10; ++pin) {
    const BodyState s = motion.stateAt("pin " + std::to_string(pin), motion.end);
    EXPECT_LT((s.orientation * Vec3::UnitZ()).z(), 0.9) << "pin " << pin;
  }
}

TEST(GalleryScene, TheBallEndsInTheCup) {
  const Motion motion = motionOf("ball_in_cup");
  const Vec3 x = motion.stateAt("ball", motion.end).position - Vec3(0.6, 0, 0);
  EXPECT_LT(std::hypot(x.x(), x.y()), 0.08);
  EXPECT_LT(x.z(), 0.12);
}

}  // namespace
}  // namespace carom::test
