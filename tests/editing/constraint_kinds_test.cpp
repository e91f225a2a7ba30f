// SPDX-License-Identifier: MIT
// Constraints beyond a number at a time: ranges, seen from another body, at some time of a span, regions.

#include <gtest/gtest.h>

#include <cmath>

#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem/rows/polynomial.hpp"
#include "editing/problem/rows/relative.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

/// A ball thrown over a floor, with a second one that comes towards it.
Scene twoBalls() {
  Scene scene;
  scene.materials = {material("rubber", 0.8, 0.3)};
  scene.bodies = {fixedPlane("floor", "rubber", {0, 0, 1}, 0), ball("ball", "rubber", 0.1, {0, 0, 1}, {2, 0, 1}),
                  ball("other", "rubber", 0.1, {3, 0.5, 1}, {-1, 0, 2})};
  scene.bodies[1].angular_velocity = {0, 3, 0};
  return scene;
}

Region sphereRegion(Region::Side side, const Vec3& position, double radius) {
  Region region;
  region.side = side;
  region.shape = Sphere{radius};
  region.position = position;
  return region;
}

Region boxRegion(Region::Side side, const Vec3& position, const Vec3& size) {
  Region region;
  region.side = side;
  region.shape = Box{size};
  region.position = position;
  region.orientation = Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  return region;
}

Constraint kept(const std::string& body, Region region) {
  Constraint constraint{body, 0.0, {}};
  constraint.regions = {std::move(region)};
  return constraint;
}

Constraint seen(Constraint constraint, const std::string& from) {
  constraint.relative_to = from;
  return constraint;
}

Target ranged(std::string quantity, std::vector<TargetNumber> min, std::vector<TargetNumber> max) {
  Target target{std::move(quantity), std::vector<TargetNumber>(min.size(), any)};
  target.min = std::move(min), target.max = std::move(max);
  return target;
}

/// Every kind of row there is beyond the plain ones.
std::vector<Constraint> everyKind() {
  return {{"ball", 0.9, {ranged("position", {0.5, any, 0}, {0.6, 0.3, any})}},
          {"ball", nthImpact(1), {ranged("time", {0.1}, {0.2})}},
          seen({"ball",
                0.7,
                {{"position", {0.1, 0.2, any}},
                 {"orientation", {1, 0, 0, 0}},
                 {"velocity", {1, 0, 0}},
                 {"angular_velocity", {0, 1, 0}},
                 {"point", {1, 1, 1}, {0.1, 0.2, 0.3}}}},
               "other"),
          seen({"ball", nthImpact(1, "floor"), {{"position", {1, 2, 3}}}}, "other"),
          {"other", between(0.2, 1.1), {{"position", {2.4, 0.6, any}}, {"velocity", {any, any, 0}}}},
          seen({"ball", between(0.5, 1.0), {{"position", {-1, 0, 0}}}}, "other"),
          kept("ball", sphereRegion(Region::Side::avoid, {1, 0.1, 0.8}, 0.2)),
          kept("ball", sphereRegion(Region::Side::inside, {1, 0, 0}, 1)),
          kept("other", boxRegion(Region::Side::avoid, {2, 0.4, 0.5}, {0.5, 0.6, 0.7})),
          kept("other", boxRegion(Region::Side::inside, {2, 0.4, 0.5}, {3, 4, 5}))};
}

std::vector<Control> everyStart() {
  return {position("ball"),         orientation("ball"), velocity("ball"),  angularVelocity("ball"),
          velocity("other"),        mass("ball"),        inertia("other"),  elasticity("rubber"),
          friction("rubber"),       gravity(),           position("other"), orientation("other"),
          angularVelocity("other"), size("ball")};
}

