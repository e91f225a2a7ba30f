// SPDX-License-Identifier: MIT
// Rows of regions kept by the shape: tangent against adjoint, against differences, second derivatives, bodies in reverse
// order; and edits that they hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/hessian.hpp"
#include "editing/problem/jacobian.hpp"
#include "editing/solve/edit_evaluator.hpp"
#include "tests/editing/scenes.h"
#include "tests/editing/shape_regions.h"

namespace carom {

using namespace editing_detail;
using namespace shape_regions;

namespace {

using namespace testing_scenes;

Constraint kept(Region region, double from, double to) {
  region.keep = Region::Keep::shape;
  region.during = {from, to};
  Constraint c{"body", 0.0, {}};
  c.regions = {std::move(region)};
  return c;
}

/// Out of one region and of one that the body goes right through, and within another, which is a sphere or a box.
std::vector<Constraint> bothSides(const Scene& scene, std::uint64_t seed) {
  Region avoid = anyRegion(seed, Region::Side::avoid).region, inside = anyRegion(seed, Region::Side::inside).region;
  inside.shape = Sphere{4};
  if (seed % 2 == 1) inside.shape = Box{{4, 5, 6}};
  avoid.margin = 0.02;
  Region through = avoid;
  through.position = fly(scene, 0.5).stateAt(0, 0.45).position + Vec3(0.02, 0.03, -0.01);
  return {kept(avoid, 0.07, 0.9), kept(through, 0.07, 0.9), kept(inside, 0.07, 0.9)};
}

std::vector<Control> everything() {
  return {velocity("body"), angularVelocity("body"), orientation("body"), position("body"), size("body"),
          gravity()};
}

Eigen::VectorXd someUnknowns(const EditProblem& problem) {
  return Eigen::VectorXd::LinSpaced(problem.unknowns(), -0.003, 0.004);
}

std::vector<Clearance::Keeps> keepsOf(const EditProblem& problem, const Motion& motion) {
  std::vector<Clearance::Keeps> keeps;
  for (int i = 0; i < problem.constraints.size(); ++i)
    keeps.push_back(problem.constraints.clearanceOfShape(motion, i)->keeps);
  return keeps;
}

EditPointPtr pointOf(const EditProblem& problem, const Eigen::VectorXd& unknowns) {
  EditPointPtr point = pointAt(problem, unknowns, problem.horizon, false);
  EXPECT_TRUE(point && point->rows.available) << (point ? point->rows.message : "no motion");
  differentiate(problem, *point);
  return point;
}

/// Of all rows by the unknowns, SI.
Eigen::MatrixXd jacobianOf(const EditProblem& problem, const EditPoint& point) {
  Eigen::MatrixXd J = *point.row_jacobian;
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i) *= problem.constraints.rows()[static_cast<std::size_t>(i)].scale;
  return J;
}

bool isReliable(const RowValues& rows) {
  return std::all_of(rows.notes.begin(), rows.notes.end(), [](const RowNote& n) { return n.doubt.empty(); });
}

struct Counts {
  int least = 0, place = 0, crossing = 0;
};

// First and second derivatives of every row against differences, extrapolated.
void expectDerivatives(const EditProblem& problem, Counts& counts) {
  const Eigen::VectorXd at = someUnknowns(problem);
  const EditPointPtr point = pointOf(problem, at);
  const auto keeps = keepsOf(problem, point->motion);
  if (!isReliable(point->rows)) return;
  const Eigen::MatrixXd J = jacobianOf(problem, *point);
  const Eigen::VectorXd values = problem.valuesOf(at);
  const Eigen::MatrixXd by_adjoint = jacobianByAdjoint(problem, values, point->motion, point->rows),
                        by_tangent = jacobianByTangent(problem, values, point->motion, point->rows);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    const double scale = std::max(1.0, by_tangent.row(i).cwiseAbs().maxCoeff());
    for (Eigen::Index j = 0; j < J.cols(); ++j)
      EXPECT_TRUE(std::abs(by_adjoint(i, j) - by_tangent(i, j)) <= 1e-13 * scale)
          << problem.constraints.describeRow(static_cast<int>(i)) << " by " << j;
  }
  const auto rows = static_cast<std::size_t>(J.rows());
  std::vector<Eigen::MatrixXd> H;
  for (std::size_t i = 0; i < rows; ++i) {
    H.push_back(rowsHessian(problem, at, point->motion, point->rows,
                            Eigen::VectorXd::Unit(J.rows(), static_cast<Eigen::Index>(i))));
    EXPECT_EQ((H[i] - H[i].transpose()).cwiseAbs().maxCoeff(), 0);
  }
  for (int j = 0; j < problem.unknowns(); ++j) {
    bool same = true;
    const auto differences = [&](double h) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(at.size(), j);
      const EditPointPtr up = pointOf(problem, at + step), down = pointOf(problem, at - step);
      same = same && keepsOf(problem, up->motion) == keeps && keepsOf(problem, down->motion) == keeps;
      return std::pair{Eigen::VectorXd((up->rows.values - down->rows.values) / (2 * h)),
                       Eigen::MatrixXd((jacobianOf(problem, *up) - jacobianOf(problem, *down)) / (2 * h))};
    };
    const auto narrow = differences(5e-5), wide = differences(1e-4);
    if (!same) continue;
    const Eigen::VectorXd first = (4 * narrow.first - wide.first) / 3;
    const Eigen::MatrixXd second = (4 * narrow.second - wide.second) / 3;
    for (std::size_t i = 0; i < rows; ++i) {
      const auto r = static_cast<Eigen::Index>(i);
      const double whole = std::max(1.0, J.row(r).cwiseAbs().maxCoeff());
      EXPECT_TRUE(std::abs(J(r, j) - first[r]) <= 1e-8 * whole)
          << problem.constraints.describeRow(static_cast<int>(i)) << " by " << j << ": " << J(r, j) << ", differences "
          << first[r];
      const double scale = std::max({second.row(r).cwiseAbs().maxCoeff(), 1e-2 * H[i].cwiseAbs().maxCoeff(), 1e-3});
      for (int k = 0; k < problem.unknowns(); ++k)
        EXPECT_TRUE(std::abs(H[i](k, j) - second(r, k)) <= 3e-8 * scale)
            << problem.constraints.describeRow(static_cast<int>(i)) << " by " << k << " and " << j << ": " << H[i](k, j)
            << ", differences " << second(r, k) << ", scale " << scale;
    }
  }
  for (const Clearance::Keeps k : keeps) {
    counts.least += k == Clearance::Keeps::least;
    counts.place += k == Clearance::Keeps::place;
    counts.crossing += k == Clearance::Keeps::two_faces;
  }
}

