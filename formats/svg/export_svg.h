// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom {

/// The file of a picture is never larger, whatever it shows.
inline constexpr std::size_t kMostSvgBytes = 500'000;

/// The motion drawn to scale as an SVG picture: a side view and a top view with axes in metres, fixed bodies, paths
/// (exact parabolas), ghosts at regular times, numbered impacts, nails as green hoops with the nailed pose, title, and
/// a legend of all that is drawn. `before`, if any, is drawn as dashed grey paths. What is too much to be told apart is
/// summed: impacts as dots whose size says how many there are, paths of bodies beyond the first as a shade. Throws
/// InputError naming the body. The same motion gives the same file.
std::string svgText(const std::string& title, const Document& document, const Motion& motion,
                    const Motion* before = nullptr);

}  // namespace carom
