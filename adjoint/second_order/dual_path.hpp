// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/second_order/lanes.hpp"

/// Paths in lasting contact in dual numbers: what arc_pass.hpp has in doubles.
namespace carom::adjoint_detail {

/// d(state)/dt at time t, which moves along, on arc k of a body, a path.
StateBar pathRate(const Lanes& lanes, int body, int k, const Num& t);

/// From the adjoint at time t to that at the start of the arc; adds to those of the scene and of the model.
StateBar pathPullback(const Lanes& lanes, int body, int k, const Num& t, const StateBar& end_bar, SceneBar& scene_bar,
                      ModelBar& model_bar);

}  // namespace carom::adjoint_detail
