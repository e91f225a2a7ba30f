// SPDX-License-Identifier: MIT
#include "editing/solve/bounded_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "adjoint/numeric/decompositions.hpp"

namespace carom::editing_detail {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

enum class At : char { free, lower, upper };

struct ActiveSet {
  const Eigen::MatrixXd& A;
  const VectorXd &b, &lower, &upper;
  std::vector<At> at;
  VectorXd x;

  std::vector<Index> freeOnes() const {
    std::vector<Index> free;
    for (Index j = 0; j < x.size(); ++j)
      if (at[static_cast<std::size_t>(j)] == At::free) free.push_back(j);
    return free;
  }

  // The minimum over the free numbers, bounds left aside.
  VectorXd minimum(const std::vector<Index>& free) const {
    VectorXd fixed = x;
    for (Index j : free) fixed[j] = 0;
    const Index m = A.rows(), n = static_cast<Index>(free.size());
    Eigen::MatrixXd M(m + n, n);
    M.topRows(m) = A(Eigen::all, free);
    M.bottomRows(n) = kSmallness * Eigen::MatrixXd::Identity(n, n);
    VectorXd rhs = VectorXd::Zero(m + n);
    rhs.head(m) = -(A * fixed + b);
    return adjoint_detail::PivotingQr(M).solve(rhs);
  }

  // Goes towards `wanted` as far as the bounds allow; true when it gets there.
  bool step(const std::vector<Index>& free, const VectorXd& wanted) {
    double length = 1;
    Index stop = -1;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Index j = free[k];
      const double to = wanted[static_cast<Index>(k)], by = to - x[j];
      const double limit = to < lower[j] ? (lower[j] - x[j]) / by : to > upper[j] ? (upper[j] - x[j]) / by : 1;
      if (limit < length) length = std::max(0.0, limit), stop = j;
    }
    for (std::size_t k = 0; k < free.size(); ++k) x[free[k]] += length * (wanted[static_cast<Index>(k)] - x[free[k]]);
    if (stop < 0) return true;
    const bool low = wanted[std::find(free.begin(), free.end(), stop) - free.begin()] < lower[stop];
    at[static_cast<std::size_t>(stop)] = low ? At::lower : At::upper;
    x[stop] = low ? lower[stop] : upper[stop];
    return false;
  }

  // Frees the number that would gain most by leaving its bound; false when none would.
  bool release() {
    const VectorXd slope = A.transpose() * (A * x + b) + kSmallness * kSmallness * x;
    Index best = -1;
    double most = 1e-14 * (1 + b.norm());
    for (Index j = 0; j < x.size(); ++j) {
      const At where = at[static_cast<std::size_t>(j)];
      if (where == At::free || lower[j] == upper[j]) continue;
      const double gain = where == At::lower ? -slope[j] : slope[j];
      if (gain > most) most = gain, best = j;
    }
    if (best >= 0) at[static_cast<std::size_t>(best)] = At::free;
    return best >= 0;
  }
};

}  // namespace

VectorXd boundedLeastSquares(const Eigen::MatrixXd& A, const VectorXd& b, const VectorXd& lower,
                             const VectorXd& upper) {
  const Index n = A.cols();
  ActiveSet set{A, b, lower, upper, std::vector<At>(static_cast<std::size_t>(n), At::free), VectorXd::Zero(n)};
  set.x = set.x.cwiseMax(lower).cwiseMin(upper);
  for (Index j = 0; j < n; ++j)
    if (lower[j] == upper[j]) set.at[static_cast<std::size_t>(j)] = At::lower;
  // Every round lowers the sum of squares, so that no active set comes again; rounding may still go in circles.
  const int most = 10 * static_cast<int>(n) + 10;
  for (int i = 0; i < most; ++i) {
    const std::vector<Index> free = set.freeOnes();
    if (!free.empty() && !set.step(free, set.minimum(free))) continue;
    if (!set.release()) break;
  }
  return set.x;
}

}  // namespace carom::editing_detail
