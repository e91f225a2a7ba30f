#include "formats/detail/gltf_physics.hpp"

#include <tiny_gltf.h>

#include <string>
#include <variant>

namespace carom {
namespace {

using tinygltf::Value;
using Object = Value::Object;
using Array = Value::Array;

Value vectorOf(const Vec3& v) { return Value(Array{Value(v.x()), Value(v.y()), Value(v.z())}); }
Value quaternionOf(const Quat& q) { return Value(Array{Value(q.x()), Value(q.y()), Value(q.z()), Value(q.w())}); }

const char* nameOf(Combine combine) {
  constexpr const char* kNames[] = {"average", "minimum", "maximum", "multiply"};
  return kNames[static_cast<int>(combine)];
}

struct ShapeWriter {
  Value operator()(const Sphere& sphere) const {
    return Value(
        Object{{"type", Value(std::string("sphere"))}, {"sphere", Value(Object{{"radius", Value(sphere.radius)}})}});
  }
  Value operator()(const Box& box) const {
    return Value(Object{{"type", Value(std::string("box"))}, {"box", Value(Object{{"size", vectorOf(box.size)}})}});
  }
  // Without sizes it is the infinite plane through the node's origin, facing its +y.
  Value operator()(const Plane&) const {
    return Value(
        Object{{"type", Value(std::string("plane"))}, {"plane", Value(Object{{"doubleSided", Value(false)}})}});
  }
};

Value materialValue(const Material& material) {
  const Object extras{{"name", Value(material.name)}, {"tangential_elasticity", Value(material.tangential_elasticity)}};
  return Value(Object{{"staticFriction", Value(material.friction)},
                      {"dynamicFriction", Value(material.friction)},
                      {"restitution", Value(material.elasticity)},
                      {"frictionCombine", Value(std::string(nameOf(material.combine_friction)))},
                      {"restitutionCombine", Value(std::string(nameOf(material.combine_elasticity)))},
                      {"extras", Value(Object{{"carom", Value(extras)}})}});
}

Value gravityOf(const Vec3& gravity) {
  Object out{{"gravity", Value(gravity.norm())}};
  const Vec3 down = gravity.normalized();  // (0, 0, 0) stays as it is; then the default direction will do
  if (gravity.norm() > 0) out["direction"] = vectorOf({down.x(), down.z(), 0 - down.y()});  // z-up to y-up
  return Value(out);
}

}  // namespace

void addPhysics(tinygltf::Model& model, const Scene& scene) {
  Array materials, shapes;
  for (const Material& material : scene.materials) materials.push_back(materialValue(material));
  materials.push_back(materialValue(Material{}));
  for (const Body& body : scene.bodies) shapes.push_back(std::visit(ShapeWriter{}, body.shape));
  model.extensions["KHR_physics_rigid_bodies"] = Value(Object{{"physicsMaterials", Value(materials)}});
  model.extensionsUsed.push_back("KHR_physics_rigid_bodies");
  if (!shapes.empty()) {
    model.extensions["KHR_implicit_shapes"] = Value(Object{{"shapes", Value(shapes)}});
    model.extensionsUsed.push_back("KHR_implicit_shapes");
  }
  model.extensions["OMI_physics_gravity"] = gravityOf(scene.gravity);
  model.extensionsUsed.push_back("OMI_physics_gravity");
}

Value motionOf(const Body& body, const BodyModel& model) {
  const Quat to_node = body.orientation.conjugate();
  return Value(Object{{"isKinematic", Value(false)},
                      {"mass", Value(model.mass)},
                      {"centerOfMass", vectorOf(Vec3::Zero())},
                      {"inertiaDiagonal", vectorOf(model.inertia)},
                      {"inertiaOrientation", quaternionOf(Quat(Mat3(model.R_BG.transpose())).normalized())},
                      {"linearVelocity", vectorOf(to_node * body.velocity)},
                      {"angularVelocity", vectorOf(to_node * body.angular_velocity)},
                      {"gravityFactor", Value(1.0)}});
}

Value colliderOf(const Scene& scene, int body) {
  const std::string& name = scene.bodies[body].material;
  const int material = name.empty() ? static_cast<int>(scene.materials.size()) : materialIndex(scene, name);
  return Value(Object{{"geometry", Value(Object{{"shape", Value(body)}})}, {"physicsMaterial", Value(material)}});
}

}  // namespace carom
