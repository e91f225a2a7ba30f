// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "adjoint/motion/motion.h"

/// Checks of a motion against physics. Internal to editing/; see Certificate for what each says.
namespace carom::editing_detail {

double energyDrift(const Motion& motion, int samples);
double energyGain(const Motion& motion);
/// `between` is called between parts of the work; what it throws ends it.
std::optional<double> deepestPenetration(const Motion& motion, int samples, const std::function<void()>& between = [] {});

}  // namespace carom::editing_detail
