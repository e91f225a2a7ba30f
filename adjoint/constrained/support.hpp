// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/flight/trajectory.hpp"
#include "adjoint/motion/motion.h"
#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/surface_motion.hpp"

namespace carom::adjoint_detail {

/// A support at one instant, in one kind of number: (11.31) of docs/equations.md.
template <class S>
struct SupportInstant {
  V3<S> x = V3<S>::Zero();                 ///< m, its center of mass
  M3<S> R = M3<S>::Identity();             ///< shape axes to world
  V3<S> v = V3<S>::Zero(), w = V3<S>::Zero();            ///< m/s of x, rad/s
  V3<S> a = V3<S>::Zero(), alpha = V3<S>::Zero();        ///< d/dt of these
  bool has_belt = false;                   ///< the two below are not 0
  V3<S> surface_velocity = V3<S>::Zero();          ///< m/s, in shape axes
  V3<S> surface_angular_velocity = V3<S>::Zero();  ///< rad/s, in shape axes, about the shape's origin
  V3<S> center = V3<S>::Zero();            ///< m, center of mass in shape axes

  /// Of its material at a place p on a face with normal n: V + W x (p - x) + beta, see SurfaceMotion.
  V3<S> velocityAt(const V3<S>& p, const V3<S>& n) const {
    const V3<S> u = v + w.cross(V3<S>(p - x));
    return has_belt ? V3<S>(u + surface().at(p, n)) : u;
  }
  /// d/dt of that, as place and normal go at p' and n'.
  V3<S> accelerationAt(const V3<S>& p, const V3<S>& n, const V3<S>& p_rate, const V3<S>& n_rate) const {
    const V3<S> arm = p - x, u = a + alpha.cross(arm) + w.cross(V3<S>(p_rate - v));
    if (!has_belt) return u;
    const V3<S> origin_rate = v - w.cross(V3<S>(R * center));
    return u + surface().tangent(p, n, {.point = p_rate, .normal = n_rate, .position = origin_rate, .theta = w});
  }

 private:
  SurfaceMotion<S> surface() const { return {surface_velocity, surface_angular_velocity, R, x - R * center}; }
};

/// The other body of a contact: it stands still, or moves as it is given to, whatever lies on it; and its surface may move.
struct Support {
  Pose pose;                       ///< at ConstrainedScene::time; at all times where it does not move
  std::shared_ptr<const Arc> arc;  ///< how it moves; null: not at all
  bool has_belt = false;
  Vec3 surface_velocity = Vec3::Zero(), surface_angular_velocity = Vec3::Zero(), center = Vec3::Zero();  ///< as of SupportInstant

  bool moves() const { return arc != nullptr; }
  /// It moves as nothing in the scene says.
  bool isGiven() const { return arc && arc->trajectory().isGiven(); }
  /// Its material moves at contacts.
  bool drives() const { return moves() || has_belt; }
  Pose poseAt(double t) const {
    if (!moves()) return pose;
    const Kinematics now = arc->kinematicsAt(t);
    return {now.x, now.R};
  }
  SupportInstant<double> at(double t) const {
    SupportInstant<double> now;
    now.x = pose.x, now.R = pose.R;
    now.has_belt = has_belt, now.center = center;
    now.surface_velocity = surface_velocity, now.surface_angular_velocity = surface_angular_velocity;
    if (!moves()) return now;
    const State state = arc->stateAt(t);
    const Kinematics k = arc->kinematicsOf(state);
    const StateDerivative rate = arc->rateAt(t, state);  // its angular momentum is its angular velocity (BodyModel)
    now.x = k.x, now.R = k.R, now.v = k.v, now.w = k.w, now.a = rate.v, now.alpha = rate.L;
    return now;
  }
};

/// The material of a body that no contact moves, from the start of its last arc on, moves at contacts: Support::drives.
bool drivesContacts(const Motion& motion, int body);

/// Of a body that no contact moves, from a time on.
Support supportOf(const Motion& motion, int body, double t);

}  // namespace carom::adjoint_detail
