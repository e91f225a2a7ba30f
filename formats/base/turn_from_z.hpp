// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// The shortest turn that takes +z to a direction: Quat::FromTwoVectors(Vec3::UnitZ(), direction) to the last bit,
/// without the singular value decomposition that Eigen has there, which takes four seconds to compile.
Quat turnFromZ(const Vec3& direction);

}  // namespace carom::formats_detail
