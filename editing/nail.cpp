// SPDX-License-Identifier: MIT
#include "editing/nail.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adjoint/base/errors.h"
#include "editing/edit.h"

namespace carom {
namespace {

std::vector<double> numbersOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Component `i` of a target of `count`.
void put(const Wanted& wanted, std::size_t i, std::size_t count, Target& target) {
  target.value.resize(count, any);
  target.value[i] = wanted.value;
  if (!std::isnan(wanted.min)) target.min.resize(count, any), target.min[i] = wanted.min;
  if (!std::isnan(wanted.max)) target.max.resize(count, any), target.max[i] = wanted.max;
}

}  // namespace

Constraint& Nail::constraint() {
  for (Edit::Nailed& nailed : edit_->nails_)
    if (nailed.id == id_) return nailed.constraint;
  throw InputError("this nail was removed");
}

Nail& Nail::set(Target target) {
  std::vector<Target>& targets = constraint().targets;
  const auto same = std::find_if(targets.begin(), targets.end(), [&](const Target& other) {
    return other.quantity == target.quantity && other.body_point == target.body_point;
  });
  if (same != targets.end()) {
    *same = std::move(target);
  } else {
    targets.push_back(std::move(target));
  }
  return *this;
}

Nail& Nail::set(const char* quantity, const Wanted (&wanted)[3], const Vec3& body_point) {
  Target target;
  target.quantity = quantity;
  target.body_point = body_point;
  for (std::size_t i = 0; i < 3; ++i) put(wanted[i], i, 3, target);
  return set(std::move(target));
}

Nail& Nail::position(const Vec3& p) { return set({"position", numbersOf(p)}); }
Nail& Nail::position(Wanted x, Wanted y, Wanted z) { return set("position", {x, y, z}); }
Nail& Nail::orientation(const Quat& q) { return set({"orientation", {q.w(), q.x(), q.y(), q.z()}}); }
Nail& Nail::velocity(const Vec3& v) { return set({"velocity", numbersOf(v)}); }
Nail& Nail::velocity(Wanted x, Wanted y, Wanted z) { return set("velocity", {x, y, z}); }
Nail& Nail::angularVelocity(const Vec3& w) { return set({"angular_velocity", numbersOf(w)}); }
Nail& Nail::angularVelocity(Wanted x, Wanted y, Wanted z) { return set("angular_velocity", {x, y, z}); }
Nail& Nail::setNumber(const char* quantity, const Wanted& wanted) {
  Target target;
  target.quantity = quantity;
  put(wanted, 0, 1, target);
  return set(std::move(target));
}

Nail& Nail::time(Wanted t) { return setNumber("time", t); }
Nail& Nail::speed(Wanted v) { return setNumber("speed", v); }
Nail& Nail::kineticEnergy(Wanted e) { return setNumber("kinetic_energy", e); }
Nail& Nail::impulse(Wanted p) { return setNumber("impulse", p); }
Nail& Nail::height(Wanted h) { return setNumber("height", h); }
Nail& Nail::point(const Vec3& body_point, const Vec3& world) { return set({"point", numbersOf(world), body_point}); }
Nail& Nail::point(const Vec3& body_point, Wanted x, Wanted y, Wanted z) { return set("point", {x, y, z}, body_point); }

Nail& Nail::relativeTo(const std::string& body) {
  constraint().relative_to = body;
  return *this;
}

Nail& Nail::avoid(Region region) {
  region.side = Region::Side::avoid;
  constraint().regions.push_back(std::move(region));
  return *this;
}

Nail& Nail::inside(Region region) {
  region.side = Region::Side::inside;
  constraint().regions.push_back(std::move(region));
  return *this;
}

}  // namespace carom
