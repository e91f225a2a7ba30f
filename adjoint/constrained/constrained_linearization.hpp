// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/constrained/constrained_sensitivity.hpp"
#include "adjoint/constrained/contact_columns.hpp"
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
  int body_;
  ConstrainedInputs inputs_;
  ContactColumns contacts_;
};

/// The row of a guard at a time, by the inputs that `columns` has. `shift`: how these go with time.
std::shared_ptr<const PathGuard> guardWith(std::shared_ptr<const ConstrainedColumns> columns, const ConstrainedRow& row,
                                           const Eigen::VectorXd& shift);

}  // namespace carom::adjoint_detail
