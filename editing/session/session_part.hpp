// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// The part of a scene that a gesture depends on. Internal to editing/.
namespace carom::editing_detail {

/// The moving bodies, one flag a body of the scene, that can have had an influence on what the constraints read: those
/// that they are about, and those that met them, or met such a body, before.
std::vector<bool> bodiesThatCount(const EditProblem& problem, const EditPoint& point);

/// A scene without some of its moving bodies, and the controls that are left.
struct ScenePart {
  Scene scene;
  std::vector<Control> controls;
  std::vector<bool> bodies;                 ///< of the whole scene, that are in it
  std::vector<Eigen::Index> unknowns = {};  ///< of the whole, for each of its own
  int moving = 0, all_moving = 0;           ///< bodies that move: in it, and in the whole scene

  Eigen::VectorXd restrict(const Eigen::VectorXd& whole) const;
  /// The unknowns of the whole that this part does not have stay as they are.
  void extend(const Eigen::VectorXd& part, Eigen::VectorXd& whole) const;
};

/// Of the moving bodies those of `moving` stay, and all fixed ones.
ScenePart scenePart(const EditProblem& problem, const std::vector<bool>& moving);
/// Fills in ScenePart::unknowns; false where the part's numbers are not the same unknowns as those of the whole.
bool matchUnknowns(const EditProblem& whole, const EditProblem& problem, ScenePart& part);

}  // namespace carom::editing_detail
