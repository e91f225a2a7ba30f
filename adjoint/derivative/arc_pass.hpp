// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "adjoint/contact/path_sensitivity.hpp"
#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/derivative/held_pass.hpp"
#include "adjoint/motion/pair_rules.hpp"

/// Derivatives over a stretch of an arc, whatever the body does on it: forward and reverse.
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

/// A path in lasting contact from its start to one time, linearised on first use, and how its inputs come from the scene.
/// Not for use from two threads at once.
class PathLinearization {
 public:
  PathLinearization(const Motion& motion, const ContactPath& path, double elapsed);

  /// `turns`: of the orientation too, which costs most. Without, its rows may be missing.
  const PathSensitivity<double>& sensitivity(bool turns) const;
  PathInputsDerivative<double> inputs(const ContactPath& path, const SceneTangent& dscene,
                                      const BodyModelDerivative& dmodel) const;

  /// Of a path that is integrated, by the columns of its inputs: null for any other.
  const HeldColumns* columns() const { return columns_ ? &*columns_ : nullptr; }
  const Eigen::MatrixXd& matrix() const;

  const Scene& scene;     // of the motion
  Rule<double> friction;  // of the materials, the body's first

 private:
  PathSensitivity<double> closedForm(bool orientation) const;

  const Motion& motion_;
  const ContactPath& path_;
  double elapsed_;
  bool orientation_;  // is asked for
  mutable std::optional<PathSensitivity<double>> without_turn_, whole_;
  std::optional<HeldColumns> columns_;
  mutable std::optional<Eigen::MatrixXd> matrix_;
};

std::shared_ptr<const PathLinearization> linearizedPath(const Motion& motion, const ContactPath& path, double elapsed);

/// Tangent of the state at time t, fixed, from that at the start of the arc.
StateDerivative arcTangent(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& dstart,
                           const SceneTangent& dscene, const BodyModelDerivative& dmodel);
/// Its adjoint: from that at t to that at the start; adds to those of the scene and of the model.
StateDerivative arcPullback(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& end_bar,
                            SceneGradient& scene_bar, BodyModelDerivative& model_bar);

}  // namespace carom::adjoint_detail
