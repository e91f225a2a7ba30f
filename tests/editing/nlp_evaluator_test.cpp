// SPDX-License-Identifier: MIT
// An edit as a nonlinear program: its derivatives against the forward pass and against differences of its own values,
// the same with the bodies in reverse order, and what it says where it has nothing.
#include "editing/nlp_evaluator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include <Eigen/LU>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem_of.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;

Eigen::VectorXd scalesOf(const NlpEvaluator& program) {
  Eigen::VectorXd scales(program.start().size());
  for (Eigen::Index i = 0; i < scales.size(); ++i) scales[i] = program.variables()[static_cast<std::size_t>(i)].scale;
  return scales;
}

Eigen::VectorXd rowScales(const NlpEvaluator& program) {
  Eigen::VectorXd scales(static_cast<Eigen::Index>(program.rows().size()));
  for (Eigen::Index i = 0; i < scales.size(); ++i) scales[i] = program.rows()[static_cast<std::size_t>(i)].scale;
  return scales;
}

Eigen::VectorXd drawn(std::mt19937& random, Eigen::Index size, double away) {
  std::uniform_real_distribution<double> uniform(-away, away);
  Eigen::VectorXd out(size);
  for (Eigen::Index i = 0; i < size; ++i) out[i] = uniform(random);
  return out;
}

/// Near the start; times within their intervals.
Eigen::VectorXd nearStart(const NlpEvaluator& program, std::mt19937& random) {
  const Eigen::VectorXd u = drawn(random, program.start().size(), 1);
  Eigen::VectorXd x = program.start() + 0.01 * scalesOf(program).cwiseProduct(u);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const NlpVariable& v = program.variables()[static_cast<std::size_t>(i)];
    if (v.control < 0) x[i] = v.lower + (0.5 + 0.3 * u[i]) * (v.upper - v.lower);
  }
  return x;
}

/// Everything that can be read of the box, at a time, at an impact and at some time of a span, and beside regions.
void holdEverything(Edit& edit) {
  edit.nail("box", between(0.2, 0.35)).position({1, 0.5, 1}).velocity({1, 2, 3});
  edit.nail("box", 0.4).avoid({.shape = Sphere{0.1}, .position = {0.2, 0.1, 0.2}});
}

/// Entry by entry, in natural scales; `largest` is the scale of what is compared.
void expectNear(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected, double tolerance, const char* what) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  const double scale = std::max(1.0, expected.cwiseAbs().maxCoeff());
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index j = 0; j < found.cols(); ++j)
      EXPECT_TRUE(std::abs(found(i, j) - expected(i, j)) <= tolerance * scale)
          << what << " " << i << ", " << j << ": " << found(i, j) << ", expected " << expected(i, j);
}

class Program : public testing::TestWithParam<unsigned> {
 protected:
  Program() : scene_(thrownBox()), contacts_(scene_), edit_(scene_, contacts_, 0.6, everyControl(), everyQuantity()) {
    holdEverything(edit_);
  }
  Scene scene_;
  OdeContacts contacts_;
  Edit edit_;
};

// The forward pass gives the same Jacobian; the values are those of the motion.
TEST_P(Program, JacobianIsThatOfTheForwardPass) {
  SCOPED_TRACE("seed " + std::to_string(GetParam()));
  const NlpEvaluator program = edit_.evaluator();
  std::mt19937 random(GetParam());
  const Eigen::VectorXd x = nearStart(program, random);
  const NlpPoint point = program.at(x);
  ASSERT_TRUE(point.available()) << point.message();
  const EditProblem problem = problemOf(edit_);
  const Eigen::Index n = problem.controls.size(), rows = problem.constraints.size();
  const RowValues read = problem.constraints.evaluate(point.motion(), x.tail(problem.times()));
  EXPECT_EQ(point.values().head(rows), read.values);
  const Eigen::MatrixXd forward = jacobianByTangent(problem, x.head(n), point.motion(), read);
  const Eigen::VectorXd inverse = rowScales(program).cwiseInverse();
  const Eigen::MatrixXd J = point.jacobian().entries;
  expectNear(inverse.head(rows).asDiagonal() * J.topLeftCorner(rows, n) * scalesOf(program).head(n).asDiagonal(),
             inverse.head(rows).asDiagonal() * forward * scalesOf(program).head(n).asDiagonal(), 1e-12, "entry");
}

