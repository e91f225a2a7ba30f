// SPDX-License-Identifier: MIT
#include "editing/nail.h"

#include <algorithm>
#include <utility>

#include "adjoint/base/errors.h"
#include "editing/edit.h"

namespace carom {

Constraint& Nail::constraint() {
  for (Edit::Nailed& nailed : edit_->nails_)
    if (nailed.id == id_) return nailed.constraint;
  throw InputError("this nail was removed");
}

Nail& Nail::set(Target target) {
  std::vector<Target>& targets = constraint().targets;
  const auto same = std::find_if(targets.begin(), targets.end(), [&](const Target& other) {
    return other.quantity == target.quantity && other.body_point == target.body_point && other.to == target.to &&
           other.during == target.during;
  });
  if (same != targets.end()) {
    *same = std::move(target);
  } else {
    targets.push_back(std::move(target));
  }
  return *this;
}

Nail& Nail::set(const char* quantity, const WantedVector& wanted, const Vec3& body_point) {
  Target target = targetOf(quantity, wanted);
  target.body_point = body_point;
  return set(std::move(target));
}

Nail& Nail::position(const WantedVector& p) { return set("position", p); }
Nail& Nail::position(Wanted x, Wanted y, Wanted z) { return set("position", {x, y, z}); }
Nail& Nail::orientation(const Quat& q) { return set({"orientation", {q.w(), q.x(), q.y(), q.z()}}); }
Nail& Nail::velocity(const WantedVector& v) { return set("velocity", v); }
Nail& Nail::velocity(Wanted x, Wanted y, Wanted z) { return set("velocity", {x, y, z}); }
Nail& Nail::angularVelocity(const WantedVector& w) { return set("angular_velocity", w); }
Nail& Nail::angularVelocity(Wanted x, Wanted y, Wanted z) { return set("angular_velocity", {x, y, z}); }
Nail& Nail::setNumber(const char* quantity, const Wanted& wanted) { return set(targetOf(quantity, wanted)); }

Nail& Nail::time(Wanted t) { return setNumber("time", t); }
Nail& Nail::speed(Wanted v) { return setNumber("speed", v); }
Nail& Nail::kineticEnergy(Wanted e) { return setNumber("kinetic_energy", e); }
Nail& Nail::impulse(Wanted p) { return setNumber("impulse", p); }
Nail& Nail::height(Wanted h) { return setNumber("height", h); }
Nail& Nail::point(const Vec3& body_point, const WantedVector& world) { return set("point", world, body_point); }
Nail& Nail::point(const Vec3& body_point, Wanted x, Wanted y, Wanted z) { return set("point", {x, y, z}, body_point); }
Nail& Nail::contact(Wanted x, Wanted y, Wanted z) { return set("contact", {x, y, z}); }

Nail& Nail::distance(const std::string& to, Wanted distance) {
  Target target = targetOf("distance", distance);
  target.to = to;
  return set(std::move(target));
}

Nail& Nail::closestApproach(const std::string& to, Wanted distance, std::optional<TimeSpan> during) {
  Target target = targetOf("closest_approach", distance);
  target.to = to;
  target.during = during;
  return set(std::move(target));
}

Nail& Nail::relativeTo(const std::string& body) {
  constraint().relative_to = body;
  return *this;
}

Nail& Nail::soft(double weight) {
  constraint().soft = weight;
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
