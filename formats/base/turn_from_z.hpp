// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// The shortest turn that takes +z to a direction. What Eigen does of nearly opposite directions takes four seconds to
/// compile: once here, and not where it is called.
Quat turnFromZ(const Vec3& direction);

}  // namespace carom::formats_detail