// Values against differences: rows, validity, the objective; times, too.
TEST_P(Program, DerivativesAreThoseOfItsValues) {
  SCOPED_TRACE("seed " + std::to_string(GetParam()));
  edit_.minimise({"speed",
                  [](const Motion& motion) {
                    const Vec3 v = motion.stateAt("box", 0.3).velocity;
                    RowReading reading;
                    reading.value = 0.5 * v.squaredNorm();
                    StateSeed& seed = reading.seeds.emplace_back();
                    seed.body = 1, seed.at = Instant::at(0.3), seed.velocity = v;
                    reading.second_order = true;
                    reading.seed_rates = [](std::span<const BodyStateRate> rates) {
                      std::vector<StateSeed> d(1);
                      d[0].velocity = rates[0].velocity;
                      return d;
                    };
                    return reading;
                  },
                  4, When(0.3)},
                 0.3);
  const NlpEvaluator program = edit_.evaluator();
  std::mt19937 random(GetParam());
  const Eigen::VectorXd s = scalesOf(program), r = rowScales(program).cwiseInverse();
  const Eigen::VectorXd x = nearStart(program, random);
  const Eigen::VectorXd weights = drawn(random, r.size(), 1).cwiseProduct(r);
  const NlpPoint point = program.at(x);
  ASSERT_TRUE(point.available()) << point.message();
  ASSERT_TRUE(point.hasHessian());
  const auto all = [&](const Eigen::VectorXd& at) {  // scaled rows, the objective, the gradient of the Lagrangian
    const NlpPoint beside = program.at(at);
    EXPECT_EQ(beside.signature(), point.signature());
    Eigen::VectorXd out(r.size() + 1 + s.size());
    out << beside.values().cwiseProduct(r), beside.objective(),
        s.cwiseProduct(0.7 * beside.gradient().entries + beside.jacobian().entries.transpose() * weights);
    return out;
  };
  Eigen::MatrixXd expected(r.size() + 1 + s.size(), s.size());
  for (Eigen::Index j = 0; j < s.size(); ++j) {
    const auto slope = [&](double h) -> Eigen::VectorXd {
      const Eigen::VectorXd step = h * s[j] * Eigen::VectorXd::Unit(s.size(), j);
      return (all(x + step) - all(x - step)) / (2 * h);
    };
    expected.col(j) = (4 * slope(5e-5) - slope(1e-4)) / 3;
  }
  const Eigen::MatrixXd H = point.hessian(0.7, weights);
  expectNear(r.asDiagonal() * point.jacobian().entries * s.asDiagonal(), expected.topRows(r.size()), 3e-9, "row");
  expectNear(s.cwiseProduct(point.gradient().entries).transpose(), expected.row(r.size()), 3e-9, "gradient");
  expectNear(s.asDiagonal() * H * s.asDiagonal(), expected.bottomRows(s.size()), 3e-8, "Hessian");
  const Eigen::VectorXd d = s.cwiseProduct(drawn(random, s.size(), 1));
  expectNear(s.cwiseProduct(point.hessianTimes(0.7, weights, d)), s.cwiseProduct(H * d), 1e-11, "product");
}

INSTANTIATE_TEST_SUITE_P(Seeds, Program, testing::Values(1u, 3u, 4u));

