// SPDX-License-Identifier: MIT
#include "editing/problem/jacobian.hpp"

#include <limits>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/derivative/tangent.h"
#include "editing/problem/rows/nearest_instants.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

Eigen::MatrixXd unknown(const EditProblem& problem) {
  return Eigen::MatrixXd::Constant(problem.constraints.size(), problem.controls.size(),
                                   std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void askControls(const ControlSet& controls, Reliability& reliability) {
  for (const BoundControl& c : controls.controls()) {
    if (c.kind->is_friction) reliability.askFriction(static_cast<int>(c.owner.material));
    if (c.kind->is_velocity) reliability.askVelocity(c.owner.body);
    if (c.kind->owner == OwnerKind::immovable_body) reliability.askSurface(c.owner.body);
    if (c.owner.body >= 0) reliability.askPlace(c.owner.body);
  }
}

void doubt(const std::string& why, Reliability& reliability) {
  if (why.empty()) return;
  reliability.smallest_margin = 0;
  if (!reliability.reliable) return;
  reliability.reliable = false;
  reliability.message = why;
}

Eigen::MatrixXd jacobianByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows, std::vector<Reliability>* reliability) {
  Eigen::MatrixXd J = unknown(problem);
  if (reliability) reliability->assign(static_cast<std::size_t>(J.rows()), {});
  DerivativeTape tape(motion, problem.leaver());
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    if (rows.seeds[i].empty()) continue;
    problem.leaveIfAbandoned();
    const SceneGradient gradient = adjoint(tape, rows.seeds[i], reliability ? &(*reliability)[i] : nullptr);
    J.row(i) = problem.controls.gather(gradient, values).transpose();
    if (reliability) askControls(problem.controls, (*reliability)[i]);
    if (reliability) doubt(rows.notes[i].doubt, (*reliability)[i]);
    if (!reliability || J.row(i).allFinite()) continue;
    (*reliability)[i].reliable = false;
    (*reliability)[i].message =
        "the derivative of " + problem.constraints.describeRow(static_cast<int>(i)) + " is beyond the range of doubles";
  }
  return J;
}

namespace {

/// One forward pass a column.
void putTangents(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion, const RowValues& rows,
                 Eigen::MatrixXd& J) {
  DerivativeTape tape(motion, problem.leaver());
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    problem.leaveIfAbandoned();
    const SceneTangent direction = problem.controls.scatter(Eigen::VectorXd::Unit(J.cols(), j), values);
    const MotionTangent moved = tangent(tape, direction);
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
      if (rows.seeds[i].empty()) continue;
      J(i, j) = 0;
      for (const StateSeed& seed : rows.seeds[i]) J(i, j) += moved.at(seed.body, seed.at).dot(seed);
    }
  }
}

}  // namespace

Eigen::MatrixXd jacobianByTangent(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows) {
  Eigen::MatrixXd J = unknown(problem);
  putTangents(problem, values, motion, rows, J);
  return J;
}

namespace {

/// The time of a constraint between two times moves with the controls so that its rows miss least: what they change by
/// along the motion is taken out of their derivatives (variable projection without the second derivatives of rows).
void followTimes(const ConstraintSet& set, const Motion& motion, const RowValues& rows, Eigen::MatrixXd& J) {
  for (const FreeTime& span : set.freeTimes()) {
    std::vector<int> of_it;
    for (int i = 0; i < set.size(); ++i) {
      const Row& row = set.rows()[static_cast<std::size_t>(i)];
      const bool pulls = !row.isRange() || rows.residuals[i] != 0;
      if (row.constraint == span.constraint && !row.overSpan() && pulls) of_it.push_back(i);
    }
    if (of_it.empty() || !movesInSpan(span, motion, rows.seeds[static_cast<std::size_t>(of_it[0])][0].at)) continue;
    Eigen::VectorXd in_time(static_cast<Eigen::Index>(of_it.size()));
    Eigen::MatrixXd by_controls(in_time.size(), J.cols());
    for (Eigen::Index k = 0; k < in_time.size(); ++k) {
      const int i = of_it[static_cast<std::size_t>(k)];
      const double scale = set.rows()[static_cast<std::size_t>(i)].scale;
      in_time[k] = 0;
      for (const StateSeed& seed : rows.seeds[static_cast<std::size_t>(i)]) in_time[k] += timeDerivative(motion, seed) / scale;
      by_controls.row(k) = J.row(i) / scale;
    }
    const double squares = in_time.squaredNorm();
    if (!(squares > 0)) continue;
    const Eigen::RowVectorXd rate = -(in_time.transpose() * by_controls) / squares;
    for (Eigen::Index k = 0; k < in_time.size(); ++k) {
      const int i = of_it[static_cast<std::size_t>(k)];
      J.row(i) += set.rows()[static_cast<std::size_t>(i)].scale * in_time[k] * rate;
    }
  }
}

}  // namespace

Eigen::MatrixXd softJacobian(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                             const RowValues& rows) {
  const ConstraintSet& set = problem.soft.set();
  const Eigen::Index n = problem.controls.size();
  const Eigen::VectorXd values = problem.valuesOf(unknowns);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(set.size(), n);
  if (n < set.size()) {
    putTangents(problem, values, motion, rows, J);
  } else {
    DerivativeTape tape(motion, problem.leaver());
    for (Eigen::Index i = 0; i < J.rows(); ++i)
      J.row(i) = problem.controls.gather(adjoint(tape, rows.seeds[i]), values).transpose();
  }
  if (!set.freeTimes().empty()) followTimes(set, motion, rows, J);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(set.size(), problem.unknowns());
  all.leftCols(n) = J * problem.controls.valueRates(unknowns.head(n)).asDiagonal();
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    const bool within = row.isRange() && rows.residuals[i] == 0;
    all.row(i) *= within ? 0 : problem.soft.weights()[i] / row.scale;
  }
  return all;
}

Eigen::MatrixXd jacobianByTimes(const EditProblem& problem, const Motion& motion, const RowValues& rows) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(problem.constraints.size(), problem.times());
  for (int k = 0; k < problem.times(); ++k) {
    for (int i = 0; i < problem.constraints.size(); ++i) {
      const Row& row = problem.constraints.rows()[i];
      if (row.constraint != problem.constraints.freeTimes()[k].constraint || row.overSpan()) continue;
      for (const StateSeed& seed : rows.seeds[i]) J(i, k) += timeDerivative(motion, seed);
    }
  }
  return J;
}

RowsAndJacobian evaluateByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values) {
  RowsAndJacobian out;
  out.motion = simulateAt(problem, values, problem.horizon);
  out.rows = problem.constraints.evaluate(out.motion);
  out.jacobian = jacobianByAdjoint(problem, values, out.motion, out.rows, &out.reliability);
  return out;
}

RowsAndJacobian evaluateByTangent(const EditProblem& problem, const Eigen::VectorXd& values) {
  RowsAndJacobian out;
  out.motion = simulateAt(problem, values, problem.horizon);
  out.rows = problem.constraints.evaluate(out.motion);
  out.jacobian = jacobianByTangent(problem, values, out.motion, out.rows);
  return out;
}

}  // namespace carom::editing_detail
