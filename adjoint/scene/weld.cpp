// SPDX-License-Identifier: MIT
#include "adjoint/scene/weld.hpp"

#include <algorithm>
#include <numeric>

namespace carom::adjoint_detail {

std::vector<int> firstOfEqual(const std::vector<Vec3>& points) {
  const auto at = [&](int i) -> const Vec3& { return points[static_cast<std::size_t>(i)]; };
  std::vector<int> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    for (int k = 0; k < 3; ++k)
      if (at(a)[k] != at(b)[k]) return at(a)[k] < at(b)[k];
    return a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && at(order[i]) == at(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

}  // namespace carom::adjoint_detail
