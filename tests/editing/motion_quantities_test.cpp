// SPDX-License-Identifier: MIT
// Speed, kinetic energy, impulse and height: closed forms of the rows and of all their derivatives, every shape, the same
// scene with its bodies in reverse order, and what is said where a derivative is not defined.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "editing/edit.h"
#include "editing/problem/hessian.hpp"
#include "editing/problem/jacobian.hpp"
#include "editing/solve/edit_evaluator.hpp"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

constexpr double kClosed = 1e-13;

/// A ball with spin above a floor without friction.
Scene spinningBall() {
  Scene scene;
  scene.gravity = {0.3, -0.2, -9.8};
  scene.materials = {material("rubber", 0.8, 0)};
  scene.bodies = {fixedPlane("floor", "rubber", {0, 0, 1}, 0), ball("ball", "rubber", 0.1, {0.4, 0.3, 1}, {1, 0.5, -2})};
  scene.bodies[1].mass = 2;
  scene.bodies[1].angular_velocity = {3, 1, 2};
  return scene;
}

struct ClosedForm {
  double value = 0, by_mass = 0, by_radius = 0, by_elasticity = 0;
  Vec3 by_velocity = Vec3::Zero(), by_spin = Vec3::Zero(), by_gravity = Vec3::Zero();
};

/// At 0.2 s the speed, the energy and the height, and the impulse of the first impact, in this order.
std::vector<ClosedForm> closedForms() {
  const Scene scene = spinningBall();
  const Body& body = scene.bodies[1];
  const double T = 0.2, m = 2, r = 0.1, e = 0.8, I = 0.4 * m * r * r;
  const Vec3 g = scene.gravity, v = body.velocity + T * g, w = body.angular_velocity;
  const Vec3 x = body.position + T * body.velocity + 0.5 * T * T * g, up = -g / g.norm();
  ClosedForm speed, energy, height, impulse;
  speed.value = v.norm();
  speed.by_velocity = v / v.norm();
  speed.by_gravity = T * speed.by_velocity;
  energy.value = 0.5 * (m * v.squaredNorm() + I * w.squaredNorm());
  energy.by_mass = energy.value / m;
  energy.by_radius = 0.4 * m * r * w.squaredNorm();
  energy.by_velocity = m * v;
  energy.by_gravity = T * m * v;
  energy.by_spin = I * w;
  height.value = up.dot(x) - r;
  height.by_radius = -1;
  height.by_velocity = T * up;
  height.by_gravity = 0.5 * T * T * up - (x - up.dot(x) * up) / g.norm();
  const double fall = body.position.z() - r, v_z = body.velocity.z();
  const double u = std::sqrt(v_z * v_z - 2 * g.z() * fall);  // the speed of approach
  impulse.value = m * (1 + e) * u;
  impulse.by_mass = (1 + e) * u;
  impulse.by_elasticity = m * u;
  impulse.by_radius = m * (1 + e) * g.z() / u;
  impulse.by_velocity = {0, 0, m * (1 + e) * v_z / u};
  impulse.by_gravity = {0, 0, -m * (1 + e) * fall / u};
  return {speed, energy, height, impulse};
}

TEST(MotionQuantities, AreClosedFormsOfABall) {
  const Scene scene = spinningBall();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1,
                            {mass("ball"), size("ball"), elasticity("rubber"), velocity("ball"), angularVelocity("ball"),
                             gravity()},
                            {{"ball", 0.2, {{"speed", {1}}, {"kinetic_energy", {1}}, {"height", {1}}}},
                             {"ball", nthImpact(1), {{"impulse", {1}}}}});
  const RowsAndJacobian found = evaluateByAdjoint(problem, problem.controls.startValues());
  ASSERT_TRUE(found.rows.available) << found.rows.message;
  const std::vector<ClosedForm> expected = closedForms();
  for (int i = 0; i < 4; ++i) {
    const ClosedForm& c = expected[static_cast<std::size_t>(i)];
    Eigen::VectorXd row(12);
    row << c.by_mass, c.by_radius, c.by_elasticity, c.by_velocity, c.by_spin, c.by_gravity;
    SCOPED_TRACE(problem.constraints.describeRow(i));
    EXPECT_TRUE(std::abs(found.rows.values[i] - c.value) <= kClosed * std::abs(c.value)) << found.rows.values[i];
    test::expectEntries(Eigen::VectorXd(found.jacobian.row(i)), row, kClosed, "derivative", row.cwiseAbs().maxCoeff());
    EXPECT_TRUE(found.reliability[static_cast<std::size_t>(i)].reliable);
  }
}

