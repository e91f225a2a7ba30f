// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adjoint/flight/arc.h"

namespace carom::charts {

/// A free top: principal moments, orientation, and world angular momentum, which no torque changes; models that carry
/// it along change it nevertheless.
struct Spin {
  Vec3 inertia = Vec3::Ones();
  Quat q = Quat::Identity();
  Vec3 L = Vec3::Zero();

  Vec3 bodyMomentum() const { return q.conjugate() * L; }
  double energy() const { return 0.5 * bodyMomentum().cwiseAbs2().dot(inertia.cwiseInverse()); }
  Tier tier() const;  ///< that carom takes
};

/// A way to carry a top for `t`, in steps of `step`: seconds, or of an adaptive model what one step may be off, rad.
/// Models without steps read the time `readings` times on the way, evenly spread, as a search for impacts does; those
/// with steps end one there.
struct SpinModel {
  enum class Steps { none, fixed, adaptive };
  std::string name;
  Steps steps = Steps::none;
  std::function<Spin(const Spin& start, double t, double step, int readings)> carry;
};

/// carom's tier; the tiers above it; the closed form by elliptic functions; flight_models.h; and, on Euler's equations
/// M' = M x (D M), q' = 1/2 q (0, D M) of orientation and body momentum, RK4 and the embedded pair 5(4) of Dormand and
/// Prince (J. Comput. Appl. Math. 6, 1980).
std::vector<SpinModel> spinModels(const Spin& spin);

}  // namespace carom::charts
