// SPDX-License-Identifier: MIT
#include "editing/problem/edit_problem.hpp"
#include "editing/report/certify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "editing/edit.h"
#include "editing/problem/margins/event_margins.hpp"
#include "editing/problem_of.hpp"
#include "editing/report/motion_checks.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

/// Everything that the margins of a problem are read from, at given changes.
struct Margins_ {
  Motion motion;
  std::vector<EventMargin> margins;
};
Margins_ marginsAt(const EditProblem& problem, const Eigen::VectorXd& changes, std::size_t count,
                   const std::vector<ReadInstant>& instants) {
  const Eigen::VectorXd values = problem.controls.valuesOf(changes), rates = problem.controls.valueRates(changes);
  Margins_ out{simulate(problem.controls.sceneAt(values), *problem.contacts, problem.duration), {}};
  DerivativeTape tape(out.motion);
  out.margins = eventMargins(tape, count, instants, [&](const SceneGradient& g) {
    return Eigen::VectorXd(problem.controls.gather(g, values).cwiseProduct(rates));
  });
  return out;
}

// Central differences of every margin along one direction of all controls at once, against the gradients.
void expectGradients(const EditProblem& problem, std::size_t count, const std::vector<ReadInstant>& instants,
                     std::set<EventMargin::Way>* seen) {
  const Eigen::Index n = problem.controls.size();
  const Margins_ here = marginsAt(problem, Eigen::VectorXd::Zero(n), count, instants);
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd direction(n);
    for (Eigen::Index j = 0; j < n; ++j)
      direction[j] = std::cos(1.7 * static_cast<double>(j + 1) + 0.9 * k) * (j % 3 == k ? 1.5 : 0.5);
    // differences over h and 2h, extrapolated: their error is of the fourth order
    const double h = 1e-6;
    const auto at = [&](double length) { return marginsAt(problem, length * direction, count, instants).margins; };
    const std::vector<EventMargin> values[] = {at(-2 * h), at(-h), at(h), at(2 * h)};
    for (const auto& margins : values) ASSERT_EQ(margins.size(), here.margins.size());
    for (std::size_t i = 0; i < here.margins.size(); ++i) {
      const EventMargin& m = here.margins[i];
      if (seen) seen->insert(m.way);
      if (m.way == EventMargin::Way::slides) continue;  // its direction of slip is chosen afresh
      const auto v = [&](int j) { return values[j][i].value; };
      const double found = m.gradient.dot(direction), expected = (8 * (v(2) - v(1)) - (v(3) - v(0))) / (12 * h);
      const double scale = std::max({std::abs(expected), m.gradient.norm(), 1e-3});
      EXPECT_TRUE(std::abs(found - expected) <= 1e-6 * scale)
          << m.what << ": found " << found << ", expected " << expected << ", way " << static_cast<int>(m.way);
    }
  }
}

TEST(EventMargins, GradientsOfAThrownBoxByEveryControl) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1.2, everyControl(), {});
  const Motion motion = simulate(problem.controls.startScene(), contacts, 1.2);
  ASSERT_GE(motion.events.size(), 2u);
  std::set<EventMargin::Way> seen;
  expectGradients(problem, motion.events.size(), {{-1, 1.0}, {1, 0.5}}, &seen);
  for (const auto way :
       {EventMargin::Way::grazes, EventMargin::Way::leaves, EventMargin::Way::order, EventMargin::Way::is_read})
    EXPECT_TRUE(seen.count(way)) << static_cast<int>(way);
}

// The rim of a cone, whose side leans by an angle that its size decides.
TEST(EventMargins, GradientsOfAThrownConeByEveryControl) {
  Scene scene = thrownBox();
  scene.bodies[1].shape = Cone{0.2, 0.35};
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 0.8, everyControl(), {});
  const Motion motion = simulate(problem.controls.startScene(), contacts, 0.8);
  const auto on_rim = [&](const Event& event) {
    const Contact& c = event.contacts[0];
    return motion.geometry->describe(c.a, c.b, c.features).find("rim") != std::string::npos;
  };
  ASSERT_TRUE(std::any_of(motion.events.begin(), motion.events.end(), on_rim));
  expectGradients(problem, motion.events.size(), {{-1, 0.75}}, nullptr);
}

/// Two boxes that meet in the air, edges and corners on faces.
Scene twoBoxes() {
  Scene scene = thrownBox();
  Body other = scene.bodies[1];
  other.name = "other";
  other.shape = Box{{0.25, 0.3, 0.2}};
  other.position = {1.1, 0.15, 1.25};
  other.velocity = {-1.5, 0, 1};
  other.orientation = Quat(0.7, -0.3, 0.5, 0.2).normalized();
  other.angular_velocity = {-1, 0.5, 2};
  scene.bodies.push_back(other);
  return scene;
}