Body solid(const std::string& name, Shape shape, const Vec3& position) {
  Body body;
  body.name = name, body.material = "felt", body.density = 500;
  body.shape = std::move(shape);
  body.position = position;
  body.orientation = Quat(0.8, 0.3, -0.2, 0.4).normalized();
  body.velocity = {0.5, 0.2, 1};
  body.angular_velocity = {1, -2, 0.5};
  return body;
}

/// A body of every shape, in the air.
Scene everyShape() {
  Scene scene;
  scene.gravity = {0.4, 0.3, -9.7};
  scene.materials = {material("felt", 0.5, 0.4)};
  const Hull hull{convexHull({{0.2, 0, 0}, {0, 0.15, 0}, {0, 0, 0.1}, {-0.1, -0.1, -0.1}, {0.05, -0.2, 0.1}}), 1.1, ""};
  const Quat turned = Quat(0.9, 0.1, 0.3, -0.2).normalized();
  scene.bodies = {solid("sphere", Sphere{0.1}, {0, 0, 3}),
                  solid("box", Box{{0.3, 0.2, 0.1}}, {1, 0, 3}),
                  solid("capsule", Capsule{0.1, 0.3}, {2, 0, 3}),
                  solid("cylinder", Cylinder{0.1, 0.3}, {3, 0, 3}),
                  solid("cone", Cone{0.1, 0.3}, {4, 0, 3}),
                  solid("hull", hull, {5, 0, 3}),
                  solid("compound",
                        Compound{{{Cylinder{0.05, 0.4}, {0.1, 0, 0.1}, turned}, {Box{{0.1, 0.2, 0.15}}, {-0.1, 0.1, 0}}}},
                        {6, 0, 3})};
  return scene;
}

/// The lowest of many points of the surface, as seen from below; for corners the corners themselves.
double lowestOf(const Shape& shape, const Vec3& x, const Quat& q, const Vec3& up) {
  double lowest = std::numeric_limits<double>::infinity();
  const auto see = [&](const Vec3& p) { lowest = std::min(lowest, up.dot(x + q * p)); };
  const auto ring = [&](double radius, double z) {
    for (int i = 0; i < 20000; ++i) {
      const double a = 2 * M_PI * i / 20000;
      see({radius * std::cos(a), radius * std::sin(a), z});
    }
  };
  if (const auto* s = std::get_if<Sphere>(&shape)) lowest = up.dot(x) - s->radius;
  if (const auto* s = std::get_if<Box>(&shape))
    for (int k = 0; k < 8; ++k)
      see(0.5 * Vec3(k & 1 ? s->size[0] : -s->size[0], k & 2 ? s->size[1] : -s->size[1], k & 4 ? s->size[2] : -s->size[2]));
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    for (double end : {-0.5, 0.5}) see({0, 0, end * s->height});
    lowest -= s->radius;
  }
  if (const auto* s = std::get_if<Cylinder>(&shape)) ring(s->radius, -s->height / 2), ring(s->radius, s->height / 2);
  if (const auto* s = std::get_if<Cone>(&shape)) ring(s->radius, -s->height / 2), see({0, 0, s->height / 2});
  if (const auto* s = std::get_if<Hull>(&shape))
    for (const Vec3& v : s->surface->vertices) see(s->scale * v);
  if (const auto* s = std::get_if<Compound>(&shape))
    for (const CompoundPart& part : s->parts)
      lowest = std::min(lowest, lowestOf(part.shape, x + q * part.position, q * part.orientation, up));
  return lowest;
}

