// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/derivative/tangent.h"

namespace carom::adjoint_detail {

/// Which arcs and events a change of the scene along some directions influences: a body that one of them changes
/// carries it from its start, and an event of such bodies, or of such surfaces, hands it on to all that take part. What
/// it does not influence stays exactly as it is, to every order.
class Influence {
 public:
  Influence(const Motion& motion, const std::vector<const SceneTangent*>& directions);

  bool arc(int body, int k) const { return k >= first_arc_[static_cast<std::size_t>(body)]; }
  bool event(int index) const { return events_[static_cast<std::size_t>(index)]; }

 private:
  std::vector<int> first_arc_;  // of each body, that is influenced
  std::vector<bool> events_;
};

}  // namespace carom::adjoint_detail

namespace carom {

/// tangent(tape, direction) where it is known what the direction influences: other events are passed over. Null: not
/// known.
MotionTangent tangent(DerivativeTape& tape, const SceneTangent& direction, const adjoint_detail::Influence* influence);

}  // namespace carom
