// SPDX-License-Identifier: MIT
#include "editing/solve/dependence.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/numeric/decompositions.hpp"

namespace carom::editing_detail {
namespace {

/// Weights below this are rounding.
constexpr double kSmallWeight = 1e-7;

}  // namespace

RowSplit splitRows(const Eigen::MatrixXd& jacobian) {
  std::vector<int> all(static_cast<std::size_t>(jacobian.rows()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return splitRows(jacobian, all);
}

RowSplit splitRows(const Eigen::MatrixXd& jacobian, const std::vector<int>& wanted) {
  RowSplit split;
  std::vector<int> rows;  // that are not zero
  for (int i : wanted) {
    // Written so that a row with a NaN counts as one that nothing is known about.
    if (!(jacobian.row(i).norm() > kZeroRow)) {
      split.zero.push_back(i);
    } else {
      rows.push_back(i);
    }
  }
  if (rows.empty()) return split;

  const int count = static_cast<int>(rows.size());
  Eigen::MatrixXd unit_rows(jacobian.cols(), count);
  Eigen::VectorXd norms(count);
  for (int k = 0; k < count; ++k) {
    norms[k] = jacobian.row(rows[k]).norm();
    unit_rows.col(k) = jacobian.row(rows[k]).transpose() / norms[k];
  }
  const adjoint_detail::PivotingQr qr(unit_rows, kRankTolerance);
  const int rank = static_cast<int>(qr.rank());
  const Eigen::VectorXi order = qr.order();

  // Independent rows in increasing order, so that the result does not depend on the order of the pivots.
  std::vector<int> pivots(order.data(), order.data() + rank);
  std::sort(pivots.begin(), pivots.end());
  for (int k : pivots) split.independent.push_back(rows[k]);
  if (rank == count) return split;

  Eigen::MatrixXd basis(jacobian.cols(), rank);
  for (int k = 0; k < rank; ++k) basis.col(k) = unit_rows.col(pivots[k]);
  const adjoint_detail::HouseholderQr basis_qr(basis);
  for (int j = rank; j < count; ++j) {
    DependentRow dependent;
    const int k = order[j];
    dependent.row = rows[k];
    dependent.weights = basis_qr.solve(unit_rows.col(k));
    for (int i = 0; i < rank; ++i) {
      if (std::abs(dependent.weights[i]) > kSmallWeight) dependent.on.push_back(split.independent[i]);
      dependent.weights[i] *= norms[k] / norms[pivots[i]];
    }
    split.dependent.push_back(std::move(dependent));
  }
  std::sort(split.dependent.begin(), split.dependent.end(),
            [](const DependentRow& a, const DependentRow& b) { return a.row < b.row; });
  return split;
}

Eigen::MatrixXd nullSpace(const Eigen::MatrixXd& jacobian, double tolerance) {
  const Eigen::Index n = jacobian.cols();
  if (jacobian.size() == 0) return Eigen::MatrixXd::Identity(n, n);
  const adjoint_detail::PivotingQr qr(jacobian.transpose(), tolerance);
  return qr.Q().rightCols(n - qr.rank());
}

double contradictionOf(const RowSplit& split, const DependentRow& row, const Eigen::VectorXd& residuals) {
  double combined = 0;
  for (std::size_t k = 0; k < split.independent.size(); ++k) {
    combined += row.weights[static_cast<Eigen::Index>(k)] * residuals[split.independent[k]];
  }
  return residuals[row.row] - combined;
}

}  // namespace carom::editing_detail
