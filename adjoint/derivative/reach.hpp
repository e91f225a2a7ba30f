// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/derivative/tangent.h"

namespace carom::adjoint_detail {

/// How far a change of the scene along some directions comes: a body that one of them changes carries it from its
/// start, and an event of such bodies, or of such surfaces, hands it on to all that take part. What it does not reach
/// stays exactly as it is, to every order.
class Reach {
 public:
  Reach(const Motion& motion, const std::vector<const SceneTangent*>& directions);

  bool arc(int body, int k) const { return k >= first_arc_[static_cast<std::size_t>(body)]; }
  bool event(int index) const { return events_[static_cast<std::size_t>(index)]; }

 private:
  std::vector<int> first_arc_;  // of each body, that is reached
  std::vector<bool> events_;
};

}  // namespace carom::adjoint_detail

namespace carom {

/// tangent(tape, direction) where it is known how far the direction reaches: events beyond are passed over. Null: not
/// known.
MotionTangent tangent(DerivativeTape& tape, const SceneTangent& direction, const adjoint_detail::Reach* reach);

}  // namespace carom
