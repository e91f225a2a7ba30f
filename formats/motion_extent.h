#pragma once

#include "adjoint/motion.h"

namespace carom {

using Extent = Eigen::AlignedBox3d;

/// The time at which arc k of a body ends: the start of the next one, or the end of the motion.
double arcEnd(const Motion& motion, int body, int k);

/// Smallest axis-aligned box around the path of a body's origin, exact for parabolas.
Extent pathExtent(const Motion& motion, int body);

/// Box around everything that moves, shapes included; a unit box at the origin when nothing does.
Extent motionExtent(const Motion& motion);

}  // namespace carom
