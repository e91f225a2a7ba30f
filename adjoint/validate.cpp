#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "adjoint/errors.h"
#include "adjoint/scene.h"

namespace carom {
namespace {

constexpr double kLargest = 1e9;  // collision detection and double precision both want magnitudes below this

std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

[[noreturn]] void fail(const std::string& where, const std::string& found, const std::string& expected) {
  throw InputError(where, "found " + found + ", expected " + expected);
}

void requireFinite(const std::string& where, double value) {
  if (!(std::abs(value) <= kLargest)) fail(where, text(value), "a finite number of magnitude at most 1e9");
}

void requireFinite(const std::string& where, const Vec3& value) {
  for (int i = 0; i < 3; ++i) requireFinite(where + "/" + std::to_string(i), value[i]);
}

void requireRange(const std::string& where, double value, double lo, double hi) {
  requireFinite(where, value);
  if (!(value >= lo && value <= hi)) fail(where, text(value), "a number in [" + text(lo) + ", " + text(hi) + "]");
}

void requirePositive(const std::string& where, double value) {
  requireFinite(where, value);
  if (!(value > 0)) fail(where, text(value), "a number > 0");
}

void requireUnit(const std::string& where, const Quat& q) {
  if (!(std::abs(q.norm() - 1) <= 1e-9)) fail(where, "a quaternion of norm " + text(q.norm()), "a unit quaternion");
}

void requireMoments(const std::string& where, const Vec3& I) {
  for (int i = 0; i < 3; ++i) requirePositive(where, I[i]);
  for (int i = 0; i < 3; ++i) {
    const double others = I[(i + 1) % 3] + I[(i + 2) % 3];
    if (!(I[i] <= others * (1 + 1e-12)))  // rounding of the three written numbers
      fail(where, "moments " + text(I[0]) + ", " + text(I[1]) + ", " + text(I[2]),
           "each moment at most the sum of the other two");
  }
}

void validateShape(const std::string& where, const Body& body) {
  const ShapeKind& kind = kindOf(body.shape);
  if (!body.fixed && !kind.solid) fail(where + "/shape", std::string("a moving ") + kind.name, "\"fixed\": true");
  const Vec3 dimensions = kind.dimensions(body.shape);
  for (std::size_t d = 0; d < kind.dimension_names.size(); ++d)
    requirePositive(where + "/shape/" + kind.name, dimensions[static_cast<int>(d)]);
  if (const auto* plane = std::get_if<Plane>(&body.shape)) {
    if (!(std::abs(plane->normal.norm() - 1) <= 1e-9))
      fail(where + "/shape/plane/normal", "a vector of length " + text(plane->normal.norm()), "a unit vector");
    requireFinite(where + "/shape/plane/offset", plane->offset);
  }
}

void validateMass(const std::string& where, const Body& body) {
  if (body.mass && body.density) fail(where + "/density", "both mass and density", "one of them");
  if (body.mass) requirePositive(where + "/mass", *body.mass);
  if (body.density) requirePositive(where + "/density", *body.density);
  if (!body.fixed && !body.mass && !body.density) fail(where, "neither mass nor density", "one of them");
  if (body.inertia.source != Inertia::Source::derived) {
    requireMoments(where + "/inertia", body.inertia.moments);
    requireUnit(where + "/inertia", body.inertia.axes);
  }
}

template <class Items>
void requireNames(const Items& items, const std::string& list) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string where = "/" + list + "/" + std::to_string(i) + "/name";
    if (items[i].name.empty()) fail(where, "an empty name", "a name");
    if (!seen.insert(items[i].name).second) fail(where, "'" + items[i].name + "' a second time", "a name of its own");
  }
}

}  // namespace

void validate(const Scene& scene) {
  requireFinite("/gravity", scene.gravity);
  requireNames(scene.materials, "materials");
  for (const Material& m : scene.materials) {
    const std::string where = "/materials/" + m.name;
    requireRange(where + "/elasticity", m.elasticity, 0, 1);
    requireRange(where + "/friction", m.friction, 0, kLargest);
    requireRange(where + "/tangential_elasticity", m.tangential_elasticity, -1, 1);
  }
  requireNames(scene.bodies, "bodies");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const std::string where = "/bodies/" + std::to_string(i);
    validateShape(where, body);
    validateMass(where, body);
    if (!body.material.empty() &&
        std::none_of(scene.materials.begin(), scene.materials.end(), [&](auto& m) { return m.name == body.material; }))
      fail(where + "/material", "'" + body.material + "'", "the name of a material");
    requireFinite(where + "/position", body.position);
    requireUnit(where + "/orientation", body.orientation);
    requireFinite(where + "/velocity", body.velocity);
    requireFinite(where + "/angular_velocity", body.angular_velocity);
  }
  for (std::size_t i = 0; i < scene.tilts.size(); ++i) {
    const Tilt& tilt = scene.tilts[i];
    const std::string where = "/tilts/" + std::to_string(i);
    const auto body =
        std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == tilt.body; });
    if (body == scene.bodies.end()) fail(where + "/body", "'" + tilt.body + "'", "the name of a body");
    if (body->fixed) fail(where + "/body", "the fixed body '" + tilt.body + "'", "a moving body");
    if (tilt.impact < 1) fail(where + "/impact", std::to_string(tilt.impact), "1 or more");
    requireFinite(where + "/value", Vec3(tilt.value.x(), tilt.value.y(), 0));
  }
}

}  // namespace carom
