// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Whether doubles are too short for an impact: what an impulse gives its bodies, in speed and in spin at the contacts,
/// differs by more than 1e3: a velocity may lose that many digits, a derivative twice as many. Numbers of 32 digits take
/// over then, for the impact and all of its derivatives.
bool needsDoubleDouble(const Event& event, const std::vector<BodyModel>& models);

/// The same of an event that was solved, or is to be.
inline bool usesDoubleDouble(const Event& event, const std::vector<BodyModel>& models) {
  return event.wide || needsDoubleDouble(event, models);
}

}  // namespace carom::adjoint_detail
