// SPDX-License-Identifier: MIT
// Controls of a material: elasticity in [0, 1], friction >= 0, tangential elasticity in [-1, 1].

#include "editing/problem/controls/control_families.hpp"
#include "editing/problem/controls/natural_scales.hpp"

namespace carom::editing_detail {
namespace {

constexpr auto kElasticity = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.materials[o.material].elasticity;
};
constexpr auto kFriction = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.materials[o.material].friction;
};
constexpr auto kTangentialElasticity = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.materials[o.material].tangential_elasticity;
};
using Elasticity = FieldNumbers<kElasticity>;
using Friction = FieldNumbers<kFriction>;
using TangentialElasticity = FieldNumbers<kTangentialElasticity>;

Eigen::VectorXd scaleElasticity(const Scene& start, const ControlOwner& o) {
  return oneNumber(elasticityScale(start.materials[o.material].elasticity));
}
Eigen::VectorXd scaleFriction(const Scene&, const ControlOwner&) { return oneNumber(kFrictionScale); }
Eigen::VectorXd scaleTangentialElasticity(const Scene&, const ControlOwner&) {
  return oneNumber(kTangentialElasticityScale);
}

}  // namespace

const ControlKind kElasticityControl{
    .word = "elasticity",
    .owner = OwnerKind::material,
    .lower = 0,
    .upper = 1,
    .components = oneComponent,
    .get = Elasticity::get,
    .set = Elasticity::set,
    .gather = Elasticity::gather,
    .scatter = Elasticity::scatter,
    .scale = scaleElasticity,
};

const ControlKind kFrictionControl{
    .word = "friction",
    .owner = OwnerKind::material,
    .lower = 0,
    .components = oneComponent,
    .get = Friction::get,
    .set = Friction::set,
    .gather = Friction::gather,
    .scatter = Friction::scatter,
    .scale = scaleFriction,
    .is_friction = true,
};

const ControlKind kTangentialElasticityControl{
    .word = "tangential_elasticity",
    .owner = OwnerKind::material,
    .lower = -1,
    .upper = 1,
    .components = oneComponent,
    .get = TangentialElasticity::get,
    .set = TangentialElasticity::set,
    .gather = TangentialElasticity::gather,
    .scatter = TangentialElasticity::scatter,
    .scale = scaleTangentialElasticity,
};

}  // namespace carom::editing_detail
