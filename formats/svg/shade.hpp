// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/svg/cells.hpp"
#include "formats/svg/looks.hpp"

namespace carom::formats_detail {

/// Opacities of the shades of a crowd; each stands for twice as many bodies as the one before.
inline constexpr std::array kShades = {0.10, 0.19, 0.30, 0.43, 0.58};

/// The crowd as squares, the darker the more bodies are in them on average over the motion.
struct ShadePlan {
  double cell = 0;                                             ///< px
  double largest = 0;                                          ///< bodies in a square, of both views
  std::vector<std::array<std::string, kShades.size()>> paths;  ///< of each view, for each shade
};

/// Its squares are larger where small ones would take more than `most` bytes.
ShadePlan planShade(const Motion& motion, const std::vector<View>& views, const PathPlan& paths, std::size_t most);

}  // namespace carom::formats_detail
