// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/contact/path_sensitivity.hpp"
#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/pair_rules.hpp"

/// Derivatives over a stretch of an arc, whatever the body does on it: forward and reverse.
namespace carom::adjoint_detail {

/// A path in lasting contact from its start to one time, linearised, and how its inputs come from the scene.
struct PathLinearization {
  PathSensitivity<double> sensitivity;
  int material_body = -1, material_face = -1;
  Rule<double> friction;  // of the materials, the body's first

  PathInputsDerivative<double> inputs(const ContactPath& path, const SceneTangent& dscene,
                                      const BodyModelDerivative& dmodel) const;
  void inputsPullback(const ContactPath& path, const PathInputsDerivative<double>& bar, SceneGradient& scene_bar,
                      BodyModelDerivative& model_bar) const;
};

std::shared_ptr<const PathLinearization> linearizedPath(const Motion& motion, const ContactPath& path, double elapsed);

/// Tangent of the state at time t, fixed, from that at the start of the arc.
StateDerivative arcTangent(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& dstart,
                           const SceneTangent& dscene, const BodyModelDerivative& dmodel);
/// Its adjoint: from that at t to that at the start; adds to those of the scene and of the model.
StateDerivative arcPullback(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& end_bar,
                            SceneGradient& scene_bar, BodyModelDerivative& model_bar);

}  // namespace carom::adjoint_detail
