// SPDX-License-Identifier: MIT
#include "tests/random/nonnegative.h"

#include <Eigen/QR>
#include <algorithm>
#include <optional>
#include <vector>

namespace carom::test {

using Eigen::Index;

double leastLeft(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  std::vector<Index> in;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  for (int round = 0; round < 2000; ++round) {
    const Eigen::VectorXd left = b - A * x, pull = A.transpose() * left;
    if (left.norm() <= 1e-12 * b.norm()) break;
    Index best = -1;
    for (Index i = 0; i < A.cols(); ++i)
      if (std::ranges::find(in, i) == in.end() && (best < 0 || pull[i] > pull[best])) best = i;
    if (best < 0 || !(pull[best] > 1e-10 * left.norm())) break;
    in.push_back(best);
    while (!in.empty()) {
      Eigen::MatrixXd part(A.rows(), static_cast<Index>(in.size()));
      for (std::size_t c = 0; c < in.size(); ++c) part.col(static_cast<Index>(c)) = A.col(in[c]);
      const Eigen::VectorXd to = part.completeOrthogonalDecomposition().solve(b);
      double step = 1;
      std::optional<std::size_t> leaves;
      for (std::size_t c = 0; c < in.size(); ++c)
        if (const double from = x[in[c]], there = to[static_cast<Index>(c)]; there <= 0 && from <= step * (from - there))
          step = from > there ? from / (from - there) : 0, leaves = c;
      for (std::size_t c = 0; c < in.size(); ++c) x[in[c]] += step * (to[static_cast<Index>(c)] - x[in[c]]);
      if (!leaves) break;
      x[in[*leaves]] = 0;
      in.erase(in.begin() + static_cast<std::ptrdiff_t>(*leaves));
    }
  }
  return (b - A * x).norm() / b.norm();
}

}  // namespace carom::test
