// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/elementary.hpp"
#include "adjoint/scene/body_model.h"
#include "adjoint/scene/validation.hpp"

namespace carom {
namespace validation {

std::string Place::pointer() const {
  if (!around_) return "";
  std::string step = "/";
  if (!member_) return around_->pointer() + step + std::to_string(index_);
  for (const char* c = member_; *c; ++c) step += *c == '~' ? "~0" : *c == '/' ? "~1" : std::string(1, *c);
  return around_->pointer() + step;
}

std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

std::string text(const Vec3& value) {
  return "(" + text(value.x()) + ", " + text(value.y()) + ", " + text(value.z()) + ")";
}

void fail(const Place& where, const std::string& found, const std::string& expected) {
  throw InputError(where.pointer(), "found " + found + ", expected " + expected);
}

void requireFinite(const Place& where, double value, double largest) {
  if (!(std::abs(value) <= largest))
    fail(where, text(value),
         "a finite number of magnitude at most 1e" + std::to_string(std::lround(elementary::log10(largest))));
}

void requireFinite(const Place& where, const Vec3& value) {
  for (int i = 0; i < 3; ++i) requireFinite(where / i, value[i]);
}

void requireRange(const Place& where, double value, double lo, double hi) {
  requireFinite(where, value);
  if (!(value >= lo && value <= hi)) fail(where, text(value), "a number in [" + text(lo) + ", " + text(hi) + "]");
}

void requirePositive(const Place& where, double value, double largest) {
  requireFinite(where, value, largest);
  if (!(value > 0)) fail(where, text(value), "a number > 0");
}

void requireLength(const Place& where, double value) {
  requirePositive(where, value);
  if (!(value >= kLeastLength)) fail(where, text(value) + " m", "at least " + text(kLeastLength) + " m");
}

void requireDivisor(const Place& where, double value) {
  requirePositive(where, value, kHeaviest);
  if (!(value >= kLeastDivisor)) fail(where, text(value), "at least " + text(kLeastDivisor) + ": it is divided by");
}

void requireUnit(const Place& where, const Quat& q) {
  if (!(std::abs(q.norm() - 1) <= 1e-9)) fail(where, "a quaternion of norm " + text(q.norm()), "a unit quaternion");
}

}  // namespace validation

namespace {

using namespace validation;

// Least share of the largest moment. The state of a rotation is the angular momentum in world axes; the spin about the
// axis of a thinner body would be lost in its rounding, 1e-16 of the largest moment.
constexpr double kLeastMomentShare = 1e-8;

void requireMoments(const Place& where, const Vec3& I) {
  for (int i = 0; i < 3; ++i) requireDivisor(where, I[i]);
  for (int i = 0; i < 3; ++i) {
    const double others = I[(i + 1) % 3] + I[(i + 2) % 3];
    if (!(I[i] <= others * (1 + 1e-12)))  // rounding of the three written numbers
      fail(where, "moments " + text(I[0]) + ", " + text(I[1]) + ", " + text(I[2]),
           "each moment at most the sum of the other two");
  }
  if (!(I.minCoeff() >= kLeastMomentShare * I.maxCoeff()))
    fail(where, "moments " + text(I[0]) + ", " + text(I[1]) + ", " + text(I[2]) + ", a ratio of " + text(I.maxCoeff() / I.minCoeff()),
         "a ratio of " + text(1 / kLeastMomentShare) + " at most: beyond, the spin about the axis of the least one is lost in rounding");
}

// Mass and moments that follow from the shape must be numbers that can be divided by, and that a document can hold when
// an edit writes them down: 1e-110 m squared and cubed is not, nor is a moment lost in the rounding of the others.
void requireDerived(const Place& where, const Body& body) {
  const bool derived = body.inertia.source == Inertia::Source::derived;
  if (body.immovable() || (!derived && !body.density)) return;
  const BodyModel model = modelOf(body);
  const double least = derived ? model.inertia.minCoeff() : model.mass;
  const double most = derived ? model.inertia.maxCoeff() : model.mass;
  if (!(model.mass >= kLeastDivisor && model.mass <= kHeaviest && least >= kLeastDivisor && most <= kHeaviest))
    fail(where / "shape",
         "a size from which a mass of " + text(model.mass) + " kg and a least moment of " + text(least) +
             " kg m^2 follow",
         "a size whose mass and moments can be divided by");
  if (derived && !(least >= kLeastMomentShare * most))
    fail(where / "shape",
         "a body so thin that its moments are " + text(least) + " and " + text(most) + " kg m^2, a ratio of " + text(most / least),
         "a ratio of " + text(1 / kLeastMomentShare) +
             " at most: beyond, the spin about the axis of the least one is lost in rounding. Thicker, or \"inertia\" written");
}

void validateMass(const Place& where, const Body& body) {
  if (body.mass && body.density) fail(where / "density", "both mass and density", "one of them");
  if (body.mass) requireDivisor(where / "mass", *body.mass);
  if (body.density) requireDivisor(where / "density", *body.density);
  if (!body.immovable() && !body.mass && !body.density) fail(where, "neither mass nor density", "one of them");
  if (body.inertia.source != Inertia::Source::derived) {
    requireMoments(where / "inertia", body.inertia.moments);
    requireUnit(where / "inertia", body.inertia.axes);
  }
  if (body.center_of_mass) requireFinite(where / "center_of_mass", *body.center_of_mass);
  requireDerived(where, body);
}

using Names = std::unordered_map<std::string_view, std::size_t>;

/// Index by name.
template <class Items>
Names requireNames(const Items& items, const Place& list) {
  Names names;
  names.reserve(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name.empty()) fail(list / i / "name", "an empty name", "a name");
    if (!names.emplace(items[i].name, i).second)
      fail(list / i / "name", "'" + items[i].name + "' a second time", "a name of its own");
  }
  return names;
}

void validateMaterial(const Place& where, const Material& m) {
  requireRange(where / "elasticity", m.elasticity, 0, 1);
  requireRange(where / "friction", m.friction, 0, kLargest);
  requireRange(where / "tangential_elasticity", m.tangential_elasticity, -1, 1);
}

void validateFilter(const Place& where, const CollisionFilter& filter) {
  const auto named = [](const Place& list, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty()) fail(list / i, "an empty name", "the name of a collision system");
      if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
          names.begin() + static_cast<std::ptrdiff_t>(i))
        fail(list / i, "'" + names[i] + "' a second time", "each system once");
    }
  };
  named(where / "systems", filter.systems);
  named(where / "collide_with", filter.collide_with);
  named(where / "not_collide_with", filter.not_collide_with);
}

