// SPDX-License-Identifier: MIT
// Where a body touches: closed forms, the same by rows that were there before, several contacts at once, and edits by it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;

constexpr double kExact = 1e-13;

RowsAndJacobian evaluated(const EditProblem& problem) {
  const Eigen::VectorXd values = problem.controls.startValues();
  const RowsAndJacobian found = evaluateByAdjoint(problem, values), forward = evaluateByTangent(problem, values);
  EXPECT_TRUE(found.rows.available) << found.rows.message;
  for (Eigen::Index i = 0; i < found.jacobian.rows(); ++i)
    test::expectEntries(Eigen::VectorXd(forward.jacobian.row(i)), Eigen::VectorXd(found.jacobian.row(i)), 1e-12,
                        problem.constraints.describeRow(static_cast<int>(i)), found.jacobian.cwiseAbs().maxCoeff());
  return found;
}

/// By the largest derivative of all rows, as that across a plane is 0.
void expectRow(const RowsAndJacobian& found, int row, double value, const Eigen::VectorXd& gradient, double tolerance) {
  EXPECT_TRUE(std::abs(found.rows.values[row] - value) <= tolerance * (1 + std::abs(value))) << found.rows.values[row];
  test::expectEntries(Eigen::VectorXd(found.jacobian.row(row)), gradient, tolerance, "row " + std::to_string(row),
                      found.jacobian.cwiseAbs().maxCoeff());
}

// A ball on a plane: c = x + v t - r n, where n.(x + v t + g t^2/2) = r.
TEST(ContactPlace, OfABallOnAPlaneIsAClosedForm) {
  Scene scene;
  scene.gravity = {0.3, -0.2, -9.8};
  scene.materials = {material("rubber", 0.8, 0.3)};
  const Vec3 n = Vec3(0.2, -0.1, 1).normalized(), g = scene.gravity;
  scene.bodies = {fixedPlane("floor", "rubber", n, 0), ball("ball", "rubber", 0.1, {0.4, 0.3, 1}, {1, 0.5, -2})};
  const Vec3 x = scene.bodies[1].position, v = scene.bodies[1].velocity;
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1, {position("ball"), velocity("ball"), size("ball"), gravity()},
                            {{"ball", nthImpact(1), {{"contact", {0, 0, 0}}}}});
  const RowsAndJacobian found = evaluated(problem);
  const double a = 0.5 * n.dot(g), b = n.dot(v), c = n.dot(x) - 0.1;
  const double t = (-b - std::sqrt(b * b - 4 * a * c)) / (2 * a);
  const Vec3 u = v + t * g, place = x + t * v + 0.5 * t * t * g - 0.1 * n;
  for (int k = 0; k < 3; ++k) {
    // dt = -(n.dx + t n.dv + t^2/2 n.dg - dr)/(n.u)
    const double by_time = -u[k] / n.dot(u);
    const Vec3 by_place = Vec3::Unit(k) + by_time * n;
    Eigen::VectorXd row(10);
    row << by_place, t * by_place, -n[k] - by_time, 0.5 * t * t * by_place;
    expectRow(found, k, place[k], row, 10 * kExact);
  }
}

// The corner of a box on a plane is a point of the box, whose row is another one.
TEST(ContactPlace, OfACornerIsThatOfThePoint) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1);
  const int event = motion.findImpact(1, 2, 0).value();
  const BodyState before = motion.stateBefore(event, 1);
  const Vec3 corner = before.orientation.conjugate() *
                      (motion.events[static_cast<std::size_t>(event)].contacts[0].at.point - before.position);
  std::vector<Control> controls = everyControl();
  std::erase_if(controls, [](const Control& c) { return c.vary == "size"; });  // the corner goes with it, the point does not
  const EditProblem problem(scene, contacts, 1, controls,
                            {{"box", nthImpact(2, "floor"), {{"contact", {0, 0, 0}}, {"point", {0, 0, 0}, corner}}}});
  const RowsAndJacobian found = evaluated(problem);
  for (int k = 0; k < 3; ++k)
    expectRow(found, k, found.rows.values[3 + k], found.jacobian.row(3 + k).transpose(), 100 * kExact);
}