TEST(ConstraintKinds, RowsHaveNamesAndRanges) {
  const ConstraintSet set(twoBalls(), everyKind(), 1.2);
  EXPECT_EQ(set.rows()[0].name, "position.x");
  EXPECT_TRUE(set.rows()[0].isRange());
  EXPECT_EQ(set.rows()[1].lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(set.freeTimes().size(), 2u);
  EXPECT_EQ(set.describeRow(set.size() - 1), "inside.-z of 'other' from 0 s to 1.2 s");
  EXPECT_EQ(set.describeRow(4).substr(0, 10), "position.x");
  EXPECT_EQ(set.residual(0, 0.55), 0);
  EXPECT_EQ(set.residual(0, 0.7), 0.7 - 0.6);
  EXPECT_EQ(set.residual(0, 0.4), 0.4 - 0.5);
}

// Rows and their derivatives by controls and free times, against the tangent pass and against differences.
TEST(ConstraintKinds, DerivativesAgree) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1.2, everyStart(), everyKind());
  const auto n = problem.controls.size(), k = problem.times();
  const auto unknowns = [&](const Eigen::VectorXd& y, const Eigen::VectorXd& times) {
    Eigen::VectorXd u(problem.unknowns());
    u << y, problem.unknownTimes(times);
    return u;
  };
  const Eigen::VectorXd y0 = Eigen::VectorXd::LinSpaced(n, -0.01, 0.015);
  const Eigen::VectorXd times = (Eigen::VectorXd(2) << 0.83, 0.71).finished();
  struct Read {
    Motion motion;
    RowValues rows;
  };
  const auto readAt = [&](const Eigen::VectorXd& u) {
    Read r;
    r.motion = simulateAt(problem, problem.valuesOf(u), problem.horizon);
    r.rows = problem.constraints.evaluate(r.motion, problem.timesOf(u));
    return r;
  };
  const Eigen::VectorXd u0 = unknowns(y0, times);
  const Read at = readAt(u0);
  ASSERT_TRUE(at.rows.available) << at.rows.message;
  Eigen::MatrixXd J(problem.constraints.size(), n + k);
  J.leftCols(n) = jacobianByAdjoint(problem, problem.valuesOf(u0), at.motion, at.rows);
  const Eigen::MatrixXd by_tangent = jacobianByTangent(problem, problem.valuesOf(u0), at.motion, at.rows);
  J.rightCols(k) = jacobianByTimes(problem, at.motion, at.rows);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double scale = std::max(1.0, by_tangent.col(j).cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < J.rows(); ++i)
      EXPECT_TRUE(std::abs(J(i, j) - by_tangent(i, j)) <= 1e-12 * scale)
          << problem.constraints.describeRow(static_cast<int>(i)) << " by "
          << problem.controls.describeVariable(static_cast<int>(j));
  }
  J *= problem.rates(u0).asDiagonal();
  const double h = 1e-6;
  for (Eigen::Index j = 0; j < n + k; ++j) {
    Eigen::VectorXd up = u0, down = u0;
    up[j] += h, down[j] -= h;
    const Read a = readAt(up), b = readAt(down);
    ASSERT_EQ(a.motion.signature(), b.motion.signature());
    const double scale = 1 + J.col(j).cwiseAbs().maxCoeff();
    for (int i = 0; i < problem.constraints.size(); ++i) {
      const double difference = (a.rows.values[i] - b.rows.values[i]) / (2 * h);
      EXPECT_TRUE(std::abs(J(i, j) - difference) <= 2e-6 * scale)
          << problem.constraints.describeRow(i) << " by unknown " << j << ": " << J(i, j) << " and " << difference;
    }
  }
}

// The least clearance of every region row, against a dense sampling of the motion.
TEST(ConstraintKinds, NothingIsBelowTheLeastClearance) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1.2);
  for (Region::Side side : {Region::Side::avoid, Region::Side::inside}) {
    for (int which = 0; which < 2; ++which) {
      for (double x = 0; x < 2.5; x += 0.21) {
        const Vec3 place(x, 0.03, 0.7);
        Region region = which == 0 ? sphereRegion(side, place, 0.3) : boxRegion(side, place, {0.5, 0.4, 0.6});
        const BoundRegion bound{region, 0.05, 1.17, 0.02};
        for (int component = 0; component < rowsOf(region); ++component) {
          const auto least = leastClearance(motion, 1, bound, component);
          ASSERT_TRUE(least.has_value());
          double sampled = std::numeric_limits<double>::infinity();
          for (int i = 0; i <= 40000; ++i) {
            const double t = 0.05 + (1.17 - 0.05) * i / 40000;
            const Vec3 y = region.orientation.conjugate() * (motion.stateAt(1, t).position - place);
            double clearance;
            if (which == 0) {
              clearance = side == Region::Side::avoid ? y.norm() - 0.3 - 0.02 : 0.3 - 0.02 - y.norm();
            } else {
              const Vec3 half(0.25, 0.2, 0.3);
              const double face = (component % 2 == 0 ? 1 : -1) * y[component / 2];
              clearance = side == Region::Side::avoid ? (y.cwiseAbs() - half).maxCoeff() - 0.02
                                                      : half[component / 2] - 0.02 - face;
            }
            sampled = std::min(sampled, clearance);
          }
          EXPECT_TRUE(least->value <= sampled + 1e-14) << x << ": " << least->value << " above " << sampled;
          EXPECT_TRUE(least->value >= sampled - 2e-4) << x << ": " << least->value << " below " << sampled;
        }
      }
    }
  }
}

