// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/controls/control_kinds.hpp"

/// The rows of the table of controls, each defined in its family's file. Internal to editing/.
namespace carom::editing_detail {

extern const ControlKind kPositionControl, kOrientationControl, kVelocityControl, kAngularVelocityControl,
    kGravityControl;  // controls_of_motion.cpp
extern const ControlKind kElasticityControl, kFrictionControl,
    kTangentialElasticityControl;                                      // controls_of_material.cpp
extern const ControlKind kMassControl, kInertiaControl, kSizeControl;  // controls_of_body.cpp
extern const ControlKind kTiltControl;                                 // controls_of_impact.cpp

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

inline std::vector<std::string> xyzComponents(const Scene&, const ControlOwner&) { return {"x", "y", "z"}; }
inline std::vector<std::string> oneComponent(const Scene&, const ControlOwner&) { return {"value"}; }
inline Eigen::VectorXd oneNumber(double value) { return Eigen::VectorXd::Constant(1, value); }
inline Eigen::VectorXd oneScale(const Scene&, const ControlOwner&) { return oneNumber(1); }
inline Eigen::VectorXd xyzScale(const Scene&, const ControlOwner&) { return Vec3::Ones(); }

}  // namespace carom::editing_detail
