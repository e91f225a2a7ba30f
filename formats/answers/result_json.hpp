// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::formats_detail {

/// The answer of `carom simulate --json`: status, message, end (s, up to which the motion is known), overlaps {bodies,
/// depth, parted: s, or null} (see Motion::overlaps), every event, and the state of every body at the given times;
/// without times, at the end of the motion. An event of several contacts gives its first one in "bodies", "point",
/// "normal" and "elasticity", and all in "contacts". "margin" is Margins::smallest(). Numbers that are not finite are
/// written as null. Throws InputError for a time outside [0, end].
std::string motionJson(const Motion& motion, const std::vector<double>& at);

}  // namespace carom::formats_detail
