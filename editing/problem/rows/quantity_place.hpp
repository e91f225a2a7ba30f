// SPDX-License-Identifier: MIT
#pragma once

#include "editing/motion_function.h"

namespace carom::editing_detail {

/// Where and when a quantity is read.
struct QuantityPlace {
  const Motion& motion;
  int body;
  int relative_to;  ///< -1: the world
  Instant at;
  double time;   ///< s, of the instant
  double scale;  ///< of the row, see Row::scale
  int to = -1;   ///< the other body of a distance
  double from = 0, until = 0;  ///< s, of a quantity of a span
  int component = 0;  ///< of a quantity of three numbers
  int with = -1;      ///< at an impact: the body that is met; -1: any
};

}  // namespace carom::editing_detail
