// SPDX-License-Identifier: MIT
// Controls of how things start to move: position, orientation, velocity, angular velocity, those of surfaces; and gravity.
//
// Orientation is a world rotation vector u applied on the left of the written orientation: R = exp([u]x) R_written. Its
// start is 0. A change of u turns the body by theta = J_l(u) du, so that the derivative with respect to u is J_l(u)^T theta_bar.

#include "adjoint/numeric/so3.hpp"
#include "adjoint/numeric/so3_rates.hpp"
#include "editing/problem/controls/control_families.hpp"
#include "editing/problem/controls/natural_scales.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

constexpr auto kPosition = [](auto& scene, const ControlOwner& o) -> auto& { return scene.bodies[o.body].position; };
constexpr auto kVelocity = [](auto& scene, const ControlOwner& o) -> auto& { return scene.bodies[o.body].velocity; };
constexpr auto kAngularVelocity = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.bodies[o.body].angular_velocity;
};
constexpr auto kSurfaceVelocity = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.bodies[o.body].surface_velocity;
};
constexpr auto kSurfaceSpin = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.bodies[o.body].surface_angular_velocity;
};
constexpr auto kGravity = [](auto& scene, const ControlOwner&) -> auto& { return scene.gravity; };
using Position = FieldNumbers<kPosition>;
using Velocity = FieldNumbers<kVelocity>;
using AngularVelocity = FieldNumbers<kAngularVelocity>;
using SurfaceVelocity = FieldNumbers<kSurfaceVelocity>;
using SurfaceSpin = FieldNumbers<kSurfaceSpin>;
using Gravity = FieldNumbers<kGravity>;

template <double NaturalScales::*kScale>
Eigen::VectorXd bodyScale(const Scene& start, const ControlOwner& o) {
  return Vec3::Constant(naturalScales(start, o.body).*kScale);
}

Eigen::VectorXd scaleOrientation(const Scene&, const ControlOwner&) { return Vec3::Ones(); }  // a radian
Eigen::VectorXd getOrientation(const Scene&, const ControlOwner&) { return Eigen::VectorXd::Zero(3); }
void setOrientation(const Eigen::VectorXd& values, const Scene& start, const ControlOwner& o, Scene& scene) {
  const Quat& written = start.bodies[o.body].orientation;
  scene.bodies[o.body].orientation = values.isZero(0) ? written : (expSO3(values) * written).normalized();
}
Eigen::VectorXd gatherOrientation(const SceneGradient& gradient, const ControlOwner& o, const Eigen::VectorXd& values) {
  return leftJacobian(values).transpose() * gradient.bodies[o.body].orientation;
}
void scatterOrientation(const Eigen::VectorXd& rates, const ControlOwner& o, const Eigen::VectorXd& values,
                        SceneTangent& tangent) {
  tangent.bodies[o.body].orientation += leftJacobian(values) * rates;
}

Eigen::VectorXd gatherRateOrientation(const SceneGradient& gradient, const ControlOwner& o,
                                      const Eigen::VectorXd& values, const Eigen::VectorXd& rates) {
  return leftJacobianRate(values, rates).transpose() * gradient.bodies[o.body].orientation;
}

Eigen::VectorXd scaleGravity(const Scene& start, const ControlOwner&) { return Vec3::Constant(gravityScale(start)); }

}  // namespace

const ControlKind kPositionControl{
    .word = "position",
    .owner = OwnerKind::body,
    .components = xyzComponents,
    .get = Position::get,
    .set = Position::set,
    .gather = Position::gather,
    .scatter = Position::scatter,
    .scale = bodyScale<&NaturalScales::length>,
};

const ControlKind kOrientationControl{
    .word = "orientation",
    .owner = OwnerKind::body,
    .components = xyzComponents,
    .get = getOrientation,
    .set = setOrientation,
    .gather = gatherOrientation,
    .scatter = scatterOrientation,
    .scale = scaleOrientation,
    .gather_rate = gatherRateOrientation,
    .is_turn = true,
};

const ControlKind kVelocityControl{
    .word = "velocity",
    .owner = OwnerKind::moving_body,
    .components = xyzComponents,
    .get = Velocity::get,
    .set = Velocity::set,
    .gather = Velocity::gather,
    .scatter = Velocity::scatter,
    .scale = bodyScale<&NaturalScales::velocity>,
    .is_velocity = true,
};

const ControlKind kAngularVelocityControl{
    .word = "angular_velocity",
    .owner = OwnerKind::moving_body,
    .components = xyzComponents,
    .get = AngularVelocity::get,
    .set = AngularVelocity::set,
    .gather = AngularVelocity::gather,
    .scatter = AngularVelocity::scatter,
    .scale = bodyScale<&NaturalScales::angular_velocity>,
    .is_velocity = true,
};

const ControlKind kSurfaceVelocityControl{
    .word = "surface_velocity",
    .owner = OwnerKind::immovable_body,
    .components = xyzComponents,
    .get = SurfaceVelocity::get,
    .set = SurfaceVelocity::set,
    .gather = SurfaceVelocity::gather,
    .scatter = SurfaceVelocity::scatter,
    .scale = bodyScale<&NaturalScales::velocity>,
};

const ControlKind kSurfaceAngularVelocityControl{
    .word = "surface_angular_velocity",
    .owner = OwnerKind::immovable_body,
    .components = xyzComponents,
    .get = SurfaceSpin::get,
    .set = SurfaceSpin::set,
    .gather = SurfaceSpin::gather,
    .scatter = SurfaceSpin::scatter,
    .scale = bodyScale<&NaturalScales::angular_velocity>,
};

const ControlKind kGravityControl{
    .word = "gravity",
    .owner = OwnerKind::scene,
    .components = xyzComponents,
    .get = Gravity::get,
    .set = Gravity::set,
    .gather = Gravity::gather,
    .scatter = Gravity::scatter,
    .scale = scaleGravity,
};

}  // namespace carom::editing_detail
