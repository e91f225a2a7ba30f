// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/edit_evaluator.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// " That is as near as ...", where a point misses its constraints by no more than the last digits of the controls move
/// them; else empty.
std::string lastDigits(const EditEvaluator& evaluator, EditPoint& point);

}  // namespace carom::editing_detail
