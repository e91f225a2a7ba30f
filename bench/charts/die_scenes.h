// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "adjoint/scene/scene.h"

namespace carom::charts {

/// A die of 16 mm that is thrown onto a floor, spinning. The same seed gives the same throw.
Scene thrownDie(std::uint64_t seed, double elasticity, double friction);
/// The same, with an elasticity of 0, 0.2, 0.5 or 0.85 and friction of 0.1, 0.4 or 1 by the seed.
Scene anyDie(std::uint64_t seed);

}  // namespace carom::charts
