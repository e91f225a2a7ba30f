#pragma once

#include "adjoint/derivative_tape.h"

namespace carom {

/// The terms of BodyState (omega in place of L), as functions of the integrator's state: omega = A L, A = R diag(1/I)
/// R^T, domega = A dL + [theta]x omega - A [theta]x L + R diag(d(1/I)) R^T L. Adjoint of a state from a seed; adds the
/// direct dependence of omega on the moments to `model_bar`.
StateDerivative seedPullback(const BodyModel& model, const State& state, const StateSeed& seed,
                             BodyModelDerivative& model_bar);
/// d omega.
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
