// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::editing_detail {

/// Whose numbers a kind of control varies; a free body is one that impacts move, an immovable one is fixed or kinematic.
enum class OwnerKind { body, moving_body, free_body, immovable_body, material, impact, scene };

/// The owner, as indices into a scene (-1 where it does not apply).
struct ControlOwner {
  int body = -1, material = -1, tilt = -1;
};

/// One row of the table of controls: what the editor asks of a kind. All vectors have one number a component. A new
/// kind adds a row to control_kinds.cpp and its functions to a family file (controls_of_*.cpp).
struct ControlKind {
  const char* word;  ///< in the scene document
  OwnerKind owner;
  bool logarithmic = false;  ///< changes are weighed as log(value / start) / scale; otherwise as (value - start) / scale
  /// Physical bounds.
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  bool strictly_positive = false;

  std::vector<std::string> (*components)(const Scene&, const ControlOwner&);
  /// Rewrites how the scene says things, without changing the motion, so that the numbers of this kind are written in
  /// it and everything else stays as written. May be null.
  void (*prepare)(Scene&, const ControlOwner&) = nullptr;
  Eigen::VectorXd (*get)(const Scene&, const ControlOwner&);
  /// Writes values into `scene`, a copy of `start`.
  void (*set)(const Eigen::VectorXd& values, const Scene& start, const ControlOwner&, Scene& scene);
  /// Derivative with respect to the values (at `values`) from that with respect to scene parameters; and its adjoint.
  Eigen::VectorXd (*gather)(const SceneGradient&, const ControlOwner&, const Eigen::VectorXd& values);
  void (*scatter)(const Eigen::VectorXd& rates, const ControlOwner&, const Eigen::VectorXd& values, SceneTangent&);
  /// Natural scale of a change; of a logarithmic kind, of its logarithm.
  Eigen::VectorXd (*scale)(const Scene& start, const ControlOwner&);
  /// How `gather` of one and the same derivative changes as the values change at `rates`; null where it does not.
  Eigen::VectorXd (*gather_rate)(const SceneGradient&, const ControlOwner&, const Eigen::VectorXd& values,
                                 const Eigen::VectorXd& rates) = nullptr;

  bool asks_inertia = false;    ///< its derivatives need those by the moments of inertia
  bool keeps_triangle = false;  ///< three moments of inertia: none is larger than the sum of the others
  bool changes_shape = false;   ///< features come to lie elsewhere on the body
  bool is_friction = false;     ///< a coefficient of friction
  bool is_velocity = false;     ///< a velocity or an angular velocity
  bool is_turn = false;         ///< its numbers are a rotation vector from where the body was
};

/// All kinds, in the order of control.h.
std::span<const ControlKind* const> controlKinds();

/// The kind of a word; nullptr when there is none.
const ControlKind* findControlKind(const std::string& word);

}  // namespace carom::editing_detail
