// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::charts {

/// One way to carry free rotation, R' = [omega]x R, omega = R D R^T L with the constant world momentum L and D =
/// diag(1/I): the orientation after `t` from `q`, by steps of at most `step`. Of an adaptive model `step` is the error
/// that one of its steps may make, in rad.
struct FlightModel {
  std::string name;
  bool adaptive;
  Quat (*rotate)(const Vec3& D, const Quat& q, const Vec3& L, double t, double step);
};

/// RK4 on the quaternion; Fehlberg's embedded pair of orders 7 and 8 on it; the commutator-free Lie-group method of
/// order 4 by Celledoni, Marthinsen and Owren (Future Generation Computer Systems 19, 2003); and the symmetric
/// splitting into turns about the principal axes of McLachlan (Phys. Rev. Lett. 71, 1993), order 2.
const std::vector<FlightModel>& flightModels();

}  // namespace carom::charts