TEST(EventMargins, GradientsOfTwoBoxesThatMeet) {
  const Scene scene = twoBoxes();
  OdeContacts contacts(scene);
  std::vector<Control> controls = everyControl();
  controls.push_back(velocity("other"));
  controls.push_back(size("other"));
  controls.push_back(position("floor"));
  const EditProblem problem(scene, contacts, 0.8, controls, {});
  const Motion motion = simulate(problem.controls.startScene(), contacts, 0.8);
  ASSERT_TRUE(motion.findImpact(1, 1, 2).has_value());
  expectGradients(problem, motion.events.size(), {{-1, 0.75}}, nullptr);
}

/// The real distance along the predicted direction at which the impacts that count become others.
double realRadius(const EditProblem& problem, const Certificate& certificate, double furthest) {
  const auto signature = [&](double length) {
    const Eigen::VectorXd values =
        problem.controls.valuesOf(length / certificate.signature_radius * certificate.signature_step);
    const Motion motion = simulate(problem.controls.sceneAt(values), *problem.contacts, problem.duration);
    return motion.signature(problem.constraints.extentIn(motion).events);
  };
  const std::string here = signature(0);
  double low = 0, high = furthest;
  if (signature(high) == here) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (signature(middle) == here ? low : high) = middle;
  }
  return high;
}

Certificate certificateOf(const Edit& edit) {
  const EditProblem problem = problemOf(edit);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.unknowns());
  const Motion motion = simulate(problem.controls.startScene(), *problem.contacts, problem.duration);
  return certify(problem, zero, motion, problem.constraints.evaluate(motion));
}

void expectRadius(const Edit& edit, double share, const std::string& word) {
  const Certificate certificate = certificateOf(edit);
  ASSERT_TRUE(std::isfinite(certificate.signature_radius));
  EXPECT_NE(certificate.signature_event.find(word), std::string::npos) << certificate.signature_event;
  EXPECT_NEAR(certificate.signature_step.norm(), certificate.signature_radius, 1e-12);
  const double real = realRadius(problemOf(edit), certificate, 3 * certificate.signature_radius);
  EXPECT_TRUE(std::abs(real - certificate.signature_radius) <= share * real)
      << certificate.signature_event << " Found " << certificate.signature_radius << ", really " << real;
}

TEST(Certificate, RadiusToAnInstantThatIsRead) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  const double wall = simulate(scene, contacts, 0.6).events.back().time;
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", wall + 0.003).position({0, 0, 1});
  expectRadius(edit, 0.02, "the time of a constraint");
}

TEST(Certificate, RadiusToSliding) {
  Scene scene = floorAndWall();
  scene.materials[0].friction = 0.1;
  OdeContacts contacts(scene);
  // bisect the speed at which the first impact slides
  double low = 0, high = 8;
  for (int i = 0; i < 30; ++i) {
    scene.bodies[2].velocity.x() = 0.5 * (low + high);
    const Motion motion = simulate(scene, contacts, 0.25);
    (motion.events[0].mode == ImpactMode::stick ? low : high) = scene.bodies[2].velocity.x();
  }
  scene.bodies[2].velocity.x() = 0.99 * low;
  Edit edit(scene, contacts, 0.3);
  edit.vary(velocity("ball"), friction("rubber"));
  edit.nail("ball", 0.28).position({0, 0, 1});
  expectRadius(edit, 0.02, "starts to slide");
  scene.bodies[2].velocity.x() = 1.01 * high;
  Edit back(scene, contacts, 0.3);
  back.vary(velocity("ball"));
  back.nail("ball", 0.28).position({0, 0, 1});
  expectRadius(back, 0.02, "sticks");
}

TEST(Certificate, RadiusToAMiss) {
  Scene scene;
  scene.gravity.setZero();
  scene.materials = {material("rubber", 0.9, 0)};
  Body post = ball("post", "rubber", 0.5, {2, 0, 0}, Vec3::Zero());
  post.fixed = true, post.mass.reset();
  scene.bodies = {post, ball("ball", "rubber", 0.1, {0, 0.595, 0}, {4, 0, 0})};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(position("ball").only({"y"}));
  edit.nail("ball", 0.9).position({0, 0, 1});
  expectRadius(edit, 0.03, "grazes");
}

