// SPDX-License-Identifier: MIT
// Edits in segments, against the same edits taken whole.

#include "editing/shooting/multiple_shooting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/shooting/cut.h"
#include "editing/shooting/shooting_program.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;

struct Task {
  Scene scene;
  double duration = 1;
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
};

EditResult solve(const Task& task, Shooting shooting) {
  OdeContacts contacts(task.scene);
  const Edit edit(task.scene, contacts, task.duration, task.controls, task.constraints);
  EditOptions options;
  options.sequence = SequencePolicy::stay;
  options.shooting = shooting;
  return edit.solve(options);
}

/// The motion when all controls are changed a little, in the impact sequence of the start: in one direction that is the
/// same every time, less and less far.
Motion hiddenThrow(const Task& task, double size) {
  OdeContacts contacts(task.scene);
  const ControlSet controls(task.scene, task.controls);
  Eigen::VectorXd direction(controls.size());
  for (Eigen::Index i = 0; i < direction.size(); ++i) direction[i] = std::sin(1.0 + 2.3 * static_cast<double>(i));
  const std::string before = simulate(task.scene, contacts, task.duration).signature();
  for (int k = 0; k < 20; ++k, size *= k % 2 == 0 ? -0.5 : -1) {
    const Eigen::VectorXd values = controls.valuesOf(size * direction);
    Motion motion = simulate(controls.sceneAt(values), contacts, task.duration);
    if (motion.signature() == before) return motion;
  }
  ADD_FAILURE() << "no throw in the sequence " << before;
  return simulate(task.scene, contacts, task.duration);
}

Target positionOf(const BodyState& state) {
  return {"position", {state.position.x(), state.position.y(), state.position.z()}};
}
Target orientationOf(const BodyState& state) {
  const Quat& q = state.orientation;
  return {"orientation", {q.w(), q.x(), q.y(), q.z()}};
}

/// Solves in both ways, within the sequence of the start.
void expectSame(const Task& task) {
  const EditResult whole = solve(task, Shooting::single), cut = solve(task, Shooting::multiple);
  ASSERT_TRUE(whole.solved()) << whole.message;
  ASSERT_TRUE(cut.solved()) << cut.message;
  EXPECT_EQ(whole.segments, 0);
  EXPECT_GE(cut.segments, 2);
  EXPECT_TRUE(cut.growth > 0);
  EXPECT_NE(cut.message.find("segments"), std::string::npos) << cut.message;
  EXPECT_TRUE(std::abs(cut.objective - whole.objective) <= 1e-7 * (1 + whole.objective))
      << cut.objective << " " << whole.objective;
  ASSERT_EQ(cut.changed.size(), whole.changed.size());
  for (std::size_t i = 0; i < cut.changed.size(); ++i) {
    const double a = cut.changed[i].after, b = whole.changed[i].after;
    EXPECT_TRUE(std::abs(a - b) <= 1e-7 * (1 + std::abs(b))) << cut.changed[i].name << " " << a << " " << b;
  }
}

Task boxTask() {
  return {thrownBox(), 0.9, {velocity("box"), angularVelocity("box"), elasticity("felt"), friction("felt")}, {}};
}

TEST(MultipleShooting, HitsATargetOffFloorAndWall) {
  expectSame({floorAndWall(),
              0.6,
              {velocity("ball").only({"x", "z"})},
              {{"ball", When(0.6), {{"position", {-2, any, 1.5}}}}}});
}

TEST(MultipleShooting, ThrowsABoxToAPoseWithFriction) {
  Task task = boxTask();
  const BodyState state = hiddenThrow(task, 0.002).stateAt("box", 0.9);
  task.constraints = {{"box", When(0.9), {positionOf(state), orientationOf(state)}}};
  expectSame(task);
}

TEST(MultipleShooting, HoldsAnImpactAndItsTime) {
  Task task = boxTask();
  const Motion hidden = hiddenThrow(task, 0.002);
  const std::optional<int> third = hidden.findImpact(1, 3);
  ASSERT_TRUE(third);
  const BodyState state = hidden.stateBefore(*third, 1);
  const double time = hidden.events[static_cast<std::size_t>(*third)].time;
  task.constraints = {{"box", nthImpact(3, "floor"), {positionOf(state), {"time", {time}}}}};
  expectSame(task);
}

TEST(MultipleShooting, TurnsTheNormalOfALaterImpact) {
  Task task = boxTask();
  task.controls.push_back(tilt("box", 2));
  task.controls.push_back(mass("box"));
  const BodyState state = hiddenThrow(task, 0.0005).stateAt("box", 0.9);
  task.constraints = {{"box", When(0.9), {positionOf(state), orientationOf(state)}}};
  expectSame(task);
}

