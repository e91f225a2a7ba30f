// SPDX-License-Identifier: MIT
// Controls of a material: elasticity in [0, 1], friction >= 0, tangential elasticity in [-1, 1].

#include "editing/problem/controls/control_families.hpp"

namespace carom::editing_detail {
namespace {

template <double Material::*kField, double MaterialDerivative::*kRate>
struct MaterialNumber {
  static Eigen::VectorXd get(const Scene& scene, const ControlOwner& o) {
    return oneNumber(scene.materials[o.material].*kField);
  }
  static void set(const Eigen::VectorXd& values, const Scene&, const ControlOwner& o, Scene& scene) {
    scene.materials[o.material].*kField = values[0];
  }
  static Eigen::VectorXd gather(const SceneGradient& gradient, const ControlOwner& o, const Eigen::VectorXd&) {
    return oneNumber(gradient.materials[o.material].*kRate);
  }
  static void scatter(const Eigen::VectorXd& rates, const ControlOwner& o, const Eigen::VectorXd&,
                      SceneTangent& tangent) {
    tangent.materials[o.material].*kRate += rates[0];
  }
};
using Elasticity = MaterialNumber<&Material::elasticity, &MaterialDerivative::elasticity>;
using Friction = MaterialNumber<&Material::friction, &MaterialDerivative::friction>;
using TangentialElasticity =
    MaterialNumber<&Material::tangential_elasticity, &MaterialDerivative::tangential_elasticity>;

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
    .scale = oneScale,
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
    .scale = oneScale,
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
    .scale = oneScale,
};

}  // namespace carom::editing_detail
