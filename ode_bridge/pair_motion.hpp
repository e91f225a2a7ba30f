// SPDX-License-Identifier: MIT
#pragma once

#include "ode_bridge/ground.hpp"
#include "ode_bridge/narrow_phase.hpp"
#include "ode_bridge/separation.hpp"

namespace carom::ode_bridge_detail {

/// The two bodies of a search, their solids and motions.
struct PairMotion {
  int a, b;
  const FeatureGeometry& geometry;
  const NarrowPhase& narrow_phase;
  Arc& arc_a;
  Arc& arc_b;
  WorkCount* work = nullptr;  ///< where steps are counted
  GroundBeside ground = {};   ///< beside the one that is fixed
};

}  // namespace carom::ode_bridge_detail