TEST(ConstraintKinds, RootsOfPolynomials) {
  const Polynomial<3> cubic{-6, 11, -6, 1};  // (s - 1)(s - 2)(s - 3)
  const std::vector<double> roots = rootsIn<3>(cubic, 0, 10);
  ASSERT_EQ(roots.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::abs(roots[static_cast<std::size_t>(i)] - (i + 1)) <= 1e-14);
  EXPECT_EQ(rootsIn<3>(cubic, 1.5, 2.5).size(), 1u);
  EXPECT_TRUE((rootsIn<1>({1, 0}, -1, 1).empty()));
}

void expectSolved(const EditResult& result) {
  EXPECT_TRUE(result.solved()) << nameOf(result.status) << ": " << result.message;
  EXPECT_TRUE(result.scaled_residual <= 1e-9) << result.scaled_residual;
}

TEST(ConstraintKinds, RangeIsReachedAtItsNearEnd) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  const double before = simulate(scene, contacts, 0.4).stateAt("ball", 0.4).position.x();
  Edit edit(scene, contacts, 0.4, {velocity("ball")},
            {{"ball", 0.4, {ranged("position", {before + 0.1, any, any}, {before + 0.3, any, any})}}});
  const EditResult result = edit.solve();
  expectSolved(result);
  EXPECT_TRUE(std::abs(result.motion.stateAt("ball", 0.4).position.x() - (before + 0.1)) <= 1e-8);
}

TEST(ConstraintKinds, RangeThatHoldsAlreadyChangesNothing) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.4, {velocity("ball")},
            {{"ball", 0.4, {ranged("position", {0, any, any}, {5, any, any})}}});
  const EditResult result = edit.solve();
  expectSolved(result);
  EXPECT_EQ(result.objective, 0);
}

TEST(ConstraintKinds, SeenFromAnotherBody) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.2, {velocity("ball"), velocity("other")},
            {seen({"ball", 1.0, {{"position", {-0.5, 0.1, 0.2}}}}, "other")});
  const EditResult result = edit.solve();
  expectSolved(result);
  const BodyState a = result.motion.stateAt("ball", 1.0), b = result.motion.stateAt("other", 1.0);
  EXPECT_TRUE((b.orientation.conjugate() * (a.position - b.position) - Vec3(-0.5, 0.1, 0.2)).norm() <= 1e-8);
}

TEST(ConstraintKinds, AtSomeTimeOfASpan) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.2, {velocity("ball")}, {{"ball", between(0.2, 0.5), {{"position", {0.9, 0.1, 1.05}}}}});
  const EditResult result = edit.solve();
  expectSolved(result);
  double least = 1;
  for (int i = 0; i <= 30000; ++i)
    least =
        std::min(least, (result.motion.stateAt("ball", 0.2 + 0.3 * i / 30000).position - Vec3(0.9, 0.1, 1.05)).norm());
  EXPECT_TRUE(least <= 1e-4) << least;
  // a free time leaves less to change than any time that is given
  for (double t : {0.3, 0.35, 0.4, 0.45, 0.5}) {
    Edit fixed(scene, contacts, 1.2, {velocity("ball")}, {{"ball", t, {{"position", {0.9, 0.1, 1.05}}}}});
    const EditResult other = fixed.solve();
    if (other.solved()) {
      EXPECT_LE(result.objective, other.objective * (1 + 1e-7)) << t;
    }
  }
}

TEST(ConstraintKinds, AvoidsARegionAllTheTime) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  const Region boxed = boxRegion(Region::Side::avoid, {0.8, 0.02, 1.0}, {0.2, 0.2, 0.2});
  for (const Region& region : {sphereRegion(Region::Side::avoid, {0.8, 0.02, 1.05}, 0.15), boxed}) {
    Edit edit(scene, contacts, 0.6, {velocity("ball")},
              {{"ball", 0.6, {{"position", {1.2, 0, any}}}}, kept("ball", region)});
    const EditResult result = edit.solve();
    expectSolved(result);
    const BoundRegion bound{region, 0, 0.6, 0.1};
    const auto least = leastClearance(result.motion, 1, bound, 0);
    ASSERT_TRUE(least.has_value());
    EXPECT_TRUE(least->value >= -1e-9) << least->value;
    EXPECT_GT(result.objective, 0);
  }
}

TEST(ConstraintKinds, StaysInsideARegion) {
  const Scene scene = twoBalls();
  OdeContacts contacts(scene);
  Region region;
  region.side = Region::Side::inside;
  region.shape = Box{Vec3(2, 2, 1.15)};
  region.position = {1, 0, 0.5};
  region.margin = 0;
  Edit edit(scene, contacts, 0.5, {velocity("ball")}, {kept("ball", region)});
  const EditResult result = edit.solve();
  expectSolved(result);
  for (int i = 0; i <= 5000; ++i) {
    const double z = result.motion.stateAt("ball", 0.5 * i / 5000).position.z();
    EXPECT_TRUE(z <= 1.075 + 1e-9) << z;
  }
}

}  // namespace
}  // namespace carom
