// SPDX-License-Identifier: MIT
#include "editing/solve/step_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace carom::editing_detail {

Indices allIndices(Eigen::Index count) {
  Indices all(static_cast<std::size_t>(count));
  for (Eigen::Index j = 0; j < count; ++j) all[static_cast<std::size_t>(j)] = j;
  return all;
}

double StepBounds::allowed(Eigen::Index j, const Eigen::VectorXd& d) const {
  return std::clamp(at[j] + d[j], lower[j], upper[j]) - at[j];
}

Indices StepBounds::stop(const Eigen::VectorXd& d, Indices& free, Eigen::VectorXd& fixed) const {
  Indices still_free, stopped;
  for (const Eigen::Index j : free) {
    const double to = at[j] + d[j], inside = std::clamp(to, lower[j], upper[j]);
    if (std::abs(to - inside) <= 1e-15 * (1 + std::abs(at[j]))) {
      still_free.push_back(j);
    } else {
      fixed[j] = inside - at[j];
      stopped.push_back(j);
    }
  }
  free = std::move(still_free);
  return stopped;
}

}  // namespace carom::editing_detail
