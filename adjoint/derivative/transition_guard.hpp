// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/event_guard.hpp"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/motion/motion.h"

/// What the guard of a transition is made of, see EventGuard.
namespace carom::adjoint_detail {

/// Of body a relative to b at the first contact, where the slip of the path that the event ends comes to 0.
Vec3 slipDirectionAtEnd(const Motion& motion, const Event& event);
/// Of the trajectory that the event ends; null where the guard is that of the contacts.
std::shared_ptr<const PathGuard> pathGuardOf(const Motion& motion, const Event& event);
/// The border that the first contact comes to. Throws NotComputable where the event has another cause.
FeatureLimit borderOf(const Motion& motion, const Event& event);

}  // namespace carom::adjoint_detail
