#pragma once

#include <string>

#include "adjoint/motion.h"
#include "formats/document.h"

namespace carom {

/// Draws the motion to scale as an SVG picture: a side view and a top view with axes in metres, fixed bodies, paths
/// (exact parabolas), ghosts at regular times, numbered impacts, nails as green hoops with the nailed pose, legend and
/// title. `before`, if any, is drawn as dashed grey paths. Throws InputError naming the path or the body.
void exportSvg(const std::string& path, const Document& document, const Motion& motion, const Motion* before = nullptr);

}  // namespace carom