TEST(MultipleShooting, KeepsToARegionAcrossSegments) {
  Task task{floorAndWall(), 0.6, {velocity("ball"), position("ball")}, {}};
  // A lane along x, in which the ball does not start.
  Region lane;
  lane.side = Region::Side::inside;
  lane.shape = Box{{20, 0.6, 20}};
  lane.position = Vec3(0, 0.35, 0);
  lane.margin = 0;
  Constraint constraint{"ball", When(0.6), {{"position", {-2, 0.1, 1.5}}}};
  constraint.regions = {lane};
  task.constraints = {constraint};
  expectSame(task);
}

TEST(MultipleShooting, MeetsAtSomeTimeOfASpan) {
  Task task{floorAndWall(), 0.7, {velocity("ball")}, {}};
  task.constraints = {{"ball", between(0.5, 0.7), {{"position", {-1.5, 0.05, 1.5}}}}};
  expectSame(task);
}

TEST(MultipleShooting, TwoBodiesThatMeet) {
  Task task;
  task.scene = floorAndWall();
  task.scene.gravity.setZero();
  task.scene.bodies[2].velocity = {5, 0, 0};
  task.scene.bodies.push_back(ball("other", "rubber", 0.15, {0.5, 0.05, 1}, Vec3::Zero()));
  task.duration = 0.5;
  task.controls = {velocity("ball"), velocity("other").only({"x"})};
  const Motion hidden = hiddenThrow(task, 0.002);
  task.constraints = {{"other", When(0.5), {positionOf(hidden.stateAt("other", 0.5))}}};
  expectSame(task);
}

/// A ball among three round posts that it cannot leave: small changes grow with every impact.
Task posts(double duration, double size) {
  Task task;
  task.scene.gravity.setZero();
  task.scene.materials = {material("steel", 1, 0)};
  for (int k = 0; k < 3; ++k) {
    Body post = ball("post" + std::to_string(k), "steel", 2.5, Vec3::Zero(), Vec3::Zero());
    post.fixed = true, post.mass.reset();
    const double angle = 2.0943951023931953 * k + 0.3;
    post.position = 3 * Vec3(std::cos(angle), std::sin(angle), 0);
    task.scene.bodies.push_back(post);
  }
  task.scene.bodies.push_back(ball("ball", "steel", 0.1, {0.05, 0.02, 0}, {1.0, 0.37, 0}));
  task.duration = duration;
  task.controls = {velocity("ball").only({"x", "y"})};
  const BodyState state = hiddenThrow(task, size).stateAt("ball", duration);
  task.constraints = {{"ball", When(duration), {{"position", {state.position.x(), state.position.y(), any}}}}};
  return task;
}

TEST(MultipleShooting, FollowsABoxOverManyImpacts) {
  Task task;
  task.scene = thrownBox();
  task.scene.bodies[1].velocity = {1.5, 0.2, 2};
  for (Material& m : task.scene.materials) m.elasticity = 0.9;
  task.duration = 1.5;
  task.controls = {velocity("box"), angularVelocity("box")};
  const BodyState state = hiddenThrow(task, 4e-3).stateAt("box", 1.5);
  task.constraints = {{"box", When(1.5), {positionOf(state)}}};
  const EditResult result = solve(task, Shooting::multiple);
  EXPECT_TRUE(result.solved()) << result.message;
  EXPECT_TRUE(result.growth > 50) << result.growth;
  EXPECT_GE(result.segments, 2);
  EXPECT_NE(result.message.find("segments"), std::string::npos) << result.message;
  EXPECT_TRUE(result.objective < 1e-3) << result.objective;
}

TEST(MultipleShooting, IsChosenByTheGrowth) {
  const EditResult brief = solve(posts(2, 1e-4), Shooting::automatic);
  EXPECT_TRUE(brief.solved()) << brief.message;
  EXPECT_EQ(brief.segments, 0);
  EXPECT_TRUE(brief.growth > 1 && brief.growth < 100) << brief.growth;

  const EditResult lasting = solve(posts(7, 1e-5), Shooting::automatic);
  EXPECT_TRUE(lasting.solved()) << lasting.message;
  EXPECT_GE(lasting.sequence_after.size(), 12u);
  EXPECT_GE(lasting.segments, 3);
  EXPECT_TRUE(lasting.growth > 1000) << lasting.growth;
  EXPECT_NE(lasting.message.find("-fold"), std::string::npos) << lasting.message;

  const EditResult whole = solve(posts(7, 1e-5), Shooting::single);
  EXPECT_EQ(whole.segments, 0);
  EXPECT_EQ(whole.growth, 0);
}

