// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/tangent.h"
#include "adjoint/motion/motion.h"

namespace carom::editing_detail {

using namespace adjoint_detail;

/// The state of body a as seen from body b, in the axes of b's shape, with d = p_a - p_b:
///   position R_b^T d,  orientation R_b^T R_a,  velocity R_b^T (v_a - v_b),  angular velocity R_b^T (w_a - w_b).
/// The velocities are differences of those in world axes: b's own turning is not taken off.
BodyState seenFrom(const BodyState& a, const BodyState& b);

/// A functional of the state seen, `seed`, as functionals of both bodies. Body and instant are copied to the first;
/// those of the second are left to the caller. The time weight stays with the first.
struct SeedPair {
  StateSeed of_a, of_b;
};
SeedPair seenFromPullback(const BodyState& a, const BodyState& b, const StateSeed& seed);

/// Rates of both as the states of the bodies change, and with them the functional.
BodyStateRate seenFromRate(const BodyState& a, const BodyState& b, const BodyStateRate& da, const BodyStateRate& db);
SeedPair seenFromPullbackRate(const BodyState& a, const BodyState& b, const BodyStateRate& da, const BodyStateRate& db,
                              const StateSeed& seed, const StateSeed& dseed);

}  // namespace carom::editing_detail
