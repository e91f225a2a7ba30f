// SPDX-License-Identifier: MIT
#include "editing/solve/edit_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/second_order/second_order.h"
#include "editing/problem/hessian.hpp"

namespace carom::editing_detail {
EditProgram::EditProgram(EditEvaluator& evaluator, Eigen::VectorXd start, std::vector<int> rows, const std::string* signature)
    : evaluator_(evaluator),
      start_(std::move(start)),
      rows_(std::move(rows)),
      equations_(rows_.size()),
      signature_(signature) {
  const std::vector<int>& ranges = evaluator.problem().constraints.ranges();
  rows_.insert(rows_.end(), ranges.begin(), ranges.end());
}

// A range is measured from one of its limits, an equation from its target.
double EditProgram::anchor(int row) const {
  const Row& r = evaluator_.problem().constraints.rows()[static_cast<std::size_t>(row)];
  return std::isfinite(r.lower) ? r.lower : r.upper;
}

int EditProgram::constraints() const { return static_cast<int>(rows_.size()) + evaluator_.problem().validity.size(); }

NonlinearProgram::Bounds EditProgram::bounds() const {
  const Eigen::Index rows = static_cast<Eigen::Index>(rows_.size());
  Bounds bounds{evaluator_.lower(), evaluator_.upper(), Eigen::VectorXd::Zero(constraints()),
                Eigen::VectorXd::Zero(constraints())};
  for (std::size_t k = equations_; k < rows_.size(); ++k) {
    const Row& row = evaluator_.problem().constraints.rows()[static_cast<std::size_t>(rows_[k])];
    const auto at = static_cast<Eigen::Index>(k);
    bounds.g_lower[at] = (row.lower - anchor(rows_[k])) / row.scale;
    bounds.g_upper[at] = (row.upper - anchor(rows_[k])) / row.scale;
  }
  bounds.g_lower.tail(constraints() - rows).setConstant(kValidityMargin);
  bounds.g_upper.tail(constraints() - rows).setConstant(kInfinity);
  return bounds;
}

EditPointPtr EditProgram::at(const Eigen::VectorXd& x) {
  EditPointPtr point = evaluator_.evaluate(x);
  return point && (!signature_ || point->signature == *signature_) ? point : nullptr;
}

bool EditProgram::objective(const Eigen::VectorXd& x, double& f) {
  const EditProblem& problem = evaluator_.problem();
  if (!problem.constraints.objective()) {
    f = problem.change(x);
    return true;
  }
  const EditPointPtr point = at(x);
  if (point) f = point->objective;
  return point != nullptr;
}

bool EditProgram::gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) {
  const EditProblem& problem = evaluator_.problem();
  df_dx = x;
  df_dx.tail(problem.times()).setZero();
  if (!problem.constraints.objective()) return true;
  const EditPointPtr point = at(x);
  if (!point) return false;
  differentiateObjective(problem, *point);
  df_dx = problem.changeWeight() * df_dx + *point->objective_gradient;
  return true;
}

bool EditProgram::constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
  const EditPointPtr point = at(x);
  if (!point) return false;
  g.resize(constraints());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const double scale = evaluator_.problem().constraints.rows()[static_cast<std::size_t>(rows_[k])].scale;
    g[static_cast<Eigen::Index>(k)] =
        k < equations_ ? point->rows.scaled[rows_[k]] : (point->rows.values[rows_[k]] - anchor(rows_[k])) / scale;
  }
  g.tail(point->validity.size()) = point->validity;
  return true;
}

bool EditProgram::jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& dg_dx) {
  const EditPointPtr point = at(x);
  if (!point) return false;
  if (!evaluator_.differentiate(*point)) return false;
  dg_dx.resize(constraints(), x.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    dg_dx.row(static_cast<Eigen::Index>(k)) = point->row_jacobian->row(rows_[k]);
  }
  dg_dx.bottomRows(point->validity.size()) = *point->validity_jacobian;
  return true;
}

