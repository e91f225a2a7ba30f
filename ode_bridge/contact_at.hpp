// SPDX-License-Identifier: MIT
#pragma once

#include "ode_bridge/gaps.hpp"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// The contact of two features.
ContactPoint contactAt(const Placed& a, const Placed& b, const FeaturePair& f);

/// Length below which a separation cannot be told from contact, for bodies where these are, m.
double touchTolerance(const Placed& a, const Placed& b);

}  // namespace carom::ode_bridge_detail