TEST(ShapeRegionRows, DerivativesOfEveryShape) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 56; ++seed) {
    if (seed % 5 == 0) continue;  // turns so far that differences are all rounding
    SCOPED_TRACE(seed);
    const Scene scene = anyFlight(seed);
    OdeContacts contacts(scene);
    expectDerivatives(EditProblem(scene, contacts, 1, everything(), bothSides(scene, seed)), counts);
  }
  EXPECT_GE(counts.least, 60);
  EXPECT_GE(counts.place, 40);
  EXPECT_GE(counts.crossing, 5);
}

// A box that bounces, held before, at and after its impact.
Scene bouncing(bool reversed) {
  Scene scene = thrownBox();
  scene.bodies[1].name = "body";
  if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
  return scene;
}

std::vector<Constraint> aroundTheBounce(const Scene& scene) {
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.6);
  const Vec3 middle = motion.stateAt("body", 0.2).position;
  Region out, in;
  out.shape = Box{{0.3, 0.2, 0.4}};
  out.position = middle + Vec3(0.3, 0.1, 0.3);
  in.side = Region::Side::inside;
  in.shape = Sphere{3};
  in.position = middle + Vec3(0.1, 0, 1);
  Region box = in;
  box.shape = Box{{6, 5, 4}};
  return {kept(out, 0.01, 0.55), kept(in, 0.01, 0.55), kept(box, 0.01, 0.55)};
}

