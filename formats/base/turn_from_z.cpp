// SPDX-License-Identifier: MIT
#include "formats/base/turn_from_z.hpp"

namespace carom::formats_detail {

Quat turnFromZ(const Vec3& direction) { return Quat::FromTwoVectors(Vec3::UnitZ(), direction); }

}  // namespace carom::formats_detail
