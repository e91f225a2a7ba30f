// SPDX-License-Identifier: MIT
#include "editing/solve/edit_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/second_order/second_order.h"
#include "editing/problem/hessian.hpp"

namespace carom::editing_detail {
EditProgram::EditProgram(EditSearch& search, Eigen::VectorXd start, std::vector<int> rows, const std::string* signature)
    : search_(search),
      start_(std::move(start)),
      rows_(std::move(rows)),
      equations_(rows_.size()),
      signature_(signature) {
  const std::vector<int>& ranges = search.problem().constraints.ranges();
  rows_.insert(rows_.end(), ranges.begin(), ranges.end());
}

// A range is measured from one of its limits, an equation from its target.
double EditProgram::anchor(int row) const {
  const Row& r = search_.problem().constraints.rows()[static_cast<std::size_t>(row)];
  return std::isfinite(r.lower) ? r.lower : r.upper;
}

int EditProgram::constraints() const { return static_cast<int>(rows_.size()) + search_.problem().validity.size(); }

NonlinearProgram::Bounds EditProgram::bounds() const {
  const Eigen::Index rows = static_cast<Eigen::Index>(rows_.size());
  Bounds bounds{search_.lower(), search_.upper(), Eigen::VectorXd::Zero(constraints()),
                Eigen::VectorXd::Zero(constraints())};
  for (std::size_t k = equations_; k < rows_.size(); ++k) {
    const Row& row = search_.problem().constraints.rows()[static_cast<std::size_t>(rows_[k])];
    const auto at = static_cast<Eigen::Index>(k);
    bounds.g_lower[at] = (row.lower - anchor(rows_[k])) / row.scale;
    bounds.g_upper[at] = (row.upper - anchor(rows_[k])) / row.scale;
  }
  bounds.g_lower.tail(constraints() - rows).setConstant(kValidityMargin);
  bounds.g_upper.tail(constraints() - rows).setConstant(kInfinity);
  return bounds;
}

EditPointPtr EditProgram::at(const Eigen::VectorXd& x) {
  EditPointPtr point = search_.evaluate(x);
  return point && (!signature_ || point->signature == *signature_) ? point : nullptr;
}

bool EditProgram::objective(const Eigen::VectorXd& x, double& f) {
  f = search_.problem().objective(x);
  return true;
}

bool EditProgram::gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) {
  df_dx = x;
  df_dx.tail(search_.problem().times()).setZero();
  return true;
}

bool EditProgram::constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
  const EditPointPtr point = at(x);
  if (!point) return false;
  g.resize(constraints());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const double scale = search_.problem().constraints.rows()[static_cast<std::size_t>(rows_[k])].scale;
    g[static_cast<Eigen::Index>(k)] =
        k < equations_ ? point->rows.scaled[rows_[k]] : (point->rows.values[rows_[k]] - anchor(rows_[k])) / scale;
  }
  g.tail(point->validity.size()) = point->validity;
  return true;
}

bool EditProgram::jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& dg_dx) {
  const EditPointPtr point = at(x);
  if (!point) return false;
  search_.differentiate(*point);
  dg_dx.resize(constraints(), x.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    dg_dx.row(static_cast<Eigen::Index>(k)) = point->row_jacobian->row(rows_[k]);
  }
  dg_dx.bottomRows(point->validity.size()) = *point->validity_jacobian;
  return true;
}

// PSB: the symmetric matrix nearest to B (in the Frobenius norm) with B' s = y:
//   B' = B + (e s^T + s e^T)/s.s - (e.s) s s^T/(s.s)^2,  e = y - B s.
void EditProgram::learnCurvature(const Eigen::VectorXd& x, const Eigen::MatrixXd& dg_dx) {
  if (curvature_.empty()) {
    curvature_.assign(static_cast<std::size_t>(constraints()), Eigen::MatrixXd::Zero(x.size(), x.size()));
  } else if (x != last_x_) {
    const Eigen::VectorXd s = x - last_x_;
    const double s2 = s.squaredNorm();
    for (std::size_t k = 0; k < curvature_.size(); ++k) {
      const Eigen::Index i = static_cast<Eigen::Index>(k);
      const Eigen::VectorXd e = (dg_dx.row(i) - last_dg_dx_.row(i)).transpose() - curvature_[k] * s;
      curvature_[k] += (e * s.transpose() + s * e.transpose()) / s2 - e.dot(s) / (s2 * s2) * s * s.transpose();
    }
  }
  last_x_ = x;
  last_dg_dx_ = dg_dx;
}

bool EditProgram::hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                          Eigen::MatrixXd& h) {
  const EditPointPtr point = at(x);
  if (!point) return false;
  if (search_.options().second_derivatives == SecondDerivatives::exact && hasSecondOrder(point->motion)) {
    const EditProblem& problem = search_.problem();
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(problem.constraints.size());
    for (std::size_t k = 0; k < rows_.size(); ++k)
      weights[rows_[k]] += multipliers[static_cast<Eigen::Index>(k)] /
                           problem.constraints.rows()[static_cast<std::size_t>(rows_[k])].scale;
    h = rowsHessian(problem, x, point->motion, point->rows, weights) +
        validityHessian(problem, x, multipliers.tail(problem.validity.size()));
    h.diagonal().head(problem.controls.size()).array() += factor;
    return true;
  }
  Eigen::MatrixXd dg_dx;
  if (!jacobian(x, dg_dx)) return false;
  learnCurvature(x, dg_dx);
  h = factor * Eigen::MatrixXd::Identity(x.size(), x.size());
  h.diagonal().tail(search_.problem().times()).setZero();
  for (std::size_t k = 0; k < curvature_.size(); ++k) {
    h += multipliers[static_cast<Eigen::Index>(k)] * curvature_[k];
  }
  return true;
}

}  // namespace carom::editing_detail
