// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/motion/motion.h"
#include "adjoint/motion/rim_geometry.hpp"

namespace carom::adjoint_detail {

inline std::size_t asIndex(int i) { return static_cast<std::size_t>(i); }

/// Accelerations of a body that nothing touches: of its centre of mass, and angular.
struct FreeAcceleration {
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();
};
FreeAcceleration freeAcceleration(const BodyModel& model, const State& state, const Vec3& gravity);

/// A body at a contact: its state, and its accelerations unless it stays.
struct ContactSide {
  State state;
  std::optional<FreeAcceleration> acceleration;
};
/// Of a body that nothing touches.
ContactSide freeSide(const Motion& motion, int body, const State& state, double time);
/// Of a body that no contact moves: where it is at a time, and how it moves.
ContactSide givenSide(const Motion& motion, int body, double time);
/// Of the rim that is at a contact with a face, or for which a mark stands there.
std::optional<RimOnFace> rimOf(const Motion& motion, const Contact& contact);
/// Whether a contact is that of a rim which lies flat on a face at these poses: it has no lowest point of its own.
bool rimLiesFlat(const Motion& motion, const Contact& contact, const Pose& A, const Pose& B);
/// d^2(gap)/dt^2 of a contact.
double gapAcceleration(const Motion& motion, const Contact& contact, const ContactSide& a, const ContactSide& b);

/// When the endlessly many bounces would have come to an end that the capture of a single contact cuts short (11.12);
/// `after`: the states of the participants.
std::optional<double> settlesAt(const Motion& motion, const Event& event, const std::vector<State>& after);

}  // namespace carom::adjoint_detail