TEST(MultipleShooting, SaysWhereThereIsNothingToCut) {
  Task task{floorAndWall(), 0.1, {velocity("ball")}, {{"ball", When(0.1), {{"position", {0.1, 0, 0.6}}}}}};
  const EditResult result = solve(task, Shooting::multiple);
  EXPECT_TRUE(result.solved()) << result.message;
  EXPECT_EQ(result.segments, 0);
  EXPECT_NE(result.message.find("no flight between two impacts"), std::string::npos) << result.message;
}

TEST(MultipleShooting, SparseDerivativesAgreeWithDifferences) {
  Task task = boxTask();
  task.controls.push_back(tilt("box", 2));
  task.controls.push_back(gravity());
  task.constraints = {{"box", nthImpact(3, "floor"), {{"position", {0.5, 0.1, any}}, {"time", {0.8}}}},
                      {"box", between(0.2, 0.8), {{"point", {0.5, any, 0.2}, Vec3(0.1, 0, 0)}}}};
  OdeContacts contacts(task.scene);
  const EditProblem problem(task.scene, contacts, task.duration, task.controls, task.constraints);
  const EditOptions options;
  EditSearch search(problem, options);
  const EditPointPtr start = search.evaluateStart();
  ASSERT_TRUE(start->rows.available) << start->rows.message;
  const Segments segments = makeSegments(problem, *start, cutMotion(problem, start->motion, start->rows.times, 1));
  ASSERT_GE(segments.segments.size(), 2u) << segments.why_not;
  ShootingProgram program(search, *start, segments, problem.constraints.equations());

  Eigen::VectorXd x = program.start(), g;
  ASSERT_TRUE(program.constraintValues(x, g));
  // The motion that was cut fits together.
  const Eigen::Index held = problem.constraints.size();
  for (Eigen::Index i = held; i < g.size() - problem.validity.size(); ++i) EXPECT_TRUE(std::abs(g[i]) <= 1e-11) << i;
  // Rows come in the order of the segments.
  Eigen::VectorXd of_program = g.head(held), of_edit = start->rows.scaled;
  std::sort(of_program.begin(), of_program.end());
  std::sort(of_edit.begin(), of_edit.end());
  for (Eigen::Index i = 0; i < held; ++i)
    EXPECT_TRUE(std::abs(of_program[i] - of_edit[i]) <= 1e-9 * (1 + std::abs(of_edit[i]))) << i;

  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 1e-4 * std::sin(1.7 * static_cast<double>(i));
  Eigen::MatrixXd J, H;
  ASSERT_TRUE(program.jacobian(x, J));
  EXPECT_LT(program.jacobianPlaces().size(), static_cast<std::size_t>(J.size()));
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    Eigen::VectorXd ahead, behind;
    ASSERT_TRUE(program.constraintValues(x + h * Eigen::VectorXd::Unit(x.size(), j), ahead));
    ASSERT_TRUE(program.constraintValues(x - h * Eigen::VectorXd::Unit(x.size(), j), behind));
    const Eigen::VectorXd difference = (ahead - behind) / (2 * h);
    for (Eigen::Index i = 0; i < J.rows(); ++i)
      EXPECT_TRUE(std::abs(difference[i] - J(i, j)) <= 1e-5 * (1 + std::abs(J(i, j)))) << i << " " << j;
  }
  Eigen::VectorXd multipliers(J.rows());
  for (Eigen::Index i = 0; i < J.rows(); ++i) multipliers[i] = std::cos(static_cast<double>(i));
  ASSERT_TRUE(program.hessian(x, 1, multipliers, H));
  EXPECT_EQ(H, Eigen::MatrixXd(H.transpose()));
  EXPECT_LT(program.hessianPlaces().size(), static_cast<std::size_t>(H.size()));
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), j);
    Eigen::MatrixXd ahead, behind;
    ASSERT_TRUE(program.jacobian(x + step, ahead));
    ASSERT_TRUE(program.jacobian(x - step, behind));
    Eigen::VectorXd difference = (ahead - behind).transpose() * multipliers / (2 * h);
    if (j < problem.controls.size()) difference[j] += 1;  // the objective's
    for (Eigen::Index i = 0; i < x.size(); ++i)
      EXPECT_TRUE(std::abs(difference[i] - H(i, j)) <= 1e-5 * H.cwiseAbs().maxCoeff()) << i << " " << j;
  }
}

}  // namespace
}  // namespace carom
