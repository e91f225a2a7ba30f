// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/control.h"

namespace carom::studio {

/// The throw of a body, cheap beside the numbers that a person let vary.
inline std::vector<Control> throwOf(const std::string& body) {
  constexpr double kWeight = 0.2;
  return {velocity(body).weighted(kWeight), angularVelocity(body).weighted(kWeight)};
}

}  // namespace carom::studio
