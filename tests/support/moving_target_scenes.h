// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/dot_product_scenes.h"

namespace carom::test {

/// Each shows an impact on a kinematic body or on a surface that moves.
std::vector<DotProductScene> movingTargetScenes();

}  // namespace carom::test
