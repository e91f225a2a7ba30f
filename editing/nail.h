// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/base/times.h"
#include "editing/constraint.h"
#include "editing/wanted.h"

namespace carom {

class Edit;

/// A handle to one constraint of an Edit, active until Edit::unnail. Each function adds a target, or replaces it. A
/// component `any` is free, and one may be a range:
///   edit.nail("ball", between(1, 2)).position(within(0.1, 0.3), any, 2.0);
/// Valid as long as its Edit.
class Nail {
 public:
  Nail& position(const WantedVector& p_W);       ///< m: position(p), position({5, any, 0.3})
  Nail& position(Wanted x, Wanted y, Wanted z);  ///< m, component by component
  Nail& orientation(const Quat& q);  ///< shape to world, unit
  Nail& velocity(const WantedVector& v_W);       ///< m/s
  Nail& velocity(Wanted x, Wanted y, Wanted z);  ///< m/s, component by component
  Nail& angularVelocity(const WantedVector& w_W);       ///< rad/s, world axes
  Nail& angularVelocity(Wanted x, Wanted y, Wanted z);  ///< rad/s, component by component
  Nail& time(Wanted t);                                    ///< s, of the impact, or of coming to rest
  /// Position in the world of a point in shape axes, m.
  Nail& point(const Vec3& body_point, const WantedVector& world);
  /// The same, component by component.
  Nail& point(const Vec3& body_point, Wanted x, Wanted y, Wanted z);
  /// m, world: where the body touches in the impact, the mean of its contacts; only for nails at an impact. Along the
  /// normal it is where the surface is: leave one component free.
  Nail& contact(Wanted x, Wanted y, Wanted z);

  Nail& speed(Wanted v);           ///< m/s, of the velocity
  Nail& kineticEnergy(Wanted e);   ///< J, translational and rotational
  Nail& impulse(Wanted p);         ///< N s, on the body in the impact; only for nails at an impact
  Nail& height(Wanted h);          ///< m, of the lowest point, opposite to gravity (along z without gravity)

  /// m, between the surfaces of the body and another, greater than 0.
  Nail& distance(const std::string& to, Wanted distance);
  /// m, the minimum distance of the two over an interval of its own (s, first and last; default: the whole motion),
  /// independent of the time of the nail.
  Nail& closestApproach(const std::string& to, Wanted distance,
                        std::optional<TimeSpan> during = std::nullopt);

  /// Makes all targets relative to another body, in the axes of its shape (docs/scenes.md). "" resets it to the
  /// world.
  Nail& relativeTo(const std::string& body);

  /// Makes it a soft constraint, a term of the objective (Constraint::soft): edit.nail("ball", 0.3).position(p).soft().
  Nail& soft(double weight = 1);

  /// Adds a region that the body stays out of, during the region's own interval, independent of the time of the nail.
  Nail& avoid(Region region);
  /// Adds a region that the body stays within.
  Nail& inside(Region region);

 private:
  friend class Edit;
  Nail(Edit* edit, int id) : edit_(edit), id_(id) {}
  Constraint& constraint();
  Nail& set(Target target);
  Nail& setNumber(const char* quantity, const Wanted& wanted);
  Nail& set(const char* quantity, const WantedVector& wanted, const Vec3& body_point = Vec3::Zero());

  Edit* edit_;
  int id_;
};

}  // namespace carom
