// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/dot_product_scenes.h"

namespace carom::test {

/// Each shows a path in lasting contact, or an event on it.
std::vector<DotProductScene> lastingScenes();

/// With contact that lasts, but no groups.
Motion playLasting(const Scene& scene, double duration, const std::vector<Asked>& asked = {});

/// Gravity of 9.81 m/s^2 on a slope that falls along x, in the axes of the slope.
Vec3 downSlope(double degrees);

}  // namespace carom::test
