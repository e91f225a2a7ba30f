// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/svg/layers.hpp"

namespace carom::formats_detail {

/// A side view (z up, the horizontal axis with most travel to the right) above a top view at the same scale, for a
/// picture of the given width whose first panel starts below `top`.
std::vector<View> layOutViews(const Picture& picture, double width, double top);

/// Room below a panel for the numbers and the name of its axis.
inline constexpr double kAxisRoom = 44;

}  // namespace carom::formats_detail
