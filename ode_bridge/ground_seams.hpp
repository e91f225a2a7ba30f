// SPDX-License-Identifier: MIT
#pragma once

#include "ode_bridge/gaps.hpp"
#include "ode_bridge/ground.hpp"

namespace carom::ode_bridge_detail {

/// Whether a contact at an edge, a vertex or a rim of a fixed body is none, because fixed bodies beside it go on there:
/// one of them lies in the way of what would push along the normal; or a face goes on in one plane, so that what touches
/// there touches the faces. A convex edge of all of them together stays. `flush`: how far faces may be from one plane, m.
bool isGroundSeam(const Placed& a, const Placed& b, const FeaturePair& f, const GroundBeside& ground, double flush);

}  // namespace carom::ode_bridge_detail
