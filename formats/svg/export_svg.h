// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom {

/// Upper bound on the size of a picture file.
inline constexpr std::size_t kMostSvgBytes = 500'000;

/// The motion drawn to scale as an SVG picture: a side view and a top view with axes in metres, fixed bodies, paths
/// (exact parabolas), ghosts at regular times, numbered impacts, nails as green hoops with the nailed pose, title,
/// and a legend of all that is drawn. `before`, if any, is drawn as dashed grey paths. Crowded pictures are
/// aggregated: impacts as dots sized by count, paths of many bodies as a density map. Throws InputError naming the
/// body. The same motion gives the same file.
std::string svgText(const std::string& title, const Document& document, const Motion& motion,
                    const Motion* before = nullptr);

}  // namespace carom
