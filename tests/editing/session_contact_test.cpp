// SPDX-License-Identifier: MIT
// Drags of where a body touches: over a curved surface, of its nail, and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "tests/editing/session_scenes.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

using Names = std::vector<std::string>;

constexpr double kPoleRadius = 0.3;

/// A box thrown onto a lying pole along y, whose axis is at z = 0.
Scene boxOnAPole() {
  Scene scene;
  scene.materials = {material("felt", 0.6, 0.3)};
  Body pole, box;
  pole.name = "pole", pole.fixed = true, pole.material = "felt", pole.shape = Capsule{kPoleRadius, 4};
  pole.orientation = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));
  box.name = "box", box.material = "felt", box.mass = 0.2, box.shape = Box{{0.2, 0.15, 0.1}}, box.position = {0, 0, 1};
  box.velocity = {0.2, 0.1, 0}, box.angular_velocity = {1, 2, 0.5};
  scene.bodies = {pole, box};
  return scene;
}

/// At an angle from the top, and the components that lie most in the surface there.
Vec3 onThePole(double angle, double y) { return {kPoleRadius * std::sin(angle), y, kPoleRadius * std::cos(angle)}; }
Names constrainedAt(double angle) { return std::abs(angle) < M_PI / 4 ? Names{"x", "y"} : Names{"y", "z"}; }

Vec3 touched(const EditSession& session) {
  const Motion& motion = session.motion();
  return motion.events[static_cast<std::size_t>(motion.findImpact(1, 1, 0).value())].contacts[0].at.point;
}

EditSession onAPole(const Scene& scene, ContactSource& contacts) {
  return EditSession(scene, contacts, 0.8, {velocity("box"), angularVelocity("box")}, {}, withoutClock());
}

TEST(SessionContact, GoesRoundAPole) {
  const Scene scene = boxOnAPole();
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    OdeContacts contacts(scene);
    EditSession session = onAPole(scene, contacts);
    session.grab("box", nthImpact(1, "pole"), {.contact = true, .components = {"x", "y"}});
    EXPECT_TRUE((session.grabbedPlace() - touched(session)).norm() == 0);
    const double to = (seed % 2 ? 1 : -1) * random.in(0.9, 1.2), y = random.in(-0.2, 0.2);
    for (int k = 1; k <= 6; ++k) session.slideTo(onThePole(to * k / 6, y * k / 6), constrainedAt(to * k / 6));
    const SessionUpdate update = session.releaseNailed();
    ASSERT_TRUE(update.reached) << update.message;
    EXPECT_TRUE((touched(session) - onThePole(to, y)).norm() <= 1e-8) << touched(session).transpose();
    const NailState nail = session.nailStates().at(0);
    EXPECT_TRUE(nail.met && nail.error <= 1e-9);
    session.grab("box", 0.1, {.orientation = true, .place = false});
    session.dragTo(session.grabbedPlace(), Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY())) * session.grabbedOrientation());
    EXPECT_TRUE(session.release().reached) << session.last().message;
    EXPECT_TRUE((touched(session) - onThePole(to, y)).norm() <= 1e-8) << "the nail holds while the box is turned before it";
  }
}

TEST(SessionContact, ItsNailIsDraggedAndKeepsItsRange) {
  const Scene scene = boxOnAPole();
  OdeContacts contacts(scene);
  EditSession session = onAPole(scene, contacts);
  session.grab("box", nthImpact(1, "pole"), {.contact = true, .components = {"x", "y"}});
  session.slideTo(onThePole(0.1, 0.1), {"x", "y"});
  session.releaseNailed();
  const NailId nail = session.nails().at(0);
  const Target before = session.constraintOf(nail).targets.at(0);
  EXPECT_EQ(before.quantity, "contact");
  const double sheet = 0.5 * (before.max[2] - before.min[2]);
  EXPECT_NEAR(sheet, 0.02 * Vec3(0.1, 0.075, 0.05).norm() + 0.01 * 2.3, 1e-12);
  session.grabNail(nail);
  const Vec3 to = onThePole(0.3, -0.1);
  EXPECT_TRUE(session.dragTo({to.x(), to.y(), 7}).reached) << "a place across the surface is not asked for";
  EXPECT_TRUE(session.release().reached);
  EXPECT_TRUE((touched(session) - to).norm() <= 1e-8);
  const Target after = session.constraintOf(nail).targets.at(0);
  EXPECT_TRUE(after.value[0] == to.x() && after.value[1] == to.y() && std::isnan(after.value[2]));
  EXPECT_NEAR(after.min[2], to.z() - sheet, 1e-8);
  EXPECT_NEAR(after.max[2], to.z() + sheet, 1e-8);
  EXPECT_TRUE(session.nailStates().at(0).met);
}

TEST(SessionContact, WhatMakesNoSenseIsRefusedAndChangesNothing) {
  const Scene scene = boxOnAPole();
  OdeContacts contacts(scene);
  EditSession session = onAPole(scene, contacts);
  EXPECT_THROW(session.grab("box", 0.1, {.contact = true}), InputError);
  EXPECT_THROW(session.grab("box", nthImpact(1), {.body_point = Vec3(0, 0, 0), .contact = true}), InputError);
  EXPECT_THROW(session.grab("box", nthImpact(1), {.contact = true, .orientation = true, .place = false}), InputError);
  EXPECT_THROW(session.slideTo(onThePole(0, 0), {"x", "y"}), InputError);
  session.grab("box", nthImpact(1), {});
  EXPECT_THROW(session.slideTo(onThePole(0, 0), {"x", "y"}), InputError) << "a point of the box is held";
  session.cancel();
  session.grab("box", nthImpact(1), {.contact = true, .components = {"x", "y"}});
  const Vec3 place = session.grabbedPlace();
  for (const Names& bad : {Names{}, Names{"x"}, Names{"x", "x"}, Names{"x", "w"}, Names{"x", "y", "z"}})
    EXPECT_THROW(session.slideTo(place, bad), InputError);
  EXPECT_THROW(session.slideTo({0, NAN, 0}, {"x", "y"}), InputError);
  EXPECT_TRUE(session.dragTo(place).reached);
  EXPECT_EQ(session.grabbedPlace(), place);
}

}  // namespace
}  // namespace carom
