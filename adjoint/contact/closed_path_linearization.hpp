// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "adjoint/contact/path_sensitivity.hpp"
#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/motion/motion.h"
#include "adjoint/motion/pair_rules.hpp"

namespace carom::adjoint_detail {

/// From the adjoint of a path's inputs to the scene's and the model's, in any kind of number; `normal` and `friction`:
/// of the face, and of the two materials, the body's first.
template <class S>
void pathInputsPullback(const Scene& scene, const ContactPath& path, const V3<S>& normal, const Rule<S>& friction,
                        const PathInputsDerivative<S>& bar, SceneDerivativeOf<S>& scene_bar,
                        BodyModelDerivativeOf<S>& model_bar) {
  scene_bar.gravity += bar.gravity;
  // bar.(theta x n)
  scene_bar.bodies[static_cast<std::size_t>(path.face)].orientation += normal.cross(bar.normal);
  for (const auto& [body, by] : {std::pair<int, S>(path.body, friction.by_a), std::pair<int, S>(path.face, friction.by_b)})
    if (const int m = materialIndexOf(scene, body); m >= 0)
      scene_bar.materials[static_cast<std::size_t>(m)].friction += by * bar.friction;
  model_bar.mass += bar.mass;
  model_bar.inertia += bar.inertia;
  model_bar.products += bar.products;
  if (path.reach_rates.size() > 0)
    scene_bar.bodies[static_cast<std::size_t>(path.body)].size +=
        bar.reach * path.reach_rates.transpose().template cast<S>();
}

/// Linearised on first use, and how its inputs come from the scene. Keeps references to the motion and the path.
class ClosedPathLinearization final : public TrajectoryLinearization {
 public:
  /// `k`: the arc of its body.
  ClosedPathLinearization(const Motion& motion, const ContactPath& path, int k, double elapsed);

  StateDerivative tangent(const StateDerivative& dstart, const SceneTangent& dscene,
                          const BodyModelDerivative& dmodel) const override;
  StateDerivative pullback(const StateDerivative& end_bar, SceneGradient& scene_bar,
                           BodyModelDerivative& model_bar) const override;

 private:
  const PathSensitivity<double>& sensitivity(bool turns) const;
  PathSensitivity<double> closedForm(bool orientation) const;
  PathInputsDerivative<double> inputs(const SceneTangent& dscene, const BodyModelDerivative& dmodel) const;
  void addSpin(PathSensitivity<double>& sensitivity) const;

  const Motion& motion_;
  const ContactPath& path_;
  Rule<double> friction_;  // of the materials, the body's first
  int k_;
  double elapsed_;
  bool orientation_;  // is asked for
  mutable std::optional<PathSensitivity<double>> without_turn_, whole_;
};

}  // namespace carom::adjoint_detail
