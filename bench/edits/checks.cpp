// SPDX-License-Identifier: MIT
#include "bench/edits/checks.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "editing/problem/jacobian.hpp"

namespace carom::bench {

using namespace editing_detail;

namespace {

Eigen::MatrixXd dimensionless(const EditProblem& problem, const Eigen::VectorXd& changes, Eigen::MatrixXd J) {
  J = J * problem.controls.valueRates(changes).asDiagonal();
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i) /= problem.constraints.rows()[static_cast<std::size_t>(i)].scale;
  return J;
}

bool hasIndependentRows(Eigen::MatrixXd J) {
  if (J.rows() == 0) return true;
  if (J.rows() > J.cols() || !J.allFinite()) return false;
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i).normalize();
  if (!J.allFinite()) return false;
  return Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues().minCoeff() >= TaskLimits::kSmallestSingular;
}

}  // namespace

bool isPlain(const Motion& motion, std::size_t count) {
  if (motion.events.size() < count) return false;
  return std::all_of(
      motion.events.begin(), motion.events.begin() + static_cast<std::ptrdiff_t>(count),
      [](const Event& e) { return e.contacts.size() == 1 && e.margins.smallest() >= TaskLimits::kSmallestMargin; });
}

bool meets(const Motion& motion, std::size_t count, const std::string& body, const std::string& other) {
  const int a = bodyIndex(*motion.scene, body), b = bodyIndex(*motion.scene, other);
  count = std::min(count, motion.events.size());
  return std::any_of(motion.events.begin(), motion.events.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Event& e) { return e.touches(a, b); });
}

double durationFor(const std::vector<Constraint>& constraints, double last) {
  const bool impact =
      std::any_of(constraints.begin(), constraints.end(), [](const Constraint& c) { return c.at.impact > 0; });
  return impact ? 1.2 * last + 0.05 : last + 0.01;
}

double smallestMiss(const ConstraintSet& constraints, const RowValues& rows) {
  Eigen::VectorXd misses = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(constraints.constraints().size()));
  for (int i = 0; i < constraints.size(); ++i) {
    double& miss = misses[constraints.rows()[static_cast<std::size_t>(i)].constraint];
    miss = std::max(miss, std::abs(rows.scaled[i]));
  }
  return misses.minCoeff();
}

double largestMiss(const RowValues& rows) { return rows.scaled.size() > 0 ? rows.scaled.cwiseAbs().maxCoeff() : 0; }

double changeOf(const Variable& v, double value) {
  return v.logarithmic ? std::log(value / v.start) / v.scale : (value - v.start) / v.scale;
}

bool isReachable(Task& task, const Eigen::VectorXd& hidden_values, ContactSource& contacts) {
  const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
  const RowsAndJacobian at = evaluateByAdjoint(problem, hidden_values);
  if (!at.rows.available) return false;
  Eigen::VectorXd changes(hidden_values.size());
  for (Eigen::Index j = 0; j < changes.size(); ++j)
    changes[j] = changeOf(problem.controls.variables()[static_cast<std::size_t>(j)], hidden_values[j]);
  if (at.rows.scaled.size() == 0) return true;  // impacts alone are held
  const Eigen::MatrixXd J = dimensionless(problem, changes, at.jacobian);
  const std::vector<int>& equations = problem.constraints.equations();
  if (!hasIndependentRows(J(equations, Eigen::all))) return false;
  task.growth = J.cwiseAbs().maxCoeff();
  return task.growth <= TaskLimits::kLargestGrowth;
}

}  // namespace carom::bench