TEST(MotionQuantities, HeightIsThatOfTheLowestPoint) {
  const Scene scene = everyShape();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.3);
  for (const Body& body : scene.bodies) {
    for (double t : {0.0, 0.1, 0.3}) {
      const ConstraintSet set(scene, {{body.name, t, {{"height", {1}}}}});
      const BodyState s = motion.stateAt(body.name, t);
      const double lowest = lowestOf(body.shape, s.position, s.orientation, -scene.gravity.normalized());
      EXPECT_NEAR(set.evaluate(motion).values[0], lowest, 1e-8) << body.name << " at " << t;  // of a ring of 20000 points
    }
  }
}

std::vector<Constraint> quantitiesOf(const std::string& body, double t) {
  return {{body, t, {{"height", {1}}, {"speed", {1}}, {"kinetic_energy", {1}}}}};
}

std::vector<Control> controlsOf(const std::string& body) {
  return {position(body), orientation(body), velocity(body), angularVelocity(body), mass(body), size(body), gravity()};
}

// The two passes are each other's transpose, on every shape, in every direction of the scene at once.
TEST(MotionQuantities, TangentAndAdjointAreTransposed) {
  const Scene scene = everyShape();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.3);
  const std::string before = motion.signature();
  for (const Body& body : scene.bodies) {
    const ConstraintSet set(scene, quantitiesOf(body.name, 0.2));
    const RowValues rows = set.evaluate(motion);
    test::Random random(7);
    for (int i = 0; i < set.size(); ++i) {
      DerivativeTape tape(motion);
      const std::vector<StateSeed>& seeds = rows.seeds[static_cast<std::size_t>(i)];
      const SceneGradient gradient = adjoint(tape, seeds);
      for (int k = 0; k < 5; ++k) {
        const SceneTangent direction = test::randomDirection(scene, random);
        double forward = 0;
        for (const StateSeed& seed : seeds) forward += tangent(tape, direction).at(seed.body, seed.at).dot(seed);
        const double size = test::flatten(gradient).cwiseAbs().dot(test::flatten(direction).cwiseAbs());
        EXPECT_TRUE(std::abs(forward - gradient.dot(direction)) <= 1e-13 * size) << set.describeRow(i);
      }
    }
    const RowValues again = set.evaluate(motion);
    for (int i = 0; i < set.size(); ++i) EXPECT_EQ(again.values[i], rows.values[i]);
  }
  EXPECT_EQ(motion.signature(), before);
}

/// d(row)/d(unknowns), exact.
Eigen::VectorXd gradientOf(const EditProblem& problem, const Eigen::VectorXd& unknowns, int row) {
  const EditPointPtr point = pointAt(problem, unknowns, problem.horizon, false);
  differentiate(problem, *point);
  return point->row_jacobian->row(row).transpose() * problem.constraints.rows()[static_cast<std::size_t>(row)].scale;
}

/// First derivatives against differences of the values, second ones against differences of the first.
void expectDerivatives(const EditProblem& problem) {
  const Eigen::Index n = problem.unknowns();
  Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(n, -0.01, 0.013);
  for (int k = 0; k < problem.times(); ++k) {
    const FreeTime& free = problem.constraints.freeTimes()[static_cast<std::size_t>(k)];
    at[problem.controls.size() + k] = 0.4 * (free.to - free.from) / free.scale;
  }
  const EditPointPtr point = pointAt(problem, at, problem.horizon, false);
  ASSERT_TRUE(point->rows.available) << point->rows.message;
  for (int i = 0; i < problem.constraints.size(); ++i) {
    SCOPED_TRACE(problem.constraints.describeRow(i));
    const Eigen::VectorXd gradient = gradientOf(problem, at, i);
    const Eigen::MatrixXd H = rowsHessian(problem, at, point->motion, point->rows,
                                          Eigen::VectorXd::Unit(problem.constraints.size(), i));
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto differences = [&](double h, auto read) {
        const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, j);
        return decltype(read(at))((read(at + step) - read(at - step)) / (2 * h));
      };
      const auto twice = [&](auto read) {
        return decltype(read(at))((4 * differences(5e-5, read) - differences(1e-4, read)) / 3);
      };
      const double value = twice([&](const Eigen::VectorXd& y) {
        return pointAt(problem, y, problem.horizon, false)->rows.values[i];
      });
      EXPECT_TRUE(std::abs(gradient[j] - value) <= 1e-9 * (1 + gradient.cwiseAbs().maxCoeff()))
          << j << ": " << gradient[j] << ", expected " << value;
      const Eigen::VectorXd expected =
          twice([&](const Eigen::VectorXd& y) { return gradientOf(problem, y, i); });
      for (Eigen::Index k = 0; k < n; ++k)
        EXPECT_TRUE(std::abs(H(k, j) - expected[k]) <= 3e-8 * (1e-2 + H.cwiseAbs().maxCoeff()))
            << k << ", " << j << ": " << H(k, j) << ", expected " << expected[k];
    }
  }
}

