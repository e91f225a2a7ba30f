// SPDX-License-Identifier: MIT
#pragma once

#include "ode_bridge/first_impact.hpp"

namespace carom::ode_bridge_detail {

struct Root {
  double time = 0;
  bool approaching = false;
};

/// Newton on the gap of frozen features from a time t at which it is within rounding of zero, where the bodies are `a`
/// and `b`; never before `from`.
Root refineRoot(const PairMotion& pair, const FeaturePair& features, double from, double t, const Placed& a,
                const Placed& b);

}  // namespace carom::ode_bridge_detail
