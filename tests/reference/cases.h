// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "adjoint/scene/scene.h"

namespace carom::reference {

/// A scene on which the product is held to the reference, and what is expected to happen in it. A new shape, impact law
/// or control is covered by a row more.
struct Case {
  const char* name;
  Scene (*scene)();
  double duration;
  std::vector<ImpactMode> modes;      ///< of the impacts, in order of time
  std::vector<const char*> features;  ///< words that must stand in the features of each impact
};
const std::vector<Case>& cases();

/// The same scene with its bodies listed backwards.
Scene reversed(Scene scene);

Body makeBody(const std::string& name, const Shape& shape, const std::string& material);
Body makeFixed(const std::string& name, const Shape& shape, const std::string& material);
Body makeFloor(const std::string& material);

}  // namespace carom::reference
