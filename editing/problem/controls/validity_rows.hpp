// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "editing/problem/controls/control_set.hpp"

namespace carom::editing_detail {

/// Validity is kept this far from its limit, so that what a solver's tolerance lets through is still valid.
inline constexpr double kValidityMargin = 1e-7;

/// What physics demands of several controls together, as dimensionless rows h(values) >= 0:
///  - moments of inertia that vary:  h_i = (I_j + I_k - I_i) / (sum of the moments at the start)
///  - tilts:                         h = 1 - (alpha^2 + beta^2) / cone^2
/// What it demands of one number alone is a bound of its Variable.
class ValidityRows {
 public:
  explicit ValidityRows(const ControlSet& controls);

  int size() const { return static_cast<int>(rows_.size()); }
  /// Index of the control of a row, and what it demands: "triangle inequality of inertia of 'hat', Ixx", "cone of ...".
  int control(int row) const { return rows_[static_cast<std::size_t>(row)].control; }
  std::string describe(const ControlSet& controls, int row) const;
  Eigen::VectorXd evaluate(const ControlSet& controls, const Eigen::VectorXd& values) const;
  /// By the control values, size() x controls.size().
  Eigen::MatrixXd jacobian(const ControlSet& controls, const Eigen::VectorXd& values) const;
  /// Second derivatives of weights . h by the control values.
  Eigen::MatrixXd hessian(const ControlSet& controls, const Eigen::VectorXd& weights) const;

 private:
  struct Row {
    int control = -1;
    int moment = -1;  ///< the i of a row of moments; -1 for a cone
    double scale = 1;
  };
  /// Derivative of h by the three numbers of the owner of the row's control, and h itself.
  static double value(const Row& row, const Eigen::VectorXd& slots);
  static Eigen::VectorXd gradient(const Row& row, const Eigen::VectorXd& slots);

  std::vector<Row> rows_;
};

}  // namespace carom::editing_detail