// Rows and variables are told by their names, wherever the bodies stand in the list.
TEST(NlpEvaluator, DoesNotDependOnTheOrderOfBodies) {
  Scene scene = thrownBox();
  std::map<std::pair<std::string, std::string>, double> first;
  for (const bool turned : {false, true}) {
    if (turned) std::reverse(scene.bodies.begin(), scene.bodies.end());
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 0.6, everyControl(), everyQuantity());
    const NlpEvaluator program = edit.evaluator();
    const NlpPoint point = program.at(program.start());
    ASSERT_TRUE(point.available()) << point.message();
    const Eigen::VectorXd r = rowScales(program), s = scalesOf(program);
    const Eigen::MatrixXd J = r.cwiseInverse().asDiagonal() * point.jacobian().entries * s.asDiagonal();
    for (Eigen::Index i = 0; i < J.rows(); ++i)
      for (Eigen::Index j = 0; j < J.cols(); ++j) {
        const auto key = std::pair(program.rows()[static_cast<std::size_t>(i)].name + std::to_string(i),
                                   program.variables()[static_cast<std::size_t>(j)].name);
        if (!turned) first[key] = J(i, j);
        ASSERT_TRUE(first.contains(key)) << key.first << " " << key.second;
        EXPECT_TRUE(std::abs(J(i, j) - first[key]) <= 1e-11 * (1 + std::abs(first[key]))) << key.first << " " << key.second;
      }
  }
}

// What Edit::solve finds is a point of the program that meets its rows, and no change along them lowers the objective.
TEST(NlpEvaluator, AnswerOfSolveIsStationary) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.8);
  edit.vary(velocity("box"), elasticity("felt"), mass("box"));
  edit.nail("box", 0.7).position({0.9, any, any});
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << result.message;
  const NlpEvaluator program = edit.evaluator();
  Eigen::VectorXd x(program.start().size());
  ASSERT_EQ(static_cast<std::size_t>(x.size()), result.changed.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = result.changed[static_cast<std::size_t>(i)].after;
  const NlpPoint point = program.at(x);
  ASSERT_TRUE(point.available()) << point.message();
  EXPECT_TRUE(std::abs(point.objective() - result.objective) <= 1e-12) << point.objective();
  EXPECT_TRUE(std::abs(point.values()[0] - 0.9) <= 1e-8) << point.values()[0];
  const Eigen::VectorXd s = scalesOf(program);
  const Eigen::VectorXd g = s.cwiseProduct(point.gradient().entries);
  const Eigen::VectorXd j = s.cwiseProduct(point.jacobian().entries.row(0).transpose());
  const Eigen::VectorXd rest = g - g.dot(j) / j.squaredNorm() * j;
  EXPECT_TRUE(rest.norm() <= 1e-4 * g.norm()) << rest.norm() << " of " << g.norm();
}

TEST(NlpEvaluator, OutlivesItsEditAndItsContacts) {
  const auto made = [] {
    const Scene scene = thrownBox();
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 0.6, {velocity("box")}, everyQuantity());
    return edit.evaluator();
  };
  const NlpEvaluator program = made();
  const NlpPoint point = NlpEvaluator(program).at(program.start());
  EXPECT_TRUE(point.available()) << point.message();
  EXPECT_TRUE(point.jacobian().entries.allFinite());
}

