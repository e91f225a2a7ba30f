// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"
#include "studio/page_files.h"

namespace carom::studio {

/// A motion of a document, as both are shown; neither is kept.
struct ShownMotion {
  const Document& document;
  const Motion& motion;
};

/// One HTML file that shows a motion as the page of the studio does, with the same modules, and asks for nothing:
/// template, styles, modules and frames are in it, the last three compressed. `before`: a motion that it is compared
/// with; null: none. Throws InputError where the scenes have other bodies.
std::string motionPage(const PageFiles& files, const std::string& title, const ShownMotion& now,
                       const ShownMotion* before);

}  // namespace carom::studio
