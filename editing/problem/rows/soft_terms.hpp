// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "editing/problem/rows/constraint_rows.hpp"

/// Soft constraints: terms of the objective. Internal to editing/.
namespace carom::editing_detail {

/// The rows of the soft constraints (Constraint::soft) with their weights w: they add 1/2 |W r|^2 to the objective, r the
/// errors in natural scales.
class SoftTerms {
 public:
  /// Throws InputError naming "/constraints/<i>/soft": a weight that is not positive, a hit, a sequence; and what
  /// ConstraintSet throws.
  SoftTerms(const Scene& scene, const std::vector<Constraint>& constraints, double duration);

  bool empty() const { return set_->size() == 0; }
  const ConstraintSet& set() const { return *set_; }
  /// Reads all rows in a motion, those of constraints between two times where they are missed least.
  RowValues evaluate(const Motion& motion) const;
  /// Of each row, w.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// w r of each row.
  Eigen::VectorXd weighted(const RowValues& rows) const { return weights_.cwiseProduct(rows.scaled); }

  /// 1/2 |W r|^2 as an objective, and beside it an objective of the caller's own by its scale. Empty where there is
  /// neither.
  OwnFunctions beside(const Scene& scene, OwnFunctions own, double duration) const;

 private:
  std::shared_ptr<const ConstraintSet> set_;  // objectives that are handed out read it
  Eigen::VectorXd weights_;
};

}  // namespace carom::editing_detail
