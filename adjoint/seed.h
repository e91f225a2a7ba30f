#pragma once

#include "adjoint/derivative_tape.h"

namespace carom {

/// The terms of BodyState as functions of the integrator's state:
///   position p = x - c_W, c_W = R_WG c:  dp = dx - theta x c_W - R_WG dc;
///   omega = A L, A = R D R^T, D = diag(1/I):  domega = A dL + theta x omega - A (theta x L) - R D dJ D R^T L.
/// Adjoint of a state from a seed; adds the direct dependence on centre and inertia to `model_bar`.
StateDerivative seedPullback(const BodyModel& model, const State& state, const StateSeed& seed,
                             BodyModelDerivative& model_bar);
/// d position, d omega.
Vec3 originTangent(const BodyModel& model, const State& state, const StateDerivative& dstate,
                   const BodyModelDerivative& dmodel);
Vec3 angularVelocityTangent(const BodyModel& model, const State& state, const StateDerivative& dstate,
                            const BodyModelDerivative& dmodel);

/// Where an instant falls on the world-line of a body: arc, state there. Throws InputError where the motion does not
/// reach, or where the body has no part in the event.
struct ReadPlace {
  int arc = 0;
  State state;
};
ReadPlace readPlace(const Motion& motion, int body, const Instant& instant);

}  // namespace carom
