// SPDX-License-Identifier: MIT
// Second derivatives of an edit's rows against differences of their exact first derivatives, for every control, every
// quantity, rows relative to another body, free times and regions. The first derivatives' own test in 50 digits stands
// in tests/reference; here it is that nothing is left out on the way to the unknowns.

#include "editing/problem/hessian.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "editing/problem/rows/closest_approach.hpp"
#include "editing/solve/edit_evaluator.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

// Of differences whose step is 1e-4 at first and half of that then, extrapolated: 1e-16 / h, and h^4.
constexpr double kTolerance = 3e-8;

/// d(weights . values)/d(unknowns), exact.
Eigen::VectorXd gradient(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Eigen::VectorXd& weights) {
  const EditPointPtr point = pointAt(problem, unknowns, problem.horizon, false);
  EXPECT_TRUE(point && point->rows.available) << (point ? point->rows.message : "no motion");
  differentiate(problem, *point);
  Eigen::VectorXd scaled = weights;
  for (Eigen::Index i = 0; i < weights.size(); ++i) scaled[i] *= problem.constraints.rows()[i].scale;
  return point->row_jacobian->transpose() * scaled;
}

void expectDerivative(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Eigen::VectorXd& weights) {
  const EditPointPtr point = pointAt(problem, unknowns, problem.horizon, false);
  ASSERT_TRUE(point && point->rows.available) << (point ? point->rows.message : "no motion");
  const Eigen::MatrixXd H = rowsHessian(problem, unknowns, point->motion, point->rows, weights);
  ASSERT_EQ(H.rows(), problem.unknowns());
  EXPECT_EQ((H - H.transpose()).cwiseAbs().maxCoeff(), 0);
  const double whole = H.cwiseAbs().maxCoeff();
  for (int j = 0; j < problem.unknowns(); ++j) {
    const auto differences = [&](double h) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(unknowns.size(), j);
      return Eigen::VectorXd(
          (gradient(problem, unknowns + step, weights) - gradient(problem, unknowns - step, weights)) / (2 * h));
    };
    const Eigen::VectorXd expected = (4 * differences(5e-5) - differences(1e-4)) / 3;
    const double scale = std::max(expected.cwiseAbs().maxCoeff(), 1e-2 * whole);
    for (int i = 0; i < problem.unknowns(); ++i) {
      EXPECT_TRUE(std::abs(H(i, j) - expected[i]) <= kTolerance * scale)
          << "unknowns " << i << " and " << j << ": " << H(i, j) << ", expected " << expected[i] << ", scale " << scale
          << (i < problem.controls.size() && j < problem.controls.size()
                  ? " " + problem.controls.describeVariable(i) + " and " + problem.controls.describeVariable(j)
                  : "");
    }
  }
}

Eigen::VectorXd someWeights(int size) {
  Eigen::VectorXd weights(size);
  for (int i = 0; i < size; ++i) weights[i] = (i % 2 ? -1 : 1) * (0.4 + 0.1 * i);
  return weights;
}

Eigen::VectorXd someUnknowns(const EditProblem& problem, double away) {
  Eigen::VectorXd y(problem.unknowns());
  y.head(problem.controls.size()) = Eigen::VectorXd::LinSpaced(problem.controls.size(), -away, 1.3 * away);
  for (int k = 0; k < problem.times(); ++k) {
    const FreeTime& free = problem.constraints.freeTimes()[k];
    y[problem.controls.size() + k] = 0.55 * (free.to - free.from) / free.scale;
  }
  return y;
}

TEST(Hessian, OfEveryQuantityByEveryControl) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 0.6, everyControl(), everyQuantity());
  // away from the start, where an orientation's value is not its derivative's base
  const Eigen::VectorXd at = someUnknowns(problem, 0.01), weights = someWeights(problem.constraints.size());
  expectDerivative(problem, at, weights);
}

