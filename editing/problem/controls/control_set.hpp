// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/control.h"
#include "editing/problem/controls/control_kinds.hpp"

namespace carom::editing_detail {

/// Radius of the cone that a tilt stays in when the person gives none.
inline constexpr double kDefaultTiltCone = 0.3;

/// One number that may vary.
struct Variable {
  int control = -1;       ///< index of the Control
  int slot = 0;           ///< component of its kind
  std::string component;  ///< "x", "radius", "value"
  double before = 0;      ///< as written by the person
  double start = 0;       ///< the same, moved into the bounds
  double lower = 0, upper = 0;
  double scale = 1;  ///< natural scale, of the logarithm where changes are logarithmic, divided by the person's weight
  bool logarithmic = false;
};

/// A Control whose names are resolved.
struct BoundControl {
  Control control;
  const ControlKind* kind = nullptr;
  ControlOwner owner;
  Eigen::VectorXd start;  ///< all its numbers at the start, within the bounds
  double cone = 0;        ///< tilt: largest length of (alpha, beta)
};

/// The controls of an edit as one vector of numbers, `values`, in their own units, and as `changes` y: dimensionless,
/// weighted, 0 at the start; the edit minimises 1/2 |y|^2.
class ControlSet {
 public:
  /// Throws InputError naming "/controls/<i>": unknown words, missing or fixed bodies, bounds upside down, a number
  /// that varies twice, ...
  ControlSet(const Scene& scene, const std::vector<Control>& controls);

  const std::vector<BoundControl>& controls() const { return controls_; }
  const std::vector<Variable>& variables() const { return variables_; }
  int size() const { return static_cast<int>(variables_.size()); }
  /// Sentences about what was done to the start: numbers moved into their bounds, numbers without room.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Whether a start value had to move, so that the start is not the scene as written.
  bool startMoved() const { return start_moved_; }

  /// The scene at the start of the edit: as written, except for what ControlKind::prepare and the bounds changed.
  const Scene& startScene() const { return start_; }
  /// As written but for what ControlKind::prepare changed: the same controls of this scene start at the same values.
  const Scene& writtenScene() const { return written_; }
  Eigen::VectorXd startValues() const;
  Scene sceneAt(const Eigen::VectorXd& values) const;

  /// d(quantity)/d(values) at `values` from the derivative with respect to scene parameters; and its adjoint.
  Eigen::VectorXd gather(const SceneGradient& gradient, const Eigen::VectorXd& values) const;
  SceneTangent scatter(const Eigen::VectorXd& rates, const Eigen::VectorXd& values) const;
  /// How `gather` changes, at one and the same gradient, as the values change at `rates`.
  Eigen::VectorXd gatherRate(const SceneGradient& gradient, const Eigen::VectorXd& values,
                             const Eigen::VectorXd& rates) const;

  Eigen::VectorXd valuesOf(const Eigen::VectorXd& changes) const;
  /// The inverse, of values within the bounds and beyond; -infinity where a logarithm has none.
  Eigen::VectorXd changesOf(const Eigen::VectorXd& values) const;
  /// d(values)/d(changes), a diagonal.
  Eigen::VectorXd valueRates(const Eigen::VectorXd& changes) const;
  /// d^2(values)/d(changes)^2, each by its own change.
  Eigen::VectorXd valueBends(const Eigen::VectorXd& changes) const;
  /// Bounds on the changes; infinite where there is none.
  Eigen::VectorXd lowerChanges() const;
  Eigen::VectorXd upperChanges() const;

  /// "velocity.x of 'hat'", for people.
  std::string describeVariable(int variable) const;
  /// All numbers of the owner of a control, one a slot, at `values`.
  Eigen::VectorXd slots(int control, const Eigen::VectorXd& values) const;

  /// What several controls may share: x in one, y in the other.
  struct SharedOwner {
    int first_control;
    Eigen::VectorXd start;       ///< all its numbers
    std::vector<int> variables;  ///< those that vary, by any of the controls
  };
  const SharedOwner& ownerOf(int control) const { return owners_[static_cast<std::size_t>(owner_of_[control])]; }

 private:
  void addVariables(int index);
  void shareOwners();

  Scene written_;  ///< as written, prepared; values are set on copies of it
  Scene start_;
  std::vector<BoundControl> controls_;
  std::vector<Variable> variables_;
  std::vector<SharedOwner> owners_;
  std::vector<int> owner_of_;  // of each control
  std::vector<std::string> notes_;
  bool start_moved_ = false;
};

/// "velocity of 'hat'", "tilt of 'hat' at impact 1", "gravity".
std::string describe(const Control& control);
/// "velocity.x of 'hat'", "size.radius of 'hat'", "elasticity of 'felt'": a scene parameter, as every answer names it.
std::string describe(const Control& control, const std::string& component);

}  // namespace carom::editing_detail
