// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

/// Steps that stay within bounds. Internal to editing/.
namespace carom::editing_detail {

using Indices = std::vector<Eigen::Index>;

/// 0 to count - 1.
Indices allIndices(Eigen::Index count);

/// Where a step begins, and the bounds of where it ends.
struct StepBounds {
  const Eigen::VectorXd &at, &lower, &upper;

  /// d[j], or as much of it as the bounds allow.
  double allowed(Eigen::Index j, const Eigen::VectorXd& d) const;
  /// Free numbers that the step d takes over their bounds stop there: they leave `free`, and `fixed` has what they have
  /// taken. Whoever calls lets the others make up for it, in another round. Returns those that stopped.
  Indices stop(const Eigen::VectorXd& d, Indices& free, Eigen::VectorXd& fixed) const;
};

}  // namespace carom::editing_detail
