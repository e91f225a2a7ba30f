// SPDX-License-Identifier: MIT
#include "adjoint/simulate/event_queue.hpp"

namespace carom::adjoint_detail {

void EventQueue::set(int body, double time, bool is_horizon) {
  const auto b = static_cast<std::uint32_t>(body);
  std::size_t i = leaves_ + b;
  tree_[i] = {time, is_horizon ? b | kHorizon : b};
  while ((i /= 2) > 0) {
    const Entry &left = tree_[2 * i], &right = tree_[2 * i + 1];
    const Entry* earlier = right < left ? &right : &left;
    tree_[i] = *earlier;
  }
}

}  // namespace carom::adjoint_detail
