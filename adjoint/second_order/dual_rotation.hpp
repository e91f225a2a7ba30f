// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/second_order/dual_state.hpp"

namespace carom::adjoint_detail {

using DualSensitivity = RotationSensitivityOf<Num>;

/// The response in body axes, eta = R^T dtheta at the end, to dM at the start with the orientation held there, to the
/// moments and to the products of inertia (G, H, P), and the derivatives of these three by M at the start (0 to 2), by
/// the moments (3 to 5) and by the products (6 to 8).
struct BodyResponse {
  Mat3 G = Mat3::Zero(), H = Mat3::Zero(), P = Mat3::Zero();
  std::vector<Mat3> dG, dH, dP;  ///< 3, 6 or 9 of each: those asked for
  bool products = false;         ///< P was asked for
};

/// How much of a BodyResponse is wanted.
struct ResponseWanted {
  int lanes = 3;          ///< 3, 6 or 9
  bool inertia = true;    ///< H as well as G; must be where there are more lanes than 3
  bool products = false;  ///< P as well
};

/// Of free rotation over [0, elapsed] of an arc, by Taylor series of the variational equations (2.1) in dual numbers.
BodyResponse bodyResponse(const Arc& arc, double elapsed, const ResponseWanted& wanted);

/// What a sensitivity over a stretch of an arc depends on.
struct Stretch {
  const DualModel& model;
  const DualState& start;
  const NMat& R_end;
  Num elapsed;
};
DualSensitivity sphericalSensitivity(const Stretch& stretch);
DualSensitivity symmetricSensitivity(const Stretch& stretch, int axis);
DualSensitivity generalSensitivity(const Stretch& stretch, const BodyResponse& response);

}  // namespace carom::adjoint_detail
