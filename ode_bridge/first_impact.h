#pragma once

#include <optional>
#include <vector>

#include "ode_bridge/narrow_phase.h"
#include "ode_bridge/separation.h"

namespace carom {

/// The two bodies of a search, their solids and motions.
struct PairMotion {
  int a, b;
  const FeatureGeometry& geometry;
  const NarrowPhase& narrow_phase;
  Arc& arc_a;
  Arc& arc_b;
};

/// Feature pairs that touch (|gap| <= tolerance) at the instant of a and b: more than one where an edge or a face lies
/// on a face. `witness` is that of the instant; its own pair is the answer where no other is found.
std::vector<FeaturePair> touchingFeatures(const Placed& a, const Placed& b, const Witness& witness, double tolerance);

/// First impact of the pair in [from, until]: steps that provably cannot pass a contact, up to contact within rounding,
/// then Newton on the smooth gap of each touching feature pair. Separations of less than `touchTolerance` are contact.
std::optional<PredictedImpact> findFirstImpact(const PairMotion& pair, double from, double until);

/// Length below which a separation cannot be told from contact, for bodies where these are, m.
double touchTolerance(const Placed& a, const Placed& b);

}  // namespace carom
