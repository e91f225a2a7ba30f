// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::charts {

/// Of every body of a scene, in its order; fixed bodies' entries mean nothing.
using States = std::vector<BodyState>;

/// How far the worst point of the worst moving body is from where it should be, in metres: |dx| + reach * angle, where
/// `reach` is the bounding radius. The turn of a ball counts nothing where there is no friction. NaN where a number is.
double stateError(const Scene& scene, const States& found, const States& exact);

States statesAt(const Motion& motion, double t);

/// Kinetic and potential energy of all moving bodies, J.
double energy(const Scene& scene, const States& states);
States startOf(const Scene& scene);

/// Depth of the deepest overlap of a ball or a box with the planes of the scene, m; negative: apart.
double depthInPlanes(const Scene& scene, const States& states);

}  // namespace carom::charts
