// SPDX-License-Identifier: MIT
// Controls of a material: elasticity in [0, 1], friction >= 0, tangential elasticity in [-1, 1].

#include "editing/problem/controls/control_families.hpp"

namespace carom {
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

const ControlKind kElasticityControl{"elasticity",
                                     OwnerKind::material,
                                     false,
                                     0,
                                     1,
                                     false,
                                     oneComponent,
                                     nullptr,
                                     Elasticity::get,
                                     Elasticity::set,
                                     Elasticity::gather,
                                     Elasticity::scatter,
                                     oneScale};

const ControlKind kFrictionControl{"friction",
                                   OwnerKind::material,
                                   false,
                                   0,
                                   kUnbounded,
                                   false,
                                   oneComponent,
                                   nullptr,
                                   Friction::get,
                                   Friction::set,
                                   Friction::gather,
                                   Friction::scatter,
                                   oneScale};

const ControlKind kTangentialElasticityControl{"tangential_elasticity",
                                               OwnerKind::material,
                                               false,
                                               -1,
                                               1,
                                               false,
                                               oneComponent,
                                               nullptr,
                                               TangentialElasticity::get,
                                               TangentialElasticity::set,
                                               TangentialElasticity::gather,
                                               TangentialElasticity::scatter,
                                               oneScale};

}  // namespace carom
