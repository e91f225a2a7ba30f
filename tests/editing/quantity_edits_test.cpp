// SPDX-License-Identifier: MIT
// Edits that hold speed, kinetic energy, impulse and height, and what is said where they have no derivative.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/scene/body_model.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;

EditResult solvedEdit(const Edit& edit) {
  EditResult result = edit.solve();
  EXPECT_TRUE(result.solved()) << nameOf(result.status) << ": " << result.message;
  EXPECT_TRUE(result.scaled_residual <= 1e-9) << result.scaled_residual;
  return result;
}

double energyOf(const Scene& scene, const BodyState& s, int body) {
  const BodyModel model = modelOf(scene.bodies[static_cast<std::size_t>(body)]);
  const Mat3 J = model.R_BG.transpose() * model.inertia.asDiagonal() * model.R_BG;
  const Vec3 w = s.orientation.conjugate() * s.angular_velocity;
  return 0.5 * (model.mass * s.velocity.squaredNorm() + w.dot(J * w));
}

TEST(QuantityEdits, Speed) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"));
  edit.nail("box", nthImpact(1, "floor")).speed(4.5);
  const EditResult result = solvedEdit(edit);
  EXPECT_NEAR(result.motion.stateBefore(0, 1).velocity.norm(), 4.5, 1e-8);
  EXPECT_GT(result.objective, 0);
}

TEST(QuantityEdits, SpeedOfOneBodySeenFromAnother) {
  Scene scene = thrownBox();
  scene.bodies.push_back(ball("ball", "felt", 0.1, {3, 0, 1}, {-1, 0.2, 1}));
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.4);
  edit.vary(velocity("box"), velocity("ball"));
  edit.nail("box", 0.3).speed(atMost(1.5)).relativeTo("ball");
  const EditResult result = solvedEdit(edit);
  const Vec3 apart = result.motion.stateAt("box", 0.3).velocity - result.motion.stateAt("ball", 0.3).velocity;
  EXPECT_NEAR(apart.norm(), 1.5, 1e-8);  // at the near end of the range
}

TEST(QuantityEdits, KineticEnergy) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"), angularVelocity("box"), mass("box"));
  edit.nail("box", 0.3).kineticEnergy(8);
  const EditResult result = solvedEdit(edit);
  EXPECT_NEAR(energyOf(result.scene, result.motion.stateAt("box", 0.3), 1), 8, 1e-8);
}

TEST(QuantityEdits, Impulse) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"), elasticity("felt"), mass("box"));
  Nail nail = edit.nail("box", nthImpact(1, "floor")).impulse(within(12, 14));
  const auto found = [](const EditResult& result) { return result.motion.events[0].contacts[0].impulse.norm(); };
  EXPECT_NEAR(found(solvedEdit(edit)), 12, 1e-5);  // the near end of the range, as near as the solver's barrier comes
  nail.impulse(12.5);
  EXPECT_NEAR(found(solvedEdit(edit)), 12.5, 1e-8);
}

TEST(QuantityEdits, Height) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"), angularVelocity("box"));
  edit.nail("box", 0.3).height(1.4);
  edit.nail("box", between(0.05, 0.15)).height(1.25);
  const EditResult result = solvedEdit(edit);
  const BodyState s = result.motion.stateAt("box", 0.3);
  const Vec3 half(0.15, 0.1, 0.05);
  const Mat3 R = s.orientation.toRotationMatrix();
  EXPECT_NEAR(s.position.z() - half.dot(Vec3(R.row(2).transpose().cwiseAbs())), 1.4, 1e-8);
}

/// The only row of a constraint in a motion of the scene, with what its derivative is worth.
struct ReadRow {
  RowValues rows;
  Eigen::MatrixXd jacobian;
  Reliability reliability;
};
ReadRow readRow(const Scene& scene, const Constraint& constraint) {
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1, {velocity("box"), orientation("box")}, {constraint});
  const Motion motion = simulateAt(problem, problem.controls.startValues(), 1);
  std::vector<Reliability> reliability;
  ReadRow out{problem.constraints.evaluate(motion), {}, {}};
  if (!out.rows.available) return out;
  out.jacobian = jacobianByAdjoint(problem, problem.controls.startValues(), motion, out.rows, &reliability);
  out.reliability = reliability[0];
  return out;
}