TEST(Hessian, OfEveryRowAlone) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 0.6, {velocity("box"), orientation("box"), mass("box")}, everyQuantity());
  const Eigen::VectorXd at = someUnknowns(problem, 0.01);
  for (int i = 0; i < problem.constraints.size(); ++i) {
    SCOPED_TRACE(problem.constraints.describeRow(i));
    expectDerivative(problem, at, Eigen::VectorXd::Unit(problem.constraints.size(), i));
  }
}

Scene withBall() {
  Scene scene = thrownBox();
  Body other = scene.bodies[1];
  other.name = "other";
  other.position += Vec3(0.3, 2.5, 0.4);
  other.angular_velocity = {1.3, -0.7, 0.4};
  scene.bodies.push_back(other);
  return scene;
}

TEST(Hessian, OfRowsRelativeToAnotherBody) {
  const Scene scene = withBall();
  OdeContacts contacts(scene);
  std::vector<Constraint> constraints = everyQuantity();
  for (Constraint& c : constraints) {
    c.relative_to = "other";
    std::erase_if(c.targets, [](const Target& t) { return !findQuantityKind(t.quantity)->from_another; });
  }
  const EditProblem problem(
      scene, contacts, 0.6,
      {velocity("box"), angularVelocity("box"), position("other"), angularVelocity("other"), orientation("other")},
      constraints);
  expectDerivative(problem, someUnknowns(problem, 0.01), someWeights(problem.constraints.size()));
}

TEST(Hessian, OfRowsAtAFreeTime) {
  const Scene scene = withBall();
  OdeContacts contacts(scene);
  const std::vector<Target> targets{
      {"position", {1, any, 2}}, {"orientation", {1, 0, 0, 0}}, {"angular_velocity", {1, any, any}}};
  const std::vector<Constraint> constraints{{"box", between(0.05, 0.3), targets},
                                            {"other", between(0.1, 0.5), targets, "box"}};
  const EditProblem problem(scene, contacts, 0.6, {velocity("box"), angularVelocity("box"), angularVelocity("other")},
                            constraints);
  ASSERT_EQ(problem.times(), 2);
  expectDerivative(problem, someUnknowns(problem, 0.01), someWeights(problem.constraints.size()));
}

// A ball that bounces to rest, the time of which goes with the square root of its height. (Of a block that slides to a stop
// second derivatives are not known.)
TEST(Hessian, OfRowsAtRest) {
  Scene scene;
  scene.materials = {material("wood", 0.3, 0.25)};
  scene.bodies = {fixedPlane("floor", "wood", Vec3::UnitZ(), 0), thrownBox().bodies[1]};
  Body& ball = scene.bodies[1];
  ball.material = "wood";
  ball.shape = Sphere{0.1};
  ball.center_of_mass.reset(), ball.inertia = {};
  ball.position = {0.1, 0, 0.3}, ball.orientation.setIdentity();
  ball.velocity = {0, 0, -1.2}, ball.angular_velocity.setZero();
  OdeContacts contacts(scene);
  const std::vector<Constraint> constraints{
      {"box", atRest(), {{"position", {1, 0.2, any}}, {"time", {1}}, {"point", {1, 1, any}, {0.1, 0.2, 0.05}}}}};
  const std::vector<Control> controls{velocity("box").only({"z"}), position("box"), elasticity("wood"), mass("box")};
  const EditProblem problem(scene, contacts, 3, controls, constraints);
  expectDerivative(problem, someUnknowns(problem, 0.01), someWeights(problem.constraints.size()));
}

// All the time, in or out of a shape that is turned.
Constraint inRegion(const std::string& body, std::pair<double, double> during, Region::Side side,
                    std::variant<Sphere, Box> shape, const Vec3& at) {
  Constraint c{body, 0.0, {}};
  const Quat turned(Eigen::AngleAxisd(0.4, Vec3(1, 2, 0.5).normalized()));
  c.regions = {{side, std::move(shape), at, turned, during, 0.0}};
  return c;
}