TEST(ShapeRegionRows, BodiesInReverseOrderAreTheSameAndNothingIsChanged) {
  Eigen::VectorXd values[2];
  Eigen::MatrixXd jacobians[2];
  const std::vector<Constraint> constraints = aroundTheBounce(bouncing(false));
  for (const bool reversed : {false, true}) {
    const Scene scene = bouncing(reversed);
    OdeContacts contacts(scene);
    const EditProblem problem(scene, contacts, 0.6, {velocity("body"), angularVelocity("body"), size("body")}, constraints);
    const Eigen::VectorXd at = someUnknowns(problem);
    const EditPointPtr point = pointOf(problem, at);
    values[reversed] = point->rows.values;
    jacobians[reversed] = jacobianOf(problem, *point);
    rowsHessian(problem, at, point->motion, point->rows, Eigen::VectorXd::Ones(values[reversed].size()));
    const RowValues again = problem.constraints.evaluate(point->motion);
    EXPECT_EQ((again.values - point->rows.values).cwiseAbs().maxCoeff(), 0) << "differentiating changed the motion";
  }
  EXPECT_LE((values[0] - values[1]).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LE((jacobians[0] - jacobians[1]).cwiseAbs().maxCoeff(), 1e-11 * jacobians[0].cwiseAbs().maxCoeff());
}

TEST(ShapeRegionRows, DerivativesThroughABounce) {
  Counts counts;
  const Scene scene = bouncing(false);
  OdeContacts contacts(scene);
  expectDerivatives(EditProblem(scene, contacts, 0.6, {velocity("body"), angularVelocity("body"), elasticity("felt")},
                                aroundTheBounce(scene)),
                    counts);
  EXPECT_GE(counts.place + counts.least, 5);
}

/// The first solution.
EditOptions fast() {
  EditOptions options;
  options.effort = Effort::fast;
  return options;
}

/// Least clearances of the result, read afresh.
void expectMet(const EditResult& result, const std::vector<Constraint>& constraints) {
  ASSERT_TRUE(result.solved()) << nameOf(result.status) << ": " << result.message;
  const ConstraintSet set(*result.motion.scene, constraints, result.motion.end);
  const RowValues rows = set.evaluate(result.motion);
  ASSERT_TRUE(rows.available) << rows.message;
  for (int i = 0; i < set.size(); ++i) EXPECT_LE(std::abs(rows.scaled[i]), 1e-8) << set.describeRow(i);
}

// A rod of 1 m, thrown end over end, that has to pass a slit of 0.4 m: its ball does not.
TEST(ShapeRegionRows, ARodGoesThroughASlit) {
  Scene scene;
  Body rod = shaped("body", Capsule{0.03, 0.94}, {0, 0, 1}, {4, 0, 2.2}, {0, 4.3, 0});
  scene.bodies = {rod};
  Region low, high;
  low.shape = high.shape = Box{{0.1, 2, 1}};
  low.position = {1, 0, 0.6};
  high.position = {1, 0, 2};
  Constraint end{"body", 0.6, {{"position", {2.4, any, any}}}};
  const std::vector<Constraint> constraints{std::move(end), kept(low, 0, 0.6), kept(high, 0, 0.6)};
  OdeContacts contacts(scene);
  {
    const EditProblem problem(scene, contacts, 0.6, {velocity("body"), angularVelocity("body")}, constraints);
    const EditPointPtr start = pointAt(problem, Eigen::VectorXd::Zero(problem.unknowns()), problem.horizon, false);
    ASSERT_TRUE(start && start->rows.available);
    EXPECT_LT(std::min(start->rows.values[1], start->rows.values[2]), -0.05) << "the start goes through a wall";
  }
  Edit edit(scene, contacts, 0.6, {velocity("body"), angularVelocity("body")}, constraints);
  expectMet(edit.solve(fast()), constraints);
}

// A book that has to stay in a box which is not as long as twice its diagonal.
TEST(ShapeRegionRows, ABookStaysInABox) {
  Scene scene;
  scene.bodies = {shaped("body", Box{{0.24, 0.17, 0.03}}, {0, 0, 0.2}, {0.3, 0.1, 3}, {2, 3, 1})};
  Region box;
  box.side = Region::Side::inside;
  box.shape = Box{{0.6, 0.3, 0.9}};
  box.position = {0.1, 0, 0.45};
  const std::vector<Constraint> constraints{{"body", 0.5, {{"position", {any, any, 0.4}}}}, kept(box, 0, 0.55)};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.55, {velocity("body"), angularVelocity("body")}, constraints);
  const EditResult result = edit.solve(fast());
  expectMet(result, constraints);
  for (int i = 0; i <= 2000; ++i) {
    const BodyState s = result.motion.stateAt("body", 0.55 * i / 2000);
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner(k & 1 ? 0.12 : -0.12, k & 2 ? 0.085 : -0.085, k & 4 ? 0.015 : -0.015);
      const Vec3 at = s.position + s.orientation * corner - box.position;
      EXPECT_TRUE(((Vec3(0.3, 0.15, 0.45) - at.cwiseAbs()).array() >= -1e-9).all()) << i;
    }
  }
}

// Whose start leads right through the middle of the region.
TEST(ShapeRegionRows, AStartThroughARegionIsLedOut) {
  for (const bool sphere : {false, true})
    for (std::uint64_t which = 0; which < 7; ++which) {
      if (!sphere && which > 1 && which < 6) continue;  // a second or two each
      test::Random random(which + 3);
      Scene scene;
      scene.bodies = {shaped("body", anyShape(random, which), {-1, 0.01, 0}, {2, 0.02, 4.9}, {1, 2, 0.5})};
      Region post;
      post.shape = Box{{0.2, 0.2, 1}};
      if (sphere) post.shape = Sphere{0.25};
      post.position = {0, 0, 1.2};
      post.margin = 0.01;
      const std::vector<Constraint> constraints{{"body", 1.0, {{"position", {1, 0.02, any}}}}, kept(post, 0, 1)};
      OdeContacts contacts(scene);
      Edit edit(scene, contacts, 1, {velocity("body"), angularVelocity("body")}, constraints);
      SCOPED_TRACE(std::to_string(which) + (sphere ? " sphere" : " box"));
      expectMet(edit.solve(fast()), constraints);
    }
}

TEST(ShapeRegionRows, AskForTheOrientationOfABall) {
  const Scene scene = anyFlight(7);
  const ConstraintSet set(scene, {kept(anyRegion(7, Region::Side::avoid).region, 0, 1)}, 1);
  EXPECT_TRUE(set.asksOrientation()[0]);
  Region negative = anyRegion(7, Region::Side::avoid).region;
  negative.margin = -0.1;
  EXPECT_THROW(ConstraintSet(scene, {kept(negative, 0, 1)}, 1), InputError);
}

}  // namespace
}  // namespace carom