// What a point does not have is said in a sentence, and asking for it throws that sentence.
TEST(NlpEvaluator, SaysWhatAPointLacks) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("box"), elasticity("felt"));
  edit.nail("box", nthImpact(1)).position({0.5, any, any});
  edit.nail("box", between(0.1, 0.2)).position({any, 0.1, any});
  const NlpEvaluator program = edit.evaluator();
  const auto expectLack = [&](Eigen::VectorXd x, const std::string& words) {
    const NlpPoint point = program.at(x);
    EXPECT_FALSE(point.available());
    EXPECT_NE(point.message().find(words), std::string::npos) << point.message();
    EXPECT_FALSE(point.hasHessian());
    const Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(program.rows().size()));
    EXPECT_THROW(point.values(), NotComputable);
    EXPECT_THROW(point.objective(), NotComputable);
    EXPECT_THROW(point.gradient(), NotComputable);
    EXPECT_THROW(point.jacobian(), NotComputable);
    EXPECT_THROW(point.signature(), NotComputable);
    EXPECT_THROW(point.hessian(1, weights), NotComputable);
    EXPECT_THROW(point.hessianTimes(1, weights, x), NotComputable);
  };
  Eigen::VectorXd x = program.start();
  x[2] = 40;  // up: no impact comes
  expectLack(x, "Impact 1 of 'box' does not come within 0.6 s.");
  x = program.start(), x[3] = 1.5;
  expectLack(x, "elasticity");
  x = program.start(), x[4] = 0.25;
  expectLack(x, "0.25 s");
  EXPECT_THROW(program.at(Eigen::VectorXd::Zero(4)), InputError);
  EXPECT_THROW(program.at(Eigen::VectorXd::Constant(5, kNaN)), InputError);
  EXPECT_THROW(program.sceneAt(Eigen::VectorXd::Zero(6)), InputError);
  std::stop_source stop;
  stop.request_stop();
  const NlpPoint stopped = program.at(program.start(), stop.get_token());
  EXPECT_EQ(stopped.message(), "The simulation was stopped.");
  EXPECT_THROW(stopped.values(), NotComputable);
  const NlpPoint start = program.at(program.start(), std::stop_source().get_token());
  EXPECT_TRUE(start.available());
  EXPECT_THROW(start.hessian(1, Eigen::VectorXd::Zero(1)), InputError);
  EXPECT_THROW(start.hessian(kNaN, Eigen::VectorXd::Zero(2)), InputError);
  EXPECT_THROW(start.hessianTimes(1, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(1)), InputError);
}

// What rates of seeds throw comes out as it is.
TEST(NlpEvaluator, PassesOnWhatRatesOfSeedsThrow) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("box"));
  MotionFunction height{"height", {}, 1, When(0.1)};
  height.read = [](const Motion& motion) {
    RowReading reading;
    reading.value = motion.stateAt("box", 0.1).position.z();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = bodyIndex(*motion.scene, "box"), seed.at = Instant::at(0.1), seed.position = {0, 0, 1};
    reading.second_order = true;
    reading.seed_rates = [](std::span<const BodyStateRate>) -> std::vector<StateSeed> { throw std::runtime_error("own"); };
    return reading;
  };
  edit.require(height, 0.5);
  const NlpEvaluator program = edit.evaluator();
  const NlpPoint point = program.at(program.start());
  ASSERT_TRUE(point.hasHessian()) << point.message();
  EXPECT_THROW(point.hessian(1, Eigen::VectorXd::Ones(1)), std::runtime_error);
}

// Rows of validity, and logarithmic variables: names, bounds and what a change costs.
TEST(NlpEvaluator, TellsVariablesAndRows) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(mass("box").weighted(2), inertia("box"), tilt("box", 1));
  edit.nail("box", 0.5).position(0.5, any, within(0, 1));
  const NlpEvaluator program = edit.evaluator();
  const std::vector<NlpVariable>& variables = program.variables();
  ASSERT_EQ(variables.size(), 6u);
  EXPECT_EQ(variables[0].name, "mass of 'box'");
  EXPECT_TRUE(variables[0].logarithmic);
  Eigen::VectorXd x = program.start();
  x[0] *= std::exp(variables[0].scale / variables[0].start);  // one scale
  EXPECT_NEAR(program.at(x).objective(), 0.5, 1e-14);
  EXPECT_EQ(program.sceneAt(x).bodies[1].mass, x[0]);
  const std::vector<NlpRow>& rows = program.rows();
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0].lower, rows[0].upper);
  EXPECT_EQ(rows[1].lower, 0);
  EXPECT_EQ(rows[1].upper, 1);
  EXPECT_EQ(rows[2].name, "triangle inequality of inertia.x of 'box'");
  EXPECT_EQ(rows[2].control, 1);
  EXPECT_EQ(rows[5].name, "cone of tilt of 'box' at impact 1");
  EXPECT_EQ(rows[5].control, 2);
}

}  // namespace
}  // namespace carom
