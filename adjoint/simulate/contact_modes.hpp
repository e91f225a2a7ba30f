// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

inline std::size_t asIndex(int i) { return static_cast<std::size_t>(i); }

/// How a body goes on after an event.
struct ContactChoice {
  /// Null: it flies, as nothing presses it on, or `beyond` says why no path is known for it.
  std::shared_ptr<ContactPath> path;
  State start;                           ///< of the path: what contact fixes of the state is exact
  std::vector<const Contact*> contacts;  ///< that last
  std::string beyond;                    ///< what the path would have to be, as the end of a sentence
};

/// Accelerations of a body that nothing touches: of its centre of mass, and angular.
struct FreeAcceleration {
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();
};
FreeAcceleration freeAcceleration(const BodyModel& model, const State& state, const Vec3& gravity);

/// The same where contacts that do not rub keep the body from what they are with; `closed` are those with n.u = 0, and
/// what they are with stays.
FreeAcceleration pressedAcceleration(const Motion& motion, int body, const State& state,
                                     const std::vector<const Contact*>& closed);

/// d^2(gap)/dt^2 of a contact whose bodies have these states and accelerations; null: a body that stays.
double gapAcceleration(const ContactGeometry& geometry, const BodyModel& model_a, const BodyModel& model_b,
                       const Contact& contact, const State& a, const State& b, const FreeAcceleration* accelerates_a,
                       const FreeAcceleration* accelerates_b);

/// When the endlessly many bounces would have come to an end that the capture of a single contact cuts short (11.9);
/// `after`: the states of the participants.
std::optional<double> settlesAt(const Motion& motion, const Event& event, const std::vector<State>& after);

/// The path of the given form that a body takes at the given contacts.
ContactChoice contactPathOf(const Motion& motion, int body, const State& state,
                            const std::vector<const Contact*>& contacts, PathForm form);

/// The path of a body from `state` on, where `closed` are its contacts that part without speed: rest wherever rest is
/// possible; sliding or rolling of what has a closed form (docs/equations.md section 11).
ContactChoice chooseContactPath(const Motion& motion, int body, const State& state,
                                const std::vector<const Contact*>& closed);

}  // namespace carom::adjoint_detail