TEST(Hessian, OfRegions) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.6);
  const Vec3 middle = motion.stateAt("box", 0.2).position, side = motion.stateAt("box", 0.25).position;
  const auto keep = [](Region::Side what, std::variant<Sphere, Box> shape, const Vec3& at) {
    return inRegion("box", {0.02, 0.5}, what, std::move(shape), at);
  };
  const std::vector<Constraint> constraints{
      keep(Region::Side::avoid, Sphere{0.1}, middle + Vec3(0.1, 0.2, 0.15)),
      keep(Region::Side::inside, Sphere{3}, side + Vec3(0.1, 0.2, 0.3)),
      keep(Region::Side::avoid, Box{{0.1, 0.2, 0.3}}, side + Vec3(0.02, 0.2, 0.1)),
      keep(Region::Side::avoid, Box{{0.3, 0.1, 0.2}}, middle + Vec3(0, 0.01, 0.3)),
      keep(Region::Side::inside, Box{{3, 4, 5}}, side)};
  const EditProblem problem(scene, contacts, 0.6, {velocity("box"), position("box"), elasticity("felt")}, constraints);
  const Eigen::VectorXd at = someUnknowns(problem, 0.003);
  const EditPointPtr point = pointAt(problem, at, problem.horizon, false);
  int least = 0, two_faces = 0, place = 0;
  for (int i = 0; i < problem.constraints.size(); ++i) {
    const Clearance::Keeps keeps = problem.constraints.clearance(point->motion, i)->keeps;
    least += keeps == Clearance::Keeps::least;
    two_faces += keeps == Clearance::Keeps::two_faces;
    place += keeps == Clearance::Keeps::place;
  }
  EXPECT_GE(least, 1);
  EXPECT_GE(two_faces, 1);
  EXPECT_GE(place, 1);
  for (int i = 0; i < problem.constraints.size(); ++i) {
    SCOPED_TRACE(problem.constraints.describeRow(i));
    expectDerivative(problem, at, Eigen::VectorXd::Unit(problem.constraints.size(), i));
  }
}

Body turning(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity,
             const Vec3& spin) {
  Body body;
  body.name = name, body.shape = shape, body.mass = 1, body.position = position, body.velocity = velocity;
  body.angular_velocity = spin;
  body.orientation = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  return body;
}

/// Two that pass each other, turning: nearest at features of many kinds.
std::vector<Scene> passing() {
  const Shape shapes[] = {Sphere{0.1}, Box{{0.3, 0.2, 0.1}}, Capsule{0.05, 0.4}, Cylinder{0.12, 0.3}, Cone{0.15, 0.3}};
  std::vector<Scene> scenes;
  for (const Shape& a : shapes)
    for (const Shape& b : shapes) {
      Scene scene;
      scene.bodies = {turning("a", a, {-1, 0.1, 0.2}, {3, 0.3, 0.5}, {1.5, 2, -1}),
                      turning("b", b, {0.1, 0.35, 0.4}, {-0.2, 0.5, 0.7}, {-1, 1, 2})};
      scenes.push_back(std::move(scene));
    }
  return scenes;
}

