// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "ode_bridge/persistent_planes.hpp"
#include "ode_bridge/pair_motion.hpp"

namespace carom::ode_bridge_detail {

/// First impact of the pair in [from, until]: steps that provably cannot pass a contact, over balls that hold ever
/// fewer pieces, then over pieces, up to contact within rounding; then Newton on the smooth gap of each touching
/// feature pair. Separations of less than `touchTolerance` are contact. Throws NotComputable where numbers are not
/// finite, or steps so small that a million of them do not suffice; WorkEnded where the count of work says so.
/// `held`: features at which the bodies stay in contact all the time (see ContactSource::firstImpactBeside).
/// `elsewhere`: those at which the one that moves stays in contact with what stands beside the other one.
std::optional<PredictedImpact> findFirstImpact(const PairMotion& pair, double from, double until,
                                               std::span<const FeaturePair> held = {},
                                               std::span<const ConstrainedElsewhere> elsewhere = {});

}  // namespace carom::ode_bridge_detail
