// SPDX-License-Identifier: MIT
// `carom check` finds derivatives that are wrong, also those that change with the last digits of the scene, which pass for
// rounding one by one: then it judges nothing.

#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "cli/check_differences.h"
#include "cli/check_excuses.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/cli/run_command.h"
#include "tests/support/scenes.h"

namespace carom::test {

using namespace cli;

namespace {

using nlohmann::json;

// Bounces twice, with friction, on a slope.
json thrownBall() {
  return {{"carom", 1},
          {"gravity", {1, 0.5, -9.81}},
          {"duration", 1.5},
          {"materials", {{"m", {{"elasticity", 0.6}, {"friction", 0.2}}}}},
          {"bodies",
           {{{"name", "floor"}, {"fixed", true}, {"material", "m"}, {"shape", {{"plane", {{"normal", {0, 0, 1}}, {"offset", 0}}}}}},
            {{"name", "ball"},
             {"material", "m"},
             {"mass", 0.5},
             {"shape", {{"sphere", {{"radius", 0.11}}}}},
             {"position", {0.3, 0.1, 0.7}},
             {"velocity", {2, -1, 0.5}},
             {"angular_velocity", {3.1, -14.7, 5.3}}}}},
          {"controls",
           {{{"vary", "velocity"}, {"body", "ball"}},
            {{"vary", "position"}, {"body", "ball"}},
            {{"vary", "elasticity"}, {"material", "m"}},
            {{"vary", "friction"}, {"material", "m"}}}},
          {"constraints",
           {{{"body", "ball"}, {"at", 1.2}, {"position", {0, 0, 0}}, {"velocity", {0, 0, 0}}, {"angular_velocity", {0, 0, 0}}}}}};
}

class Checked {
 public:
  Checked() : document_(parseDocument(thrownBall().dump(), "document", ".")), contacts_(document_.scene) {}

  DerivativeCheck with(const CheckedPasses& passes) {
    EditProblem problem(document_.scene, contacts_, document_.duration, document_.controls, document_.constraints);
    return checkDerivatives(problem, problem.controls.startValues(), [](const std::string&) {}, passes);
  }

 private:
  Document document_;
  OdeContacts contacts_;
};

// Of a size between 0.3 and 1, another one where only last digits differ.
double noiseOf(const Eigen::VectorXd& rows) {
  std::uint64_t hash = 1469598103934665603u;
  for (const double x : rows) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211u;
  hash ^= hash >> 29;
  const double size = 0.3 + 0.7 * static_cast<double>(hash % 10007) / 10007;
  return hash % 2 == 0 ? size : -size;
}

/// One entry is wrong, in one of five ways, for both passes.
CheckedPasses planted(int kind, Eigen::Index row, Eigen::Index column) {
  const auto spoil = [=](CheckedPasses::Pass pass) {
    return [=](const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion, const RowValues& rows) {
      Eigen::MatrixXd J = pass(problem, values, motion, rows);
      double& entry = J(row, column);
      switch (kind) {
        case 0: entry = -entry; break;
        case 1: entry = 0; break;
        case 2: entry *= 1 + 1e-3; break;
        case 3: entry += 1e-3 * J.col(column).norm(); break;
        default: entry *= 1 + 0.5 * noiseOf(rows.values); break;
      }
      return J;
    };
  };
  const CheckedPasses right;
  return {spoil(right.by_adjoint), spoil(right.by_tangent)};
}

TEST(CheckExcuses, WrongDerivativesAreFound) {
  Checked checked;
  const DerivativeCheck right = checked.with({});
  ASSERT_TRUE(right.passed) << right.message;
  Random random(45);
  for (int planted_so_far = 0; planted_so_far < 20;) {
    const auto row = random.below(static_cast<int>(right.by_adjoint.rows()));
    const auto column = random.below(static_cast<int>(right.by_adjoint.cols()));
    if (std::abs(right.by_adjoint(row, column)) < 0.1 * right.by_adjoint.col(column).cwiseAbs().maxCoeff()) continue;
    const int kind = planted_so_far++ % 5;
    SCOPED_TRACE("way " + std::to_string(kind) + " at (" + std::to_string(row) + ", " + std::to_string(column) + ")");
    const DerivativeCheck wrong = checked.with(planted(kind, row, column));
    EXPECT_FALSE(wrong.passed) << wrong.message;
  }
}

// All of them change with rounding.
TEST(CheckExcuses, NothingIsJudgedWhereAllMayBeRounding) {
  const auto noisy = [](CheckedPasses::Pass pass) {
    return [=](const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion, const RowValues& rows) {
      return Eigen::MatrixXd((1 + 0.5 * noiseOf(rows.values)) * pass(problem, values, motion, rows));
    };
  };
  const CheckedPasses right;
  Checked checked;
  const DerivativeCheck check = checked.with({noisy(right.by_adjoint), noisy(right.by_tangent)});
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.message.rfind("Not compared: ", 0), 0u) << check.message;
}

TEST(CheckExcuses, HowManyAreTooMany) {
  using Counts = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;
  Counts counts = Counts::Constant(10, 10, true);
  Eigen::MatrixXd excused = Eigen::MatrixXd::Zero(10, 10);
  EXPECT_EQ(tooManyExcused(counts, excused), "");
  for (int k = 0; k < 5; ++k) excused(k, k) = 1e-5;
  EXPECT_EQ(tooManyExcused(counts, excused), "");
  excused(5, 5) = 1e-5;
  EXPECT_NE(tooManyExcused(counts, excused), "");
  excused.setZero();
  counts.row(3).setConstant(false);
  counts(3, 7) = true, excused(3, 7) = 1e-5;
  EXPECT_NE(tooManyExcused(counts, excused).find("all of 1 row"), std::string::npos) << tooManyExcused(counts, excused);
  counts(3, 7) = false;
  EXPECT_EQ(tooManyExcused(counts, excused), "");
  excused(0, 0) = 0.02;
  EXPECT_NE(tooManyExcused(counts, excused), "");
}

}  // namespace
}  // namespace carom::test
