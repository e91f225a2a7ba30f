// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/held/held_sensitivity.hpp"
#include "adjoint/impact/event_guard.hpp"
#include "adjoint/motion/motion.h"

/// Between the inputs of a path in lasting contact and the scene, forward and reverse.
namespace carom::adjoint_detail {

/// Where the columns of HeldInputs come from.
class HeldColumns {
 public:
  HeldColumns(const Motion& motion, const HeldPath& path)
      : HeldColumns(motion, path.scene(), path.contacts(), path.stateAt(path.start())) {}
  HeldColumns(const Motion& motion, const HeldScene& scene, const std::vector<HeldContact>& contacts, const State& state);

  const HeldInputs& inputs() const { return inputs_; }
  /// All columns, the start first.
  Eigen::VectorXd tangent(const StateDerivative& start, const SceneTangent& dscene, const BodyModelDerivative& dmodel) const;
  /// Its adjoint: that of the start; adds to those of the scene and the model.
  StateDerivative pullback(const Eigen::VectorXd& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) const;

 private:
  struct Friction {
    int own, other;  // materials; -1 for none
    double by_own, by_other;
  };
  int body_;
  HeldInputs inputs_;
  std::vector<Friction> friction_;
};

/// The integrated path of an arc; null for any other arc.
const HeldPath* heldPathOf(const Arc& arc);
/// Of the path that starts at an event; null where it takes the state as it is.
std::shared_ptr<const PathStart> pathStartOf(const Motion& motion, const Event& event);

}  // namespace carom::adjoint_detail
