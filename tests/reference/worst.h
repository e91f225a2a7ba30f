#pragma once

#include <cmath>

namespace carom::reference {

/// Keeps the larger of two errors; a NaN, once seen, stays.
inline void keepWorst(double& worst, double error) {
  if (!std::isnan(worst) && !(error <= worst)) worst = error;
}

}  // namespace carom::reference
