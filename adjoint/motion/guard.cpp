// SPDX-License-Identifier: MIT
#include "adjoint/motion/guard.hpp"

#include <algorithm>

namespace carom::adjoint_detail {

std::vector<double> guardWeights(const Event& event) {
  std::vector<double> weights;
  double total = 0;
  for (const Contact& c : event.contacts) {
    weights.push_back(c.held ? 0 : std::max(0.0, c.impulse_normal.dot(c.impulse)));
    total += weights.back();
  }
  const auto meeting = std::ranges::count(event.contacts, false, &Contact::held);
  for (std::size_t k = 0; k < weights.size(); ++k)
    weights[k] = total > 0              ? weights[k] / total
                 : event.contacts[k].held ? 0.0
                                          : 1.0 / static_cast<double>(meeting);
  return weights;
}

int participantOf(const Event& event, int body) {
  const Participant* p = event.find(body);
  return p ? static_cast<int>(p - event.participants.data()) : -1;
}

Pose shapePose(const Motion& motion, int body, const State& state) {
  return {state.x, (*motion.models)[static_cast<std::size_t>(body)].shapeToWorld(state.q.toRotationMatrix())};
}

Pose poseBefore(const Motion& motion, const Event& event, int body) {
  const Participant* p = event.find(body);
  return shapePose(motion, body,
                   p ? p->before : motion.world_lines[static_cast<std::size_t>(body)].arcs[0].startState());
}

}  // namespace carom::adjoint_detail
