// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace carom::editing_detail {

/// A row of a Jacobian that is a combination of others: row = sum_k weights[k] * independent[k].
struct DependentRow {
  int row = -1;
  std::vector<int> on;      ///< rows with a weight that counts
  Eigen::VectorXd weights;  ///< one for each entry of RowSplit::independent
};

struct RowSplit {
  std::vector<int> independent;  ///< as many as the rank, in increasing order
  std::vector<int> zero;         ///< nothing influences them
  std::vector<DependentRow> dependent;
};

/// Rows below this norm (of a dimensionless Jacobian) count as zero.
inline constexpr double kZeroRow = 1e-12;
/// Pivots below this fraction of the largest, of rows brought to unit length, count as zero.
inline constexpr double kRankTolerance = 1e-9;

/// Splits the rows of a dimensionless Jacobian by a rank-revealing QR of its transpose, rows brought to unit length.
RowSplit splitRows(const Eigen::MatrixXd& jacobian);
/// Looks at some of the rows alone; indices in the result are those of the whole Jacobian.
RowSplit splitRows(const Eigen::MatrixXd& jacobian, const std::vector<int>& rows);

/// Orthonormal basis, in columns, of the directions that change no row to first order (J z = 0); may have none. Pivots
/// below `tolerance` times the largest count as zero.
Eigen::MatrixXd nullSpace(const Eigen::MatrixXd& jacobian, double tolerance = kRankTolerance);

/// By how much a dependent row is out of reach while the independent ones are at their targets, to first order: its
/// residual less the same combination of theirs.
double contradictionOf(const RowSplit& split, const DependentRow& row, const Eigen::VectorXd& residuals);

}  // namespace carom::editing_detail
