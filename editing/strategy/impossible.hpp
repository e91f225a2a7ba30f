// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/edit_search.hpp"

/// Constraints that no motion meets. Internal to editing/.
namespace carom::editing_detail {

/// Why the constraints cannot be met whatever impacts come, as far as that is proven; else empty:
/// - nothing varies;
/// - one number is held at two values, or in ranges that have nothing in common;
/// - only what acts in impacts varies (materials, tilts), and a number is read before the first impact that it acts in.
std::string whyImpossible(const EditSearch& search, const EditPoint& start);

}  // namespace carom::editing_detail
