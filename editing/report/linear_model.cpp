// SPDX-License-Identifier: MIT
#include "editing/report/linear_model.hpp"

#include <algorithm>

#include "adjoint/base/errors.h"
#include "editing/solve/bounded_least_squares.hpp"

namespace carom::editing_detail {

using Eigen::Index;
using Eigen::VectorXd;

LinearModel::LinearModel(const EditEvaluator& evaluator, EditPoint& point) {
  if (!evaluator.differentiate(point)) throw NotComputable(point.not_computable);
  const EditProblem& problem = evaluator.problem();
  J = *point.row_jacobian;
  const Index m = J.rows(), n = J.cols();
  value.resize(m), low.resize(m), high.resize(m);
  for (Index i = 0; i < m; ++i) {
    const Row& row = problem.constraints.rows()[static_cast<std::size_t>(i)];
    value[i] = point.rows.values[i] / row.scale;
    low[i] = row.lower / row.scale, high[i] = row.upper / row.scale;
  }
  lower = evaluator.lower() - point.changes, upper = evaluator.upper() - point.changes;
  for (Index j = 0; j < n && j < problem.controls.size(); ++j) {
    const Variable& v = problem.controls.variables()[static_cast<std::size_t>(j)];
    const double far = kLargestStep * problem.controls.controls()[static_cast<std::size_t>(v.control)].control.weight;
    lower[j] = std::clamp(lower[j], -far, 0.0), upper[j] = std::clamp(upper[j], 0.0, far);
  }
}

std::vector<int> LinearModel::allRows() const {
  std::vector<int> rows(static_cast<std::size_t>(J.rows()));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<int>(i);
  return rows;
}

// A row in a range is J s + value = z with z in the range: z is another number.
LinearModel::Nearest LinearModel::nearest(const std::vector<int>& rows) const {
  const Index n = J.cols(), m = static_cast<Index>(rows.size());
  Index ranges = 0;
  for (int i : rows) ranges += low[i] < high[i];
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(m, n + ranges);
  VectorXd b(m), least(n + ranges), most(n + ranges);
  least.head(n) = lower, most.head(n) = upper;
  Index z = n;
  for (Index k = 0; k < m; ++k) {
    const int i = rows[static_cast<std::size_t>(k)];
    A.row(k).head(n) = J.row(i);
    b[k] = value[i] - (low[i] < high[i] ? 0 : low[i]);
    if (!(low[i] < high[i])) continue;
    // measured from the value, so that what is within its range starts at 0
    b[k] = 0;
    A(k, z) = -1;
    least[z] = low[i] - value[i], most[z] = high[i] - value[i];
    ++z;
  }
  const VectorXd x = boundedLeastSquares(A, b, least, most);
  return {x.head(n), (A * x + b).norm()};
}

void LinearModel::extend(const Eigen::MatrixXd& columns, const VectorXd& least, const VectorXd& most) {
  const Index n = J.cols(), k = columns.cols();
  J.conservativeResize(Eigen::NoChange, n + k);
  J.rightCols(k) = columns;
  lower.conservativeResize(n + k), upper.conservativeResize(n + k);
  lower.tail(k) = least, upper.tail(k) = most;
}

std::vector<std::vector<int>> conflictsIn(const LinearModel& linear, double met, std::size_t most) {
  std::vector<std::vector<int>> conflicts;
  std::vector<int> rows = linear.allRows();
  while (conflicts.size() < most && !rows.empty()) {
    const double off = linear.nearest(rows).off;
    if (off <= met) break;
    // What the rest still misses by a good part of it is a contradiction without the row that was left out.
    const double limit = std::max(met, 0.1 * off);
    std::vector<int> kept = rows;
    for (std::size_t k = 0; k < kept.size();) {
      std::vector<int> without = kept;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
      if (linear.nearest(without).off > limit) {
        kept = std::move(without);
      } else {
        ++k;
      }
    }
    std::erase_if(rows, [&](int row) { return std::find(kept.begin(), kept.end(), row) != kept.end(); });
    conflicts.push_back(std::move(kept));
  }
  return conflicts;
}

}  // namespace carom::editing_detail
