// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/real.h"

// Derivatives of replays: one-sided differences in 50 digits.

namespace carom::reference {

/// Width of the differences. Their error is half of it times a second derivative, and that of rounding (1e-50, which
/// grows along the motion) divided by it. The series' own error is smooth in what they start from: its difference is as
/// small as itself.
inline const Real kNudge("1e-20");
/// For differences of differences: half the width of central ones along a direction, of those that each is made of.
inline const Real kAlong("1e-12"), kBeside("1e-19");

/// Vector of the small rotation that takes R_0 to R_1.
inline RVec rotationBetween(const RMat& R_0, const RMat& R_1) {
  RVec sum;
  for (int j = 0; j < 3; ++j) sum = sum + cross(R_0.column[j], R_1.column[j]);
  return (Real(1) / 2) * sum;
}

}  // namespace carom::reference