TEST(MotionQuantities, DerivativesOfEveryShape) {
  const Scene scene = everyShape();
  OdeContacts contacts(scene);
  for (const Body& body : scene.bodies) {
    expectDerivatives(EditProblem(scene, contacts, 0.2, controlsOf(body.name), quantitiesOf(body.name, 0.2)));
    if (HasFailure()) return;
  }
}

/// Two boxes that meet above a floor, in either order.
Scene meetingBoxes(bool reversed) {
  Scene scene = thrownBox();
  Body other = solid("other", Box{{0.2, 0.2, 0.2}}, {1.2, 0.1, 1.2});
  other.velocity = {-2, 0, 1};
  scene.bodies.push_back(other);
  if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
  return scene;
}

std::vector<Constraint> ofMeeting() {
  return {{"box", nthImpact(1, "other"), {{"impulse", {1}}, {"kinetic_energy", {1}}, {"height", {1}}}},
          {"other", nthImpact(1), {{"impulse", {1}}}},
          {"box", between(0.05, 0.15), {{"height", {1}}}},
          {"box", 0.6, {{"speed", {1}}}, "other"},
          {"other", 0.6, {{"kinetic_energy", {1}}}},
          {"box", nthImpact(1, "other"), {{"contact", {1, 1, 1}}}},
          {"other", nthImpact(1), {{"contact", {1, any, any}}}}};
}

std::vector<Control> allOfBoth() {
  std::vector<Control> controls = controlsOf("box");
  for (const Control& c : {velocity("other"), angularVelocity("other"), mass("other"), inertia("other"), orientation("other")})
    controls.push_back(c);
  controls.push_back(elasticity("felt"));
  controls.push_back(friction("felt"));
  return controls;
}

TEST(MotionQuantities, BodiesInReverseOrderAreTheSame) {
  std::vector<RowsAndJacobian> found;
  for (bool reversed : {false, true}) {
    const Scene scene = meetingBoxes(reversed);
    OdeContacts contacts(scene);
    const EditProblem problem(scene, contacts, 0.7, allOfBoth(), ofMeeting());
    found.push_back(evaluateByAdjoint(problem, problem.controls.startValues()));
    ASSERT_TRUE(found.back().rows.available) << found.back().rows.message;
    const RowsAndJacobian forward = evaluateByTangent(problem, problem.controls.startValues());
    for (Eigen::Index i = 0; i < forward.jacobian.rows(); ++i)
      test::expectEntries(Eigen::VectorXd(forward.jacobian.row(i)), Eigen::VectorXd(found.back().jacobian.row(i)), 1e-12,
                          problem.constraints.describeRow(static_cast<int>(i)),
                          found.back().jacobian.row(i).cwiseAbs().maxCoeff());
  }
  const Eigen::MatrixXd &a = found[0].jacobian, &b = found[1].jacobian;
  // the impulses on the two are one
  EXPECT_NEAR(found[0].rows.values[0], found[0].rows.values[3], 1e-12);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    EXPECT_NEAR(found[0].rows.values[i], found[1].rows.values[i], 1e-11);
    test::expectEntries(Eigen::VectorXd(a.row(i)), Eigen::VectorXd(b.row(i)), 1e-10, "row " + std::to_string(i),
                        a.row(i).cwiseAbs().maxCoeff());
  }
}

TEST(MotionQuantities, DerivativesThroughAMeeting) {
  const Scene scene = meetingBoxes(false);
  OdeContacts contacts(scene);
  expectDerivatives(EditProblem(scene, contacts, 0.7,
                                {velocity("box"), angularVelocity("other"), mass("other"), inertia("other"),
                                 elasticity("felt"), friction("felt"), gravity()},
                                ofMeeting()));
}

}  // namespace
}  // namespace carom
