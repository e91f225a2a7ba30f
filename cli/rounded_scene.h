// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom::cli {

/// The numbers of a scene changed by a few roundings, the same ones for the same `draw`; zeros stay. Every third one is turned,
/// too, which what lands flat may not survive.
Scene rounded(Scene scene, unsigned draw);

}  // namespace carom::cli
