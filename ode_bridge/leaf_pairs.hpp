// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "ode_bridge/separation.hpp"

namespace carom::ode_bridge_detail {

/// Visits the pairs of pieces of two bodies whose balls are at most `distance` apart: visit(PlacedPiece, PlacedPiece).
template <class Visit>
void eachLeafPair(const Placed& a, const Placed& b, double distance, const Visit& visit) {
  std::vector<std::pair<int, int>> open{{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const Node &na = a.solid->nodes[static_cast<std::size_t>(i)], &nb = b.solid->nodes[static_cast<std::size_t>(j)];
    if (separationOf({&a, &na}, {&b, &nb}) > distance) continue;
    const bool leaf_a = na.piece >= 0, leaf_b = nb.piece >= 0;
    if (leaf_a && leaf_b) {
      visit(PlacedPiece{&a, &a.solid->pieces[static_cast<std::size_t>(na.piece)]},
            PlacedPiece{&b, &b.solid->pieces[static_cast<std::size_t>(nb.piece)]});
    } else if (leaf_b || (!leaf_a && na.radius >= nb.radius)) {
      open.push_back({na.right, j});
      open.push_back({na.left, j});
    } else {
      open.push_back({i, nb.right});
      open.push_back({i, nb.left});
    }
  }
}

}  // namespace carom::ode_bridge_detail