// Of the constraints, then of an objective of one's own without the change.
bool EditProgram::gradients(const Eigen::VectorXd& x, Eigen::MatrixXd& df_dx) {
  if (!jacobian(x, df_dx)) return false;
  const EditProblem& problem = evaluator_.problem();
  if (!problem.constraints.objective()) return true;
  const EditPointPtr point = at(x);
  differentiateObjective(problem, *point);
  df_dx.conservativeResize(constraints() + 1, Eigen::NoChange);
  df_dx.bottomRows(1) = point->objective_gradient->transpose();
  return true;
}

// PSB: the symmetric matrix nearest to B (in the Frobenius norm) with B' s = y:
//   B' = B + (e s^T + s e^T)/s.s - (e.s) s s^T/(s.s)^2,  e = y - B s.
void EditProgram::learnCurvature(const Eigen::VectorXd& x, const Eigen::MatrixXd& df_dx) {
  if (curvature_.empty()) {
    curvature_.assign(static_cast<std::size_t>(df_dx.rows()), Eigen::MatrixXd::Zero(x.size(), x.size()));
  } else if (x != last_x_) {
    const Eigen::VectorXd s = x - last_x_;
    const double s2 = s.squaredNorm();
    for (std::size_t k = 0; k < curvature_.size(); ++k) {
      const Eigen::Index i = static_cast<Eigen::Index>(k);
      const Eigen::VectorXd e = (df_dx.row(i) - last_df_dx_.row(i)).transpose() - curvature_[k] * s;
      curvature_[k] += (e * s.transpose() + s * e.transpose()) / s2 - e.dot(s) / (s2 * s2) * s * s.transpose();
    }
  }
  last_x_ = x;
  last_df_dx_ = df_dx;
}

bool EditProgram::hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                          Eigen::MatrixXd& h) {
  const EditPointPtr point = at(x);
  if (!point) return false;
  const EditProblem& problem = evaluator_.problem();
  h = Eigen::MatrixXd::Zero(x.size(), x.size());
  h.diagonal().head(problem.controls.size()).setConstant(factor * problem.changeWeight());
  Eigen::VectorXd factors(constraints() + (problem.constraints.objective() ? 1 : 0));
  factors.head(constraints()) = multipliers;
  if (problem.constraints.objective()) factors.tail(1).setConstant(factor);
  const bool exact = evaluator_.options().second_derivatives == SecondDerivatives::exact;
  return exact && hasSecondOrder(point->motion) ? addExact(x, *point, factors, h) : addLearnt(x, factors, h);
}

bool EditProgram::addExact(const Eigen::VectorXd& x, const EditPoint& point, const Eigen::VectorXd& factors,
                           Eigen::MatrixXd& h) {
  const EditProblem& problem = evaluator_.problem();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(problem.constraints.size());
  Eigen::VectorXd learnt = Eigen::VectorXd::Zero(factors.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const auto row = static_cast<std::size_t>(rows_[k]);
    if (point.rows.notes[row].second_order) {
      weights[rows_[k]] += factors[at] / problem.constraints.rows()[row].scale;
    } else {
      learnt[at] = factors[at], has_learnt_ = true;
    }
  }
  double of_objective = 0;
  if (const BoundFunction* own = problem.constraints.objective()) {
    const double factor = factors.tail(1)[0];
    if (point.rows.objective->second_order) {
      of_objective = factor / own->function.scale;
    } else {
      learnt.tail(1)[0] = factor, has_learnt_ = true;
    }
  }
  const Eigen::VectorXd of_validity = factors.segment(static_cast<Eigen::Index>(rows_.size()), problem.validity.size());
  h += rowsHessian(problem, x, point.motion, point.rows, weights, of_objective) +
       validityHessian(problem, x, of_validity);
  return !has_learnt_ || addLearnt(x, learnt, h);
}

bool EditProgram::addLearnt(const Eigen::VectorXd& x, const Eigen::VectorXd& factors, Eigen::MatrixXd& h) {
  Eigen::MatrixXd df_dx;
  if (!gradients(x, df_dx)) return false;
  learnCurvature(x, df_dx);
  for (std::size_t k = 0; k < curvature_.size(); ++k) h += factors[static_cast<Eigen::Index>(k)] * curvature_[k];
  return true;
}

}  // namespace carom::editing_detail
