// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::explore_detail {

/// From three numbers uniform in (0, 1) an orientation uniform on SO(3) (K. Shoemake, Graphics Gems III, 1992), with w
/// >= 0.
Quat orientationOf(double u, double v, double w);

}  // namespace carom::explore_detail
