// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace carom::reference {

inline constexpr double kStateTolerance = 1e-12;     ///< of the component, at least of 1
inline constexpr double kTimeTolerance = 1e-13;      ///< s
inline constexpr double kGradientTolerance = 1e-9;   ///< of the column's scale
inline constexpr double kSmallestScale = 1e-2;       ///< of a column, so that those that are exactly 0 can be compared

/// Keeps the larger of two errors; a NaN, once seen, stays.
inline void keepWorst(double& worst, double error) {
  if (!std::isnan(worst) && !(error <= worst)) worst = error;
}

}  // namespace carom::reference