// Of two balls it divides the way between their centres as the radii do: c = (r_b x_a + r_a x_b)/(r_a + r_b).
TEST(ContactPlace, OfTwoBallsLiesBetweenThem) {
  std::vector<RowsAndJacobian> both;
  for (const bool reversed : {false, true}) {
    Scene scene;
    scene.gravity = {0, 0, -9.8};
    scene.materials = {material("rubber", 0.8, 0.3)};
    scene.bodies = {ball("a", "rubber", 0.1, {0, 0, 1}, {2, 0.1, 1}), ball("b", "rubber", 0.3, {1, 0.1, 1.2}, {-1, 0.2, 0.5})};
    scene.bodies[0].angular_velocity = {3, 1, 2};
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    OdeContacts contacts(scene);
    const EditProblem problem(scene, contacts, 1, {velocity("a"), velocity("b"), position("b"), gravity()},
                              {{"a", nthImpact(1, "b"), {{"contact", {0, 0, 0}}, {"position", {0, 0, 0}}}},
                               {"b", nthImpact(1), {{"contact", {0, 0, 0}}, {"position", {0, 0, 0}}}}});
    const RowsAndJacobian found = evaluated(problem);
    for (int k = 0; k < 3; ++k) {
      const double value = 0.75 * found.rows.values[3 + k] + 0.25 * found.rows.values[9 + k];
      const Eigen::VectorXd row = 0.75 * found.jacobian.row(3 + k) + 0.25 * found.jacobian.row(9 + k);
      expectRow(found, k, value, row, 10 * kExact);
      expectRow(found, 6 + k, value, row, 10 * kExact);
    }
    both.push_back(found);
  }
  for (int i = 0; i < 12; ++i)
    expectRow(both[1], i, both[0].rows.values[i], both[0].jacobian.row(i).transpose(), 10 * kExact);
}

// The contacts of a bar that comes down level are those at its ends: the mean is below its middle.
TEST(ContactPlace, OfSeveralContactsIsTheirMean) {
  Scene scene;
  scene.gravity = {0, 0, -9.8};
  scene.materials = {material("felt", 0.5, 0.4)};
  Body bar;
  bar.name = "bar", bar.material = "felt", bar.density = 500, bar.shape = Box{{0.4, 0.2, 0.1}};
  bar.position = {0.3, -0.2, 0.6}, bar.velocity = {0.5, 0.25, 0};
  scene.bodies = {fixedPlane("floor", "felt", {0, 0, 1}, 0), bar};
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1, {velocity("bar")},
                            {{"bar", nthImpact(1), {{"contact", {0, 0, 0}}, {"position", {0, 0, 0}}}}});
  const RowsAndJacobian found = evaluated(problem);
  for (int k = 0; k < 2; ++k)
    expectRow(found, k, found.rows.values[3 + k], found.jacobian.row(3 + k).transpose(), 10 * kExact);
  EXPECT_TRUE(std::abs(found.rows.values[2]) <= kExact);
}

// Where a ball touches a pole decides how it goes on: edits by the place of the contact, of many throws.
TEST(ContactPlace, EditsBringItThere) {
  Scene scene;
  scene.materials = {material("felt", 0.6, 0.3)};
  Body pole;
  pole.name = "pole", pole.fixed = true, pole.material = "felt", pole.shape = Capsule{0.3, 4};
  pole.orientation = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));
  Body box;
  box.name = "box", box.material = "felt", box.mass = 0.2, box.shape = Box{{0.2, 0.15, 0.1}}, box.position = {0, 0, 1};
  box.velocity = {0.2, 0.1, 0}, box.angular_velocity = {1, 2, 0.5};
  scene.bodies = {pole, box};
  test::Random random(3);
  for (int trial = 0; trial < 8; ++trial) {
    const double x = random.in(-0.2, 0.2), y = random.in(-0.4, 0.4), z = std::sqrt(0.09 - x * x);
    SCOPED_TRACE("trial " + std::to_string(trial));
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 0.8);
    edit.vary(velocity("box"), angularVelocity("box"));
    edit.nail("box", nthImpact(1, "pole")).contact(x, y, within(z - 0.02, z + 0.02));
    const EditResult result = edit.solve();
    ASSERT_TRUE(result.solved()) << result.message;
    const Motion& motion = result.motion;
    const Event& event = motion.events[static_cast<std::size_t>(motion.findImpact(1, 1, 0).value())];
    const Vec3 at = event.contacts[0].at.point;
    EXPECT_TRUE((at - Vec3(x, y, z)).norm() <= 1e-8) << at.transpose();
  }
}

}  // namespace
}  // namespace carom
