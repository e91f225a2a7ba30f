// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/motion/motion.h"

/// Checks of a motion against physics. Internal to editing/; see Certificate for what each says.
namespace carom::editing_detail {

double energyDrift(const Motion& motion, int samples);
double energyGain(const Motion& motion);
std::optional<double> deepestPenetration(const Motion& motion, int samples);

}  // namespace carom::editing_detail