/// A box in the air that neither moves nor falls.
Scene restingBox() {
  Scene scene = thrownBox();
  scene.gravity.setZero();
  scene.bodies[1].velocity.setZero(), scene.bodies[1].angular_velocity.setZero();
  scene.bodies[1].orientation = Quat::Identity();
  return scene;
}

TEST(QuantityEdits, OfSeveralLowestPointsOneIsTakenAndSaidSo) {
  const ReadRow flat = readRow(restingBox(), {"box", 0.5, {{"height", {2}}}});
  ASSERT_TRUE(flat.rows.available);
  EXPECT_NEAR(flat.rows.values[0], 0.95, 1e-15);
  EXPECT_FALSE(flat.reliability.reliable);
  EXPECT_NE(flat.reliability.message.find("several points of 'box' are equally low at t = 0.5 s"), std::string::npos)
      << flat.reliability.message;
  EXPECT_TRUE(flat.jacobian.allFinite());
  EXPECT_EQ(flat.jacobian(0, 2), 0.5);  // by the velocity upwards

  Scene standing = restingBox();
  standing.bodies[1].shape = Cylinder{0.1, 0.3};
  const ReadRow round = readRow(standing, {"box", 0.5, {{"height", {2}}}});
  EXPECT_FALSE(round.reliability.reliable);
  EXPECT_TRUE(round.jacobian.allFinite());
  EXPECT_FALSE(round.rows.notes[0].second_order);

  Scene tilted = restingBox();
  tilted.bodies[1].orientation = Quat(0.9, 0.2, -0.1, 0.3).normalized();
  EXPECT_TRUE(readRow(tilted, {"box", 0.5, {{"height", {2}}}}).reliability.reliable);
}

TEST(QuantityEdits, UpHasNoDerivativeWithoutGravity) {
  const Scene scene = restingBox();
  OdeContacts contacts(scene);
  const std::vector<Constraint> height{{"box", 0.5, {{"height", {2}}}}};
  EXPECT_NO_THROW(EditProblem(scene, contacts, 1, {velocity("box")}, height));
  try {
    EditProblem(scene, contacts, 1, {gravity()}, height);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "/constraints/0/height");
    EXPECT_EQ(error.message(), "found a varying gravity of 0, expected another one: it defines the direction up");
  }
}

TEST(QuantityEdits, AtRestThereIsNoDerivativeOfTheSpeed) {
  const ReadRow wanted = readRow(restingBox(), {"box", 0.5, {{"speed", {2}}}});
  EXPECT_FALSE(wanted.rows.available);
  EXPECT_EQ(wanted.rows.message, "The speed of 'box' is 0 at t = 0.5 s, where it has no derivative.");
  // nothing has to change where it is within its range
  Target most{"speed", {any}};
  most.max = {2};
  const ReadRow within = readRow(restingBox(), {"box", 0.5, {most}});
  ASSERT_TRUE(within.rows.available);
  EXPECT_EQ(within.rows.values[0], 0);
  EXPECT_FALSE(within.reliability.reliable);
  EXPECT_EQ(within.reliability.message, "the speed of 'box' is 0 at t = 0.5 s, where it has no derivative");
  EXPECT_TRUE(within.jacobian.allFinite());

  const Scene scene = restingBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"));
  edit.nail("box", 0.5).speed(2);
  const EditResult result = edit.solve();
  if (!result.solved()) {
    EXPECT_EQ(result.status, EditStatus::bad_start);
    EXPECT_NE(result.message.find("has no derivative"), std::string::npos) << result.message;
  }
}

}  // namespace
}  // namespace carom
