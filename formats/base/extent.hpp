// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// An axis-aligned box in the world, m; empty where it holds nothing.
using Extent = Eigen::AlignedBox3d;

}  // namespace carom::formats_detail
