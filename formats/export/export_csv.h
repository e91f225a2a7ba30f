// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "adjoint/motion/motion.h"

namespace carom {

/// The motion as a table, one row per (time, moving body): at k / rate seconds, at the end of the motion, and twice
/// at each event of the body (`kind` before and after), of which `event` gives the number among all events of the
/// motion, as `carom simulate --json` lists them, 1 = the first. The last column, `path`, is the ArcKind of the body,
/// empty where the motion ends. The header row has columns and units; numbers have 17 significant digits; text is
/// quoted as in RFC 4180. Throws InputError when the rate [1/s] is not positive.
std::string csvText(const Motion& motion, double rate = 60);

}  // namespace carom
