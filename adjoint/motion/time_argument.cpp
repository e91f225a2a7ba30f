// SPDX-License-Identifier: MIT
#include "adjoint/motion/time_argument.hpp"

#include "adjoint/base/refuse.hpp"

namespace carom::adjoint_detail {

void checkTime(const char* where, const Motion& motion, double t) {
  if (t >= 0 && t <= motion.end) return;
  refuse(where, "found the time ", t, ", expected one in [0, ", motion.end, "]",
         motion.status == MotionStatus::complete ? "" : "; ", motion.status == MotionStatus::complete ? "" : motion.message);
}

}  // namespace carom::adjoint_detail
