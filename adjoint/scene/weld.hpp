// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// For each point the number of the first one at the same place: equal coordinates, -0 being 0.
std::vector<int> firstOfEqual(const std::vector<Vec3>& points);

}  // namespace carom::adjoint_detail
