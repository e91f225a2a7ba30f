// SPDX-License-Identifier: MIT
#include "ode_bridge/contact_at.hpp"

#include <algorithm>

#include "ode_bridge/rounding.hpp"

namespace carom::ode_bridge_detail {

ContactPoint contactAt(const Placed& a, const Placed& b, const FeaturePair& f) {
  const auto kind = static_cast<GapKind>(f.kind);
  return contactOf(kind, placeFeature(a.solid->feature(familyOfFirst(kind), f.a), {a.k.x, a.k.R}),
                   placeFeature(b.solid->feature(familyOfSecond(kind), f.b), {b.k.x, b.k.R}), f.sign);
}

double touchTolerance(const Placed& a, const Placed& b) {
  double scale = 0;
  for (const Placed* p : {&a, &b})
    if (!p->solid->plane) scale = std::max({scale, p->k.x.cwiseAbs().maxCoeff(), p->solid->bound()});
  return kTouch * scale;
}

}  // namespace carom::ode_bridge_detail
