// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/derivative_tape.h"

/// Derivatives over a stretch of an arc, whatever the body does on it: forward and reverse.
namespace carom::adjoint_detail {

/// Tangent of the state at time t, fixed, from that at the start of the arc.
StateDerivative arcTangent(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& dstart,
                           const SceneTangent& dscene, const BodyModelDerivative& dmodel);
/// Its adjoint: from that at t to that at the start; adds to those of the scene and of the model.
StateDerivative arcPullback(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& end_bar,
                            SceneGradient& scene_bar, BodyModelDerivative& model_bar);

}  // namespace carom::adjoint_detail
