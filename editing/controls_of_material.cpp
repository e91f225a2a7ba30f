// Controls of a material: elasticity in [0, 1], friction >= 0, tangential elasticity in [-1, 1].

#include "editing/control_families.h"

namespace carom {
namespace {

template <double Material::*kField, double MaterialDerivative::*kRate>
struct MaterialNumber {
  static Vec3 get(const Scene& scene, const ControlOwner& o) { return {scene.materials[o.material].*kField, 0, 0}; }
  static void set(const Vec3& values, const Scene&, const ControlOwner& o, Scene& scene) {
    scene.materials[o.material].*kField = values.x();
  }
  static Vec3 gather(const SceneGradient& gradient, const ControlOwner& o, const Vec3&) {
    return {gradient.materials[o.material].*kRate, 0, 0};
  }
  static void scatter(const Vec3& rates, const ControlOwner& o, const Vec3&, SceneTangent& tangent) {
    tangent.materials[o.material].*kRate += rates.x();
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
                                     unitScale};

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
                                   unitScale};

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
                                               unitScale};

}  // namespace carom
