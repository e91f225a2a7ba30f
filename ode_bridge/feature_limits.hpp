// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/body_geometry.h"
#include "ode_bridge/solids/solid.hpp"

namespace carom::ode_bridge_detail {

/// Adds the conditions under which a contact stays with one feature of a solid (see FeatureLimit). `point` is the
/// contact point in the solid's axes; `sign` is 1 where the normal of the contact points out of this solid (it is body
/// b of the pair) and -1 where it points into it (body a).
void addFeatureLimits(const Solid& solid, Family family, int index, const Vec3& point, double sign, int body,
                      std::vector<FeatureLimit>& limits);

}  // namespace carom::ode_bridge_detail
