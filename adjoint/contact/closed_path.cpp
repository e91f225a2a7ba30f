// SPDX-License-Identifier: MIT
#include "adjoint/contact/closed_path.hpp"

#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/contact/closed_path_linearization.hpp"
#include "adjoint/flight/flight_triaxial.hpp"

namespace carom::adjoint_detail {

ArcKind ClosedPath::kind() const {
  if (path_.form == PathForm::rest) return ArcKind::rest;
  return glides(path_.form) ? ArcKind::slide : ArcKind::roll;
}

State ClosedPath::stateAt(const Arc& arc, double t) const {
  return path_.stateAt(arc.startState(), t, arc.tier() != Tier::none);
}

// Apart, so that flights do without its stack.
[[gnu::noinline]] static PathCenter<double> centerOn(const ContactPath& path, double t) {
  return pathCenterAt(path.form, path.inputs, path.elapsedAt(t));
}
Vec3 ClosedPath::positionAt(const Arc&, double t) const { return centerOn(path_, t).x; }
Vec3 ClosedPath::velocityAt(const Arc&, double t) const { return centerOn(path_, t).v; }

StateDerivative ClosedPath::rateAt(const Arc&, double t, const State&) const {
  return pathRateAt(path_.form, path_.inputs, path_.elapsedAt(t));
}

double ClosedPath::availableUntil(const Arc& arc) const {
  return arc.tier() == Tier::none ? std::numeric_limits<double>::infinity()
                                  : path_.followedUntil(TriaxialRotation::kMostSegments);
}

void ClosedPath::extendTo(const Arc& arc, double t) {
  if (!(t <= availableUntil(arc)))
    throw NotComputable("its rotation takes more than " + std::to_string(TriaxialRotation::kMostSegments) +
                        " Taylor series");
}

std::shared_ptr<const TrajectoryLinearization> ClosedPath::linearise(const Motion& motion, int, int k, double t) const {
  return std::make_shared<ClosedPathLinearization>(motion, path_, k, path_.elapsedAt(t));
}

}  // namespace carom::adjoint_detail
