// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/constrained/constrained_sensitivity.hpp"
#include "adjoint/motion/motion.h"

/// Between the inputs of a path in lasting contact and the scene, forward and reverse.
namespace carom::adjoint_detail {

/// Where the columns of ConstrainedInputs come from.
class ConstrainedColumns {
 public:
  ConstrainedColumns(const Motion& motion, const ConstrainedPath& path)
      : ConstrainedColumns(motion, path.scene(), path.contacts(), path.stateAt(path.start())) {}
  ConstrainedColumns(const Motion& motion, const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state);

  const ConstrainedInputs& inputs() const { return inputs_; }
  /// All columns, the start first.
  Eigen::VectorXd tangent(const StateDerivative& start, const SceneTangent& dscene, const BodyModelDerivative& dmodel) const;
  /// Its adjoint: that of the start; adds to those of the scene and the model.
  StateDerivative pullback(const Eigen::VectorXd& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) const;

 private:
  struct Friction {
    int own, other;  // materials; -1 for none
    double by_own, by_other;
  };
  // A support that moves: its start as the scene has it, and how far its pose at the start of the path goes with that.
  struct Carrier {
    int body;
    const BodyModel* model;
    SupportFlow flow;  // from time 0 on
  };
  const Carrier* carrierOf(int body) const;
  StateDerivative carried(const Carrier& carrier, const SceneTangent& dscene) const;
  void carriedPullback(const Carrier& carrier, const Eigen::Matrix<double, 12, 1>& bar, SceneGradient& scene_bar) const;

  const Scene* scene_;
  int body_;
  ConstrainedInputs inputs_;
  std::vector<Carrier> carriers_;
  std::vector<Friction> friction_;
};

/// The row of a guard at a time, by the inputs that `columns` has. `shift`: how these go with time.
std::shared_ptr<const PathGuard> guardWith(std::shared_ptr<const ConstrainedColumns> columns, const ConstrainedRow& row,
                                           const Eigen::VectorXd& shift);

}  // namespace carom::adjoint_detail
