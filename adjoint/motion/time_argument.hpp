// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Throws InputError at `where` unless 0 <= t <= motion.end.
void checkTime(const char* where, const Motion& motion, double t);

}  // namespace carom::adjoint_detail
