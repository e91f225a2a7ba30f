// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "editing/constraint.h"

/// When constraints hold, as instants of a motion. Internal to editing/ and formats/.
namespace carom::editing_detail {

using namespace adjoint_detail;

/// Just after the event with which a body comes to rest to stay so up to the end of the motion: the first after which
/// it only rests. 0 s where it rests without an event; nothing where it does not.
std::optional<Instant> findRest(const Motion& motion, int body);
/// What is meant by a time, an impact or a rest; `with` is the index of the other body, or -1. Nothing where the motion
/// does not have it, and for a span, whose time is chosen.
std::optional<Instant> findInstant(const Motion& motion, int body, const When& at, int with);
/// The same, looking for the other body by name.
std::optional<Instant> findInstant(const Motion& motion, int body, const When& at);

/// s
double timeOf(const Motion& motion, const Instant& instant);
/// Of a body, whether it takes part in the event or not.
BodyState stateAt(const Motion& motion, int body, const Instant& instant);

}  // namespace carom::editing_detail
