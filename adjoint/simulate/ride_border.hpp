// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/carrier.hpp"
#include "adjoint/motion/body_geometry.h"

namespace carom::adjoint_detail {

/// The first time, from the start of the carrier on, at which a place on the surface of one of its bodies comes to a border
/// of that; infinite: never.
double timeAtBorder(const Carrier& carrier, const Carrier::Part& part, const FeatureLimit& limit, const Vec3& place);

}  // namespace carom::adjoint_detail
