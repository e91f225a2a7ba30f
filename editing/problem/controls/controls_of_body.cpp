// SPDX-License-Identifier: MIT
// Controls of what a body is: mass, principal moments, the dimensions of its shape.
//
// A derivative with respect to one number holds all others as written, so the number that varies must itself be written: a body
// given by density becomes one given by mass before its mass varies, a derived inertia becomes three written moments
// before they vary. The motion at the start is the same. What a size moves and is not written (mass by density, derived
// moments, the shape's own centre of mass) moves along.

#include "editing/problem/controls/control_families.hpp"

#include "adjoint/scene/body_model.h"
#include "editing/problem/controls/natural_scales.hpp"

namespace carom::editing_detail {
namespace {

void prepareMass(Scene& scene, const ControlOwner& o) {
  Body& body = scene.bodies[o.body];
  if (body.mass) return;
  body.mass = modelOf(body).mass;
  body.density.reset();
}
constexpr auto kMass = [](auto& scene, const ControlOwner& o) -> auto& { return scene.bodies[o.body].mass; };
using Mass = FieldNumbers<kMass>;
Eigen::VectorXd scaleMass(const Scene&, const ControlOwner&) { return oneNumber(kMassScale); }

void prepareInertia(Scene& scene, const ControlOwner& o) {
  Body& body = scene.bodies[o.body];
  if (body.inertia.source != Inertia::Source::derived) return;
  const BodyModel model = modelOf(body);
  body.inertia = Inertia::fromMoments(model.inertia);
  if (!model.has_offset) return;
  body.inertia.source = Inertia::Source::matrix;
  body.inertia.axes = Quat(Mat3(model.R_BG.transpose())).normalized();
}
constexpr auto kMoments = [](auto& scene, const ControlOwner& o) -> auto& {
  return scene.bodies[o.body].inertia.moments;
};
constexpr auto kMomentRates = [](auto& scene, const ControlOwner& o) -> auto& { return scene.bodies[o.body].inertia; };
using Moments = FieldNumbers<kMoments, kMomentRates>;
Eigen::VectorXd scaleInertia(const Scene&, const ControlOwner&) { return Vec3::Constant(kInertiaScale); }

std::vector<std::string> sizeComponents(const Scene& scene, const ControlOwner& o) {
  const Shape& shape = scene.bodies[o.body].shape;
  return kindOf(shape).dimension_names(shape);
}
Eigen::VectorXd getSize(const Scene& scene, const ControlOwner& o) {
  const Shape& shape = scene.bodies[o.body].shape;
  return kindOf(shape).dimensions(shape);
}
void setSize(const Eigen::VectorXd& values, const Scene&, const ControlOwner& o, Scene& scene) {
  Shape& shape = scene.bodies[o.body].shape;
  kindOf(shape).setDimensions(shape, values);
}
constexpr auto kSizeRates = [](auto& scene, const ControlOwner& o) -> auto& { return scene.bodies[o.body].size; };
using SizeRates = FieldNumbers<kSizeRates>;

}  // namespace

const ControlKind kMassControl{
    .word = "mass",
    .owner = OwnerKind::free_body,
    .logarithmic = true,
    .lower = 0,
    .strictly_positive = true,
    .components = oneComponent,
    .prepare = prepareMass,
    .get = Mass::get,
    .set = Mass::set,
    .gather = Mass::gather,
    .scatter = Mass::scatter,
    .scale = scaleMass,
};

const ControlKind kInertiaControl{
    .word = "inertia",
    .owner = OwnerKind::free_body,
    .logarithmic = true,
    .lower = 0,
    .strictly_positive = true,
    .components = xyzComponents,
    .prepare = prepareInertia,
    .get = Moments::get,
    .set = Moments::set,
    .gather = Moments::gather,
    .scatter = Moments::scatter,
    .scale = scaleInertia,
    .asks_inertia = true,
    .keeps_triangle = true,
};

// A size is weighed relative to itself.
const ControlKind kSizeControl{
    .word = "size",
    .owner = OwnerKind::body,
    .lower = 0,
    .strictly_positive = true,
    .components = sizeComponents,
    .get = getSize,
    .set = setSize,
    .gather = SizeRates::gather,
    .scatter = SizeRates::scatter,
    .scale = getSize,
    .asks_inertia = true,
    .changes_shape = true,
};

}  // namespace carom::editing_detail