void validateSurfaceMotion(const Place& where, const Body& body, const Vec3& value) {
  requireFinite(where, value);
  if (!body.immovable() && !value.isZero(0))
    fail(where, "a moving surface of a body that impacts move", "none, or zeros: surfaces of fixed and kinematic bodies move");
}

void validateBody(const Place& where, const Body& body, const Names& materials) {
  if (body.fixed && body.kinematic) fail(where / "kinematic", "a fixed body that is kinematic", "one of the two");
  validateShape(where, body);
  validateMass(where, body);
  if (!body.material.empty() && !materials.contains(body.material))
    fail(where / "material", "'" + body.material + "'", "the name of a material");
  requireFinite(where / "gravity_factor", body.gravity_factor);
  validateFilter(where / "collision_filter", body.collision_filter);
  requireFinite(where / "position", body.position);
  requireUnit(where / "orientation", body.orientation);
  requireFinite(where / "velocity", body.velocity);
  requireFinite(where / "angular_velocity", body.angular_velocity);
  validateSurfaceMotion(where / "surface_velocity", body, body.surface_velocity);
  validateSurfaceMotion(where / "surface_angular_velocity", body, body.surface_angular_velocity);
}

void validateTilt(const Place& where, const Tilt& tilt, const Scene& scene, const Names& bodies) {
  const auto body = bodies.find(tilt.body);
  if (body == bodies.end()) fail(where / "body", "'" + tilt.body + "'", "the name of a body");
  if (scene.bodies[body->second].fixed) fail(where / "body", "the fixed body '" + tilt.body + "'", "a moving body");
  if (tilt.impact < 1) fail(where / "impact", std::to_string(tilt.impact), "1 or more");
  for (int i = 0; i < 2; ++i) requireFinite(where / "value" / i, tilt.value[i]);
}

}  // namespace

void validate(const Scene& scene) {
  const Place root, materials = root / "materials", bodies = root / "bodies", tilts = root / "tilts";
  requireFinite(root / "gravity", scene.gravity);
  const Names material_names = requireNames(scene.materials, materials);
  for (const Material& m : scene.materials) validateMaterial(materials / m.name, m);
  const Names body_names = requireNames(scene.bodies, bodies);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) validateBody(bodies / i, scene.bodies[i], material_names);
  for (std::size_t i = 0; i < scene.tilts.size(); ++i) validateTilt(tilts / i, scene.tilts[i], scene, body_names);
}

}  // namespace carom
