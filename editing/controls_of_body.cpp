// Controls of what a body is: mass, principal moments, the dimensions of its shape.
//
// A derivative by one number holds all others as written, so the number that varies must itself be written: a body
// given by density becomes one given by mass before its mass varies, a derived inertia becomes three written moments
// before they vary. The motion at the start is the same.

#include "editing/control_families.h"

#include "adjoint/body_model.h"

namespace carom {
namespace {

void prepareMass(Scene& scene, const ControlOwner& o) {
  Body& body = scene.bodies[o.body];
  if (body.mass) return;
  body.mass = modelOf(body).mass;
  body.density.reset();
}
Vec3 getMass(const Scene& scene, const ControlOwner& o) { return {scene.bodies[o.body].mass.value_or(0), 0, 0}; }
void setMass(const Vec3& values, const Scene&, const ControlOwner& o, Scene& scene) {
  scene.bodies[o.body].mass = values.x();
}
Vec3 gatherMass(const SceneGradient& gradient, const ControlOwner& o, const Vec3&) {
  return {gradient.bodies[o.body].mass, 0, 0};
}
void scatterMass(const Vec3& rates, const ControlOwner& o, const Vec3&, SceneTangent& tangent) {
  tangent.bodies[o.body].mass += rates.x();
}

void prepareInertia(Scene& scene, const ControlOwner& o) {
  Body& body = scene.bodies[o.body];
  if (body.inertia.source == Inertia::Source::derived) body.inertia = Inertia::fromMoments(modelOf(body).inertia);
}
Vec3 getInertia(const Scene& scene, const ControlOwner& o) { return scene.bodies[o.body].inertia.moments; }
void setInertia(const Vec3& values, const Scene&, const ControlOwner& o, Scene& scene) {
  scene.bodies[o.body].inertia.moments = values;
}
Vec3 gatherInertia(const SceneGradient& gradient, const ControlOwner& o, const Vec3&) {
  return gradient.bodies[o.body].inertia;
}
void scatterInertia(const Vec3& rates, const ControlOwner& o, const Vec3&, SceneTangent& tangent) {
  tangent.bodies[o.body].inertia += rates;
}

std::vector<std::string> sizeComponents(const Scene& scene, const ControlOwner& o) {
  const auto& names = kindOf(scene.bodies[o.body].shape).dimension_names;
  return {names.begin(), names.end()};
}
Vec3 getSize(const Scene& scene, const ControlOwner& o) {
  const Shape& shape = scene.bodies[o.body].shape;
  return kindOf(shape).dimensions(shape);
}
void setSize(const Vec3& values, const Scene&, const ControlOwner& o, Scene& scene) {
  Shape& shape = scene.bodies[o.body].shape;
  kindOf(shape).setDimensions(shape, values);
}
Vec3 gatherSize(const SceneGradient& gradient, const ControlOwner& o, const Vec3&) {
  return gradient.bodies[o.body].size;
}
void scatterSize(const Vec3& rates, const ControlOwner& o, const Vec3&, SceneTangent& tangent) {
  tangent.bodies[o.body].size += rates;
}

}  // namespace

const ControlKind kMassControl{"mass",       OwnerKind::moving_body,
                               true,         0,
                               kUnbounded,   true,
                               oneComponent, prepareMass,
                               getMass,      setMass,
                               gatherMass,   scatterMass,
                               unitScale};

const ControlKind kInertiaControl{"inertia",     OwnerKind::moving_body, true,           0,          kUnbounded,
                                  true,          xyzComponents,          prepareInertia, getInertia, setInertia,
                                  gatherInertia, scatterInertia,         unitScale};

// A size is weighed relative to itself.
const ControlKind kSizeControl{"size",  OwnerKind::body, false,   0,          kUnbounded,  true,   sizeComponents,
                               nullptr, getSize,         setSize, gatherSize, scatterSize, getSize};

}  // namespace carom
