// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"
#include "editing/solve/nonlinear_program.hpp"
#include "editing/solve/progress_monitor.hpp"

/// An edit as a nonlinear program. Internal to editing/.
namespace carom::editing_detail {

/// minimise 1/2 |y|^2, or an objective of one's own (EditProblem::objective), subject to chosen rows = 0, ranges,
/// validity >= 0, bounds; y the unknowns of EditProblem, of which the free times cost nothing.
///
/// The objective's second derivative is the identity; those of the rows are exact (hessian.hpp), or learnt from their
/// gradients, row by row, by Powell's symmetric rank-one-two (PSB) secant update, or left to the solver. Where exact ones
/// are asked for, the rows that have none (RowNote::second_order) are learnt, and they alone. So is an objective of
/// one's own.
class EditProgram final : public NonlinearProgram {
 public:
  /// `rows` are of those that hold a number. With a signature, points whose motion has another impact sequence are
  /// refused.
  EditProgram(EditEvaluator& evaluator, Eigen::VectorXd start, std::vector<int> rows, const std::string* signature);

  int variables() const override { return static_cast<int>(start_.size()); }
  int constraints() const override;
  Bounds bounds() const override;
  Eigen::VectorXd start() const override { return start_; }
  bool objective(const Eigen::VectorXd& x, double& f) override;
  bool gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) override;
  bool constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) override;
  bool jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& dg_dx) override;
  bool hasHessian() const override { return evaluator_.options().second_derivatives != SecondDerivatives::limited_memory; }
  bool hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
               Eigen::MatrixXd& h) override;
  /// Also stops where the violation hardly falls any more: at the boundary of the impact sequence, mostly.
  bool iteration(const Iteration& i) override { return monitor_.allows(evaluator_, i); }

 private:
  EditPointPtr at(const Eigen::VectorXd& x);
  double anchor(int row) const;
  bool addExact(const Eigen::VectorXd& x, const EditPoint& point, const Eigen::VectorXd& factors, Eigen::MatrixXd& h);
  bool gradients(const Eigen::VectorXd& x, Eigen::MatrixXd& df_dx);
  void learnCurvature(const Eigen::VectorXd& x, const Eigen::MatrixXd& df_dx);
  bool addLearnt(const Eigen::VectorXd& x, const Eigen::VectorXd& factors, Eigen::MatrixXd& h);

  EditEvaluator& evaluator_;
  Eigen::VectorXd start_;
  std::vector<int> rows_;  // equations first, then ranges
  std::size_t equations_;  // how many
  const std::string* signature_;
  std::vector<Eigen::MatrixXd> curvature_;  // of each constraint, and of an objective of one's own
  bool has_learnt_ = false;  // at some point so far there were no second derivatives of something
  ProgressMonitor monitor_;
  Eigen::VectorXd last_x_;
  Eigen::MatrixXd last_df_dx_;
};

}  // namespace carom::editing_detail