TEST(Hessian, OfDistancesAndClosestApproaches) {
  int least = 0, event = 0;
  for (const Scene& scene : passing()) {
    OdeContacts contacts(scene);
    const std::vector<Constraint> constraints{
        {"a", 0.25, {{.quantity = "distance", .value = {0.1}, .to = "b"}}},
        {"b", between(0.1, 0.4), {{.quantity = "distance", .value = {0.1}, .to = "a"}}},
        {"a", 0.0, {{.quantity = "closest_approach", .value = {0.1}, .to = "b", .during = {{0.05, 0.6}}}}}};
    const EditProblem problem(scene, contacts, 0.6,
                              {velocity("a"), angularVelocity("b"), orientation("a"), size("a"), size("b")},
                              constraints);
    const Eigen::VectorXd at = someUnknowns(problem, 0.003);
    const EditPointPtr point = pointAt(problem, at, problem.horizon, false);
    ASSERT_TRUE(point && point->rows.available);
    SCOPED_TRACE("shapes " + std::to_string(scene.bodies[0].shape.index()) + " and " +
                 std::to_string(scene.bodies[1].shape.index()));
    const auto closest = closestApproach(point->motion, 0, 1, 0.05, 0.6);
    if (!closest->nearest.apart()) {
      EXPECT_EQ(point->rows.values[2], 0);
      ++event;
      continue;
    }
    least += closest->keeps == Clearance::Keeps::least;
    for (int i = 0; i < problem.constraints.size(); ++i) {
      SCOPED_TRACE(problem.constraints.describeRow(i));
      expectDerivative(problem, at, Eigen::VectorXd::Unit(problem.constraints.size(), i));
    }
  }
  EXPECT_GE(least, 15);
  EXPECT_LE(event, 5);
}

// A ball lands with spin on a slope and slides round a bend, where its acceleration is another one at every time.
TEST(Hessian, OfRegionsOnASlideRoundABend) {
  Scene scene;
  scene.gravity = {0, 1.2, -9.7};
  scene.materials.push_back({.name = "wood", .elasticity = 0, .friction = 0.2});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{}, floor.material = "wood";
  ball.name = "ball", ball.material = "wood", ball.mass = 2, ball.shape = Sphere{0.1}, ball.position = {0, 0, 0.11};
  ball.velocity = {3, -1.4, 0}, ball.angular_velocity = {-20, -12, 3};
  scene.bodies = {floor, ball};
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.6);
  ASSERT_GT(motion.world_lines[1].arcs[1].accelerationVariation(), 0.1);
  const Vec3 middle = motion.stateAt("ball", 0.4).position;
  const auto keep = [](Region::Side what, std::variant<Sphere, Box> shape, const Vec3& at) {
    return inRegion("ball", {0.1, 0.6}, what, std::move(shape), at);
  };
  const std::vector<Constraint> constraints{
      keep(Region::Side::avoid, Sphere{0.1}, middle + Vec3(0.1, 0.2, 0.15)),
      keep(Region::Side::inside, Sphere{3}, middle + Vec3(-0.1, 0.3, 0.3)),
      keep(Region::Side::avoid, Box{{0.1, 0.2, 0.3}}, middle + Vec3(0.05, 0.15, 0)),
      keep(Region::Side::inside, Box{{3, 4, 5}}, middle)};
  const EditProblem problem(scene, contacts, 0.6, {velocity("ball"), angularVelocity("ball"), friction("wood")},
                            constraints);
  expectDerivative(problem, someUnknowns(problem, 0.001), someWeights(problem.constraints.size()));
}

TEST(Hessian, OfValidity) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 0.6, {tilt("box", 1), inertia("box"), velocity("box")}, everyQuantity());
  const Eigen::VectorXd at = someUnknowns(problem, 0.02), weights = someWeights(problem.validity.size());
  ASSERT_EQ(weights.size(), 4);
  const Eigen::MatrixXd H = validityHessian(problem, at, weights);
  const auto gradientAt = [&](const Eigen::VectorXd& y) {
    return Eigen::VectorXd(problem.rates(y).cwiseProduct(
        problem.validity.jacobian(problem.controls, problem.valuesOf(y)).transpose() * weights));
  };
  for (int j = 0; j < problem.unknowns(); ++j) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(at.size(), j);
    const Eigen::VectorXd expected = (gradientAt(at + step) - gradientAt(at - step)) / 2e-5;
    EXPECT_TRUE((H.col(j) - expected).cwiseAbs().maxCoeff() <= 1e-8) << j;
  }
}

}  // namespace
}  // namespace carom
