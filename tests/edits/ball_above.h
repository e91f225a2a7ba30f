// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom::test {

/// A ball of 0.2 kg, 1 m above a floor without friction.
Scene ballAbove(const Vec3& velocity);

}  // namespace carom::test
