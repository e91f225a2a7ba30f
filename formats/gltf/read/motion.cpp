// SPDX-License-Identifier: MIT
// The member `motion` of a node -> mass, inertia and velocities of a body.
#include "adjoint/base/errors.h"
#include "adjoint/scene/body_model.h"
#include "formats/gltf/read/bodies.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"
#include "ode_bridge/convex_hull.h"

namespace carom::gltf {

using namespace formats_detail;

namespace {

constexpr double kDensity = 1000;  // kg/m^3, where a file gives no mass: that of water

template <class Value>
bool same(const Value& a, const Value& b, double size) {
  return (a - b).cwiseAbs().maxCoeff() <= kSame * size;
}

/// Open meshes closed by their convex hulls. Throws InputError for flat ones.
Shape withHulls(Shape shape) {
  for (const shapes::SurfaceUse& use : shapes::surfacesOf(shape))
    if (!use.surface.closed) use.shape = Hull{convexHull(use.surface.vertices), use.scale, ""};
  return shape;
}

/// What derives from the shape; for an open mesh, where the file does not say it all, from its hull.
SolidProperties derivedFrom(const Shape& shape, bool solid, bool needed) {
  if (solid) return kindOf(shape).properties(shape);
  if (!needed) return {};
  try {
    const Shape closed = withHulls(shape);
    return kindOf(closed).properties(closed);
  } catch (const InputError& error) {
    throw InputError("found a moving body of an open mesh that has no convex hull (" + error.message() +
                     "), expected its mass, center of mass and inertia, or a closed mesh");
  }
}

/// The nearest moments that a body can have. Where I1 > I2 + I3 they are (I1 - d, I2 + d, I3 + d) with
/// d = (I1 - I2 - I3)/3: the foot of the perpendicular on the plane I1 = I2 + I3.
Vec3 possibleMoments(const PhysicsNode& node, const Vec3& written, ImportReport& report) {
  Eigen::Index largest = 0;
  const double greatest = written.maxCoeff(&largest), others = written.sum() - greatest;
  if (greatest <= others * (1 + 1e-12)) return written;
  const double d = (greatest - others) / 3;
  Vec3 possible = written.array() + d;
  possible[largest] = greatest - d;
  const auto text = [](const Vec3& m) {
    return numberText(m.x()) + ", " + numberText(m.y()) + ", " + numberText(m.z());
  };
  report.warnings.push_back(node.label() + ": no body has its moments of inertia (" + text(written) +
                            " kg m^2), one of which is greater than the sum of the others; they are the nearest "
                            "possible ones (" +
                            text(possible) + ")");
  return possible;
}

/// The moments of a file in the axes of the shape; none when they are missing or infinite.
std::optional<Inertia> writtenInertia(const PhysicsNode& node, const Quat& shape_to_node, ImportReport& report) {
  const Moving& motion = *node.motion;
  if (!motion.inertia_diagonal) return std::nullopt;
  if (!(motion.inertia_diagonal->minCoeff() > 0)) {
    report.warnings.push_back(node.label() +
                              ": its inertia is ignored, and derived from its shape: infinite moments (0) are not "
                              "supported");
    return std::nullopt;
  }
  Inertia inertia = Inertia::fromMoments(possibleMoments(node, *motion.inertia_diagonal, report));
  const Quat axes = product(shape_to_node.conjugate(), motion.inertia_orientation);
  Mat3 exchange;
  for (int i = 0; i < 3; ++i) exchange.col(i) = turned(axes, Vec3::Unit(i)).cwiseAbs();
  if (exchange == Mat3(exchange.array().round())) {  // quarter turns: the axes are principal, in another order
    inertia.moments = exchange * inertia.moments;
  } else {
    inertia.axes = axes;
    inertia.source = Inertia::Source::matrix;
  }
  return inertia;
}

}  // namespace

void setMotion(Body& body, const PhysicsNode& node, const Quat& shape_to_node, const Frame& world,
               ImportReport& report) {
  const Moving& motion = *node.motion;
  std::optional<Vec3> center = motion.center_of_mass;
  if (center) center = turned(shape_to_node.conjugate(), world.stretch * *center);
  body.velocity = turned(world.rotation, motion.linear);
  body.angular_velocity = turned(world.rotation, motion.angular);
  body.gravity_factor = motion.gravity_factor;
  if (motion.kinematic) {  // mass and inertia do not matter
    body.kinematic = true;
    const Vec3 derived = centerOfMass(body);
    if (center && !same(*center, derived, kindOf(body.shape).boundingRadius(body.shape))) body.center_of_mass = center;
    return;
  }
  std::optional<Inertia> inertia = writtenInertia(node, shape_to_node, report);
  const bool solid = kindOf(body.shape).solid(body.shape);
  const SolidProperties derived = derivedFrom(body.shape, solid, !motion.mass || !center || !inertia);
  const double mass = motion.mass ? *motion.mass : kDensity * derived.volume;
  if (motion.mass || !solid) {
    body.mass = mass;
  } else {
    body.density = kDensity;
  }
  if (!motion.mass)
    report.warnings.push_back(node.label() + ": it has no mass; it is that of its volume at " + numberText(kDensity) +
                              " kg/m^3, " + numberText(mass) + " kg");
  if (!solid && (!center || !inertia)) {
    report.warnings.push_back(node.label() + ": its mesh is open, so that " + (center ? "" : "its centre of mass") +
                              (center || inertia ? "" : " and ") + (inertia ? "" : "its inertia") +
                              " cannot be derived from it: they are those of its convex hull");
    if (!center) center = derived.center;
    if (!inertia) inertia = Inertia::fromMatrix(mass * derived.unit_inertia);
  }
  const double size = kindOf(body.shape).boundingRadius(body.shape);
  if (center && !(solid && same(*center, derived.center, size))) body.center_of_mass = center;
  const Mat3 derived_inertia = mass * derived.unit_inertia;
  if (inertia && !(solid && same(inertia->matrix(), derived_inertia, derived_inertia.diagonal().maxCoeff())))
    body.inertia = *inertia;
}

}  // namespace carom::gltf
