// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"
#include "bench/edits/dice.h"
#include "bench/edits/wanted.h"

namespace carom::bench {

/// A random scene in which "thrown" (of a meeting also "other") flies over a floor, in some scenes between walls and
/// past a fixed block. Bodies of 5 to 30 cm, elasticities of 0.5 to 0.95, friction up to 0.6. Bodies may overlap at the
/// start: such draws are to be thrown away.
Scene drawThrow(Family family, Dice& dice);

}  // namespace carom::bench
