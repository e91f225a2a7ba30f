// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/constrained_forces.hpp"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// What may end a path in lasting contact: a quantity that falls to 0.
struct ConstrainedGuard {
  TransitionCause cause = TransitionCause::none;
  int contact = -1;     ///< of the path
  int limit = -1;       ///< leaves: of BodyGeometry::limits
  FeatureLimit border;  ///< leaves: as it is at the start; a circle's goes round with the contact

  bool isSame(const ConstrainedGuard& o) const { return cause == o.cause && contact == o.contact && limit == o.limit; }
};

/// All guards of a path that has the state `start` at time t.
std::vector<ConstrainedGuard> guardsOf(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& start,
                                       double t);

/// The value of a guard at time t, and how much of it is rounding:
///   lifts   n.f / (m a);    slips   (mu n.f - |f_t|) / (m a);    sticks   t.u / c;    leaves   see FeatureLimit
/// with the units of force m a and speed c of the scene. `shareOfMargin`: by what a value is to be multiplied to be without a unit.
double guardValue(const ConstrainedGuard& guard, const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts,
                  const Pose& own, double t, const ConstrainedInstant& now, const ConstrainedForces& forces);
double guardRounding(const ConstrainedGuard& guard, double size_of_positions);
double shareOfMargin(const ConstrainedGuard& guard, double length);

/// Of one contact, at which the features have these limits: adds its guards.
void addGuards(int contact, ContactMode mode, double friction, std::vector<FeatureLimit> limits, std::vector<ConstrainedGuard>& guards);
/// The value of a limit of a body with this pose at a contact there, n from b to a.
double borderValue(const FeatureLimit& limit, const Pose& pose, const Vec3& point, const Vec3& n);

}  // namespace carom::adjoint_detail
