// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

/// What rounding leaves of gaps and speeds, for the general search and that of balls alike. Internal to ode_bridge/.
namespace carom::ode_bridge_detail {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

/// An approach slower than this share of the speeds involved cannot be told from none.
inline constexpr double kStill = 1e-12;

/// A gap of less than this share of the size of positions cannot be told from contact: positions of size 1 are known to
/// 1e-16, and a separation is a sum of some ten of them.
inline constexpr double kTouch = 1e-13;

}  // namespace carom::ode_bridge_detail
