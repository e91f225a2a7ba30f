// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/derivative_tape.h"

/// Checks of what derivatives are asked for. Each throws InputError, `where` being the function.
namespace carom::adjoint_detail {

/// Its body, its instant and its weights.
void checkSeed(const char* where, const Motion& motion, const StateSeed& seed);
/// As many entries as the scene has, all finite.
void checkDirection(const char* where, const Scene& scene, const SceneTangent& direction);

}  // namespace carom::adjoint_detail
