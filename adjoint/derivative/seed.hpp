// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/derivative_tape.h"

namespace carom::adjoint_detail {

/// The terms of BodyState as functions of the integrator's state:
///   position p = x - c_W, c_W = R_WG c:  dp = dx - theta x c_W - R_WG dc;
///   omega = A L, A = R D R^T, D = diag(1/I):  domega = A dL + theta x omega - A (theta x L) - R D dJ D R^T L.
/// Adjoint of a state from a seed; adds the direct dependence on mass, centre and inertia to `model_bar`.
StateDerivative seedPullback(const BodyModel& model, const State& state, const StateSeed& seed,
                             BodyModelDerivative& model_bar);
/// d position, d omega.
Vec3 originTangent(const BodyModel& model, const State& state, const StateDerivative& dstate,
                   const BodyModelDerivative& dmodel);
Vec3 angularVelocityTangent(const BodyModel& model, const State& state, const StateDerivative& dstate,
                            const BodyModelDerivative& dmodel);

/// d(seed . state)/d(instant): the rate at which the reading changes when it is taken later in one and the same motion,
/// per second. Of an instant at an event: along the arc that it is read on, with the seed's weight of the time itself.
double timeDerivative(const Motion& motion, const StateSeed& seed);

/// Where an instant falls on the world-line of a body: time, arc, state there; of a body that takes part in the event,
/// just before or after it. Throws InputError where the motion does not reach.
struct ReadPlace {
  double time = 0;
  int arc = 0;
  State state;
};
ReadPlace readPlace(const Motion& motion, int body, const Instant& instant);
/// Whether it is just after an event that the body takes part in: at the start of an arc, which moves along.
bool startsArc(const Motion& motion, int body, const Instant& instant);

}  // namespace carom::adjoint_detail
