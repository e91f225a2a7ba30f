// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editing/problem/controls/control_kinds.hpp"

/// The rows of the table of controls, each defined in its family's file. Internal to editing/.
namespace carom::editing_detail {

extern const ControlKind kPositionControl, kOrientationControl, kVelocityControl, kAngularVelocityControl,
    kSurfaceVelocityControl, kSurfaceAngularVelocityControl, kGravityControl;  // controls_of_motion.cpp
extern const ControlKind kElasticityControl, kFrictionControl,
    kTangentialElasticityControl;                                      // controls_of_material.cpp
extern const ControlKind kMassControl, kInertiaControl, kSizeControl;  // controls_of_body.cpp
extern const ControlKind kTiltControl;                                 // controls_of_impact.cpp

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

inline std::vector<std::string> xyzComponents(const Scene&, const ControlOwner&) { return {"x", "y", "z"}; }
inline std::vector<std::string> oneComponent(const Scene&, const ControlOwner&) { return {"value"}; }
inline Eigen::VectorXd oneNumber(double value) { return Eigen::VectorXd::Constant(1, value); }

/// Functions of a kind whose numbers are a field of the scene: kField(scene, owner) refers to it in a scene, kRate to
/// its place in a derivative with respect to scene parameters.
template <auto kField, auto kRate = kField>
struct FieldNumbers {
  static Eigen::VectorXd get(const Scene& scene, const ControlOwner& o) { return asVector(kField(scene, o)); }
  static void set(const Eigen::VectorXd& values, const Scene&, const ControlOwner& o, Scene& scene) {
    auto& field = kField(scene, o);
    if constexpr (requires { field.size(); })
      field = values;
    else
      field = values[0];
  }
  static Eigen::VectorXd gather(const SceneGradient& gradient, const ControlOwner& o, const Eigen::VectorXd&) {
    return asVector(kRate(gradient, o));
  }
  static void scatter(const Eigen::VectorXd& rates, const ControlOwner& o, const Eigen::VectorXd&,
                      SceneTangent& tangent) {
    auto& rate = kRate(tangent, o);
    if constexpr (requires { rate.size(); })
      rate += rates;
    else
      rate += rates[0];
  }

 private:
  static Eigen::VectorXd asVector(const Eigen::VectorXd& v) { return v; }
  static Eigen::VectorXd asVector(double v) { return oneNumber(v); }
  static Eigen::VectorXd asVector(const std::optional<double>& v) { return oneNumber(v.value_or(0)); }
};

}  // namespace carom::editing_detail
