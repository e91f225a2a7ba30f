// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/body_model.h"

namespace carom::adjoint_detail {

/// Motions in lasting contact with one fixed face that have a closed form; docs/equations.md, section 11. `ball`: a
/// uniform one; `block`: a body that does not turn; `axle`: a cylinder or capsule that rolls about its axis. `held`: any
/// other one, which is integrated (see ConstrainedPath).
enum class PathForm { rest, glide_ball, glide_block, roll_ball, roll_axle, held };

/// All that a path depends on, as it is at its start.
template <class S>
struct PathInputs {
  V3<S> x = V3<S>::Zero();         ///< m, centre of mass
  V3<S> v = V3<S>::Zero();         ///< m/s
  V3<S> L = V3<S>::Zero();         ///< kg m^2/s, world axes
  M3<S> R = M3<S>::Identity();     ///< principal axes to world
  V3<S> gravity = V3<S>::Zero();   ///< m/s^2, the body's gravity factor included
  V3<S> normal = V3<S>::UnitZ();   ///< of the face, towards the body, unit
  S friction = 0;                  ///< coefficient
  S mass = 1;                      ///< kg
  M3<S> J = M3<S>::Identity();     ///< kg m^2 in principal axes: diagonal in value
  S reach = 1;                     ///< m, from the centre of mass to the face: radius, or height of a block
  V3<S> axis = V3<S>::UnitZ();     ///< roll_axle: in principal axes, unit, a constant of the body
  bool begins = false;             ///< glide: its slip is 0 at the start, but for rounding, and begins along the slope
};

template <class S>
struct PathState {
  V3<S> x = V3<S>::Zero(), v = V3<S>::Zero(), L = V3<S>::Zero();
  M3<S> R = M3<S>::Identity();
};

/// Position and velocity of the centre of mass alone: what costs least.
template <class S>
struct PathCenter {
  V3<S> x, v;
};

/// Gravity split by the face: along it, and how much presses the body on.
template <class S>
V3<S> alongFace(const V3<S>& normal, const V3<S>& vector) {
  return vector - normal * normal.dot(vector);
}
template <class S>
S pressingGravity(const PathInputs<S>& in) {
  return -in.normal.dot(in.gravity);
}
/// Of a ball, whose inertia is a multiple of 1.
template <class S>
S ballInertia(const PathInputs<S>& in) {
  return (in.J(0, 0) + in.J(1, 1) + in.J(2, 2)) / 3.0;
}

}  // namespace carom::adjoint_detail
