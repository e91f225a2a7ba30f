// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::formats_detail {

/// The answer of `carom simulate --json`: status, message, end (s, up to which the motion is known), overlaps {bodies,
/// depth, parted: s, or null} (see Motion::overlaps), every event, the lasting contacts {bodies, kind: rest, slide,
/// roll or pivot, features, from, to} (see LastingContact), and the state of every body at the given times; without times, at the
/// end of the motion. An event has its "kind" (see EventKind), whether it "counts" as a reported impact, the "cause" of
/// a transition, and where a capture has it "settles_at" (s). One of several contacts gives the first in "bodies",
/// "point", "normal" and "elasticity", and all in "contacts". A transition, which has no impulse, has no "mode" and no
/// margins. "margin" is Margins::smallest(). Numbers that are not finite are written as null. Throws InputError for a
/// time outside [0, end].
std::string motionJson(const Motion& motion, const std::vector<double>& at);

}  // namespace carom::formats_detail