TEST(Certificate, RadiusToAnotherCorner) {
  Scene scene = thrownBox();
  scene.bodies[1].orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.01, Vec3::UnitY()));
  scene.bodies[1].angular_velocity.setZero();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.75);
  edit.vary(orientation("box"));
  edit.nail("box", nthImpact(1)).position({0, 0, any});
  // the other corner comes down a moment later: it is named as the one that the first is left for, or as the next
  expectRadius(edit, 0.02, "'floor' with 'box'");
}

TEST(Certificate, RadiusToTheEndOfTheMotion) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, simulate(scene, contacts, 0.6).events.back().time + 0.002);
  edit.vary(velocity("ball"));
  edit.nail("ball", nthImpact(2)).position({any, 0, 1});
  expectRadius(edit, 0.02, "after the end");
}

TEST(Certificate, RadiusToTheBorderOfAFace) {
  Scene scene;
  scene.gravity.setZero();
  scene.materials = {material("rubber", 0.9, 0)};
  Body table = ball("table", "rubber", 1, {0, 0, 0}, Vec3::Zero());
  table.shape = Box{{2, 2, 0.1}}, table.fixed = true, table.mass.reset();
  scene.bodies = {table, ball("ball", "rubber", 0.1, {0.98, 0, 0.5}, {0, 0, -1})};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(position("ball"), velocity("ball").only({"y"}));
  edit.nail("ball", 0.9).position({0, 0, 1});
  expectRadius(edit, 1e-6, "to the border of face");
  EXPECT_NEAR(certificateOf(edit).signature_radius, 0.02 / 0.2, 1e-12);  // by the diameter of the ball
}

TEST(Certificate, RadiusToImpactsThatChangePlaces) {
  Scene scene = floorAndWall();
  scene.gravity.setZero();
  scene.bodies[2].position = {0, 0, 1.5};
  scene.bodies[2].velocity = {4, 0, -3.4};  // wall at 0.4125 s, floor at 0.41176 s
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.6).position({0, 0, 1});
  expectRadius(edit, 0.02, "change order");
}

TEST(Certificate, OfASolvedEdit) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"), angularVelocity("box"), mass("box"));
  edit.nail("box", 0.9).position({1.4, 0.3, 0.4});
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const Certificate& c = r.certificate;
  EXPECT_TRUE(c.taken);
  EXPECT_EQ(c.residual, r.residual);
  EXPECT_TRUE(c.energy_drift <= 1e-12) << c.energy_drift;
  EXPECT_TRUE(c.energy_gain <= 1e-12) << c.energy_gain;
  ASSERT_TRUE(c.deepest_penetration.has_value());
  EXPECT_TRUE(*c.deepest_penetration <= 1e-12) << *c.deepest_penetration;
  EXPECT_GT(c.signature_radius, 0);
  EXPECT_TRUE(std::isfinite(c.signature_radius));
  EXPECT_FALSE(c.signature_event.empty());
  EXPECT_TRUE(r.why_not.sentences.empty());
  EditOptions plain;
  plain.certify = false;
  EXPECT_FALSE(edit.solve(plain).certificate.taken);
}

// A start that meets everything stays in the words of the person; tilts and masses are then written by nobody.
TEST(Certificate, OfAStartThatStays) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"), mass("box"), inertia("box"), tilt("box", 1));
  edit.nail("box", 0.9).position(simulate(scene, contacts, 0.9).stateAt("box", 0.9).position);
  const EditResult r = edit.solve();
  EXPECT_EQ(r.iterations, 0);
  EXPECT_TRUE(std::isfinite(r.certificate.signature_radius));
  EXPECT_EQ(r.certificate.signature_step.size(), 3 + 1 + 3 + 2);
}

TEST(Certificate, SeesWhatIsWrong) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Motion motion = simulate(scene, contacts, 0.6);
  EXPECT_LE(energyDrift(motion, 16), 1e-13);
  EXPECT_LE(deepestPenetration(motion, 16).value(), 1e-12);
  // a motion that goes on through the wall
  Motion through = simulate(scene, contacts, 0.2);
  Scene without = scene;
  without.bodies[1].shape = Plane{-Vec3::UnitX(), -10};
  OdeContacts far(without);
  through = simulate(without, far, 0.6);
  through.geometry = motion.geometry;
  EXPECT_GT(deepestPenetration(through, 16).value(), 0.1);
  // an impact that adds energy
  Scene lively = scene;
  motion.events[0].participants[0].before.v *= 0.9;
  EXPECT_GT(energyGain(motion), 0.05);
}

}  // namespace
}  // namespace carom
