// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/law.hpp"

namespace carom::adjoint_detail {

/// The impulse of equation 4.2 before the friction cone cuts it back, P = (1+e) P_I + (1+e_t)(P_II - P_I): the contact
/// sticks where it lies in the cone.
Vec3 untruncatedImpulse(const ContactProblem& problem);

/// Adjoint of a ContactProblem; that of `pair.friction` stays 0, for the impulse does not depend on it.
struct ContactProblemBar {
  Mat3 K = Mat3::Zero();
  Vec3 u = Vec3::Zero(), normal = Vec3::Zero();
  PairCoefficients pair;
};
ContactProblemBar untruncatedImpulsePullback(const ContactProblem& problem, const Vec3& P_bar);

}  // namespace carom::adjoint_detail
