// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/tangent.h"
#include "adjoint/motion/motion.h"

/// Derivatives of the geometry of two bodies as functionals of their states.
namespace carom::editing_detail {

/// Pose of the shape of a body at an instant.
Pose shapePoseAt(const Motion& motion, int body, const Instant& at);

/// One row of a ContactJacobian (0: gap, 1 to 3: normal, 4 to 6: point) as seeds of the states of a and b.
std::vector<StateSeed> seedsOfPair(const ContactJacobian& J, int row, int a, int b, const Instant& at);

/// The rates of two states as those of their poses and dimensions.
PairTangent tangentOfPair(const BodyStateRate& of_a, const BodyStateRate& of_b);

}  // namespace carom::editing_detail
