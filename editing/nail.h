// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "editing/constraint.h"
#include "editing/wanted.h"

namespace carom {

class Edit;

/// A handle to one constraint of an Edit, which holds until Edit::unnail. Each function nails one more quantity down
/// (again: replaces its target). A component `any` stays free, and one may be held within a range instead:
///   edit.nail("ball", between(1, 2)).position(within(0.1, 0.3), any, 2.0);
/// Valid as long as its Edit.
class Nail {
 public:
  Nail& position(const Vec3& p_W);  ///< m
  Nail& position(Wanted x, Wanted y, Wanted z);  ///< m, component by component
  Nail& orientation(const Quat& q);  ///< shape to world, unit
  Nail& velocity(const Vec3& v_W);   ///< m/s
  Nail& velocity(Wanted x, Wanted y, Wanted z);  ///< m/s, component by component
  Nail& angularVelocity(const Vec3& w_W);  ///< rad/s, world axes
  Nail& angularVelocity(Wanted x, Wanted y, Wanted z);  ///< rad/s, component by component
  Nail& time(Wanted t);                                    ///< s, of the impact, or when the body comes to rest
  Nail& point(const Vec3& body_point, const Vec3& world);  ///< a point in shape axes comes to a place in the world
  /// The same, component by component.
  Nail& point(const Vec3& body_point, Wanted x, Wanted y, Wanted z);

  Nail& speed(Wanted v);           ///< m/s, of the velocity
  Nail& kineticEnergy(Wanted e);   ///< J, of moving and turning
  Nail& impulse(Wanted p);         ///< N s, that the body gets in the impact; only for nails at an impact
  Nail& height(Wanted h);          ///< m, of the lowest point, against gravity (along z without it)

  /// m, from the body's shape to that of another body, more than 0.
  Nail& distance(const std::string& to, Wanted distance);
  /// m, the least distance of the two over a time of its own (s, first and last; without it the whole motion),
  /// whatever the time of the nail.
  Nail& closestApproach(const std::string& to, Wanted distance,
                        std::optional<std::pair<double, double>> during = std::nullopt);

  /// All quantities are those of the body as seen from another one, in the axes of its shape
  /// (docs/scenes.md). "" takes it back.
  Nail& relativeTo(const std::string& body);

  /// One more region that the body stays out of, over the region's own time, whatever that of the nail.
  Nail& avoid(Region region);
  /// One more region that the body stays within.
  Nail& inside(Region region);

 private:
  friend class Edit;
  Nail(Edit* edit, int id) : edit_(edit), id_(id) {}
  Constraint& constraint();
  Nail& set(Target target);
  Nail& setNumber(const char* quantity, const Wanted& wanted);
  Nail& set(const char* quantity, const Wanted (&wanted)[3], const Vec3& body_point = Vec3::Zero());

  Edit* edit_;
  int id_;
};

}  // namespace carom
