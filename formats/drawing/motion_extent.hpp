// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"
#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {

/// Bodies of a scene that are not fixed.
std::size_t movingCount(const Scene& scene);

/// The time at which arc k of a body ends: the start of the next one, or the end of the motion.
double arcEnd(const Motion& motion, int body, int k);

/// Centre of mass of a body at a time; of a fixed body its shape's origin.
Vec3 centreAt(const Motion& motion, int body, double t);

/// Smallest axis-aligned box around the path of a body's centre of mass, exact for parabolas; of a slide round a bend a
/// little larger.
Extent pathExtent(const Motion& motion, int body);

/// Box around everything that moves, shapes included; a unit box at the origin when nothing does.
Extent motionExtent(const Motion& motion);

}  // namespace carom::formats_detail
