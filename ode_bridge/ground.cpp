// SPDX-License-Identifier: MIT
#include "ode_bridge/ground.hpp"

#include <algorithm>
#include <numeric>

namespace carom::ode_bridge_detail {
namespace {

using Standing = Ground::Standing;

// Boxes have room for rounding and for the tolerance of contact.
bool meet(const Standing& a, const Standing& b) {
  if (a.half_space && b.half_space) return true;
  if (b.half_space) return meet(b, a);
  if (!a.half_space) return (a.box.low.array() <= b.box.high.array()).all() && (b.box.low.array() <= a.box.high.array()).all();
  const Vec3 lowest = (a.normal.array() > 0).select(b.box.low, b.box.high);
  return a.normal.dot(lowest) <= a.offset;
}

}  // namespace

void Ground::begin(std::size_t count, std::vector<Standing> standing) {
  standing_ = std::move(standing);
  touched_.clear();
  entry_.assign(count, -1);
  at_.assign(count, -1);
  for (std::size_t i = 0; i < standing_.size(); ++i) at_[static_cast<std::size_t>(standing_[i].body)] = static_cast<int>(i);
  if (standing_.size() < 2) return;
  // half spaces first, then by where boxes begin along x
  std::vector<std::size_t> order(standing_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto begins = [&](std::size_t i) { return standing_[i].box.low.x(); };
  std::ranges::sort(order, [&](std::size_t i, std::size_t j) {
    const bool plane_i = standing_[i].half_space, plane_j = standing_[j].half_space;
    return plane_i != plane_j ? plane_i : !plane_i && begins(i) < begins(j);
  });
  const auto touches = [&](const Standing& of, const Standing& other) {
    int& entry = entry_[static_cast<std::size_t>(of.body)];
    if (entry < 0) entry = static_cast<int>(touched_.size()), touched_.emplace_back();
    touched_[static_cast<std::size_t>(entry)].bodies.push_back(other.body);
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Standing& a = standing_[order[i]];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Standing& b = standing_[order[j]];
      if (!a.half_space && begins(order[j]) > a.box.high.x()) break;
      if (meet(a, b)) touches(a, b), touches(b, a);
    }
  }
  for (Touched& each : touched_) {
    std::ranges::sort(each.bodies);
    for (int body : each.bodies) each.placed.push_back(placedOf(body));
  }
}

std::span<const int> Ground::beside(int body) const {
  const int entry = entry_[static_cast<std::size_t>(body)];
  if (entry < 0) return {};
  return touched_[static_cast<std::size_t>(entry)].bodies;
}

const Placed* Ground::placedOf(int body) const {
  const int at = at_[static_cast<std::size_t>(body)];
  return at < 0 ? nullptr : &standing_[static_cast<std::size_t>(at)].placed;
}

GroundBeside Ground::besideOf(int a, int b) const {
  if (touched_.empty()) return {};
  for (const int body : {a, b})
    if (const int entry = entry_[static_cast<std::size_t>(body)]; entry >= 0)
      return {body == a, touched_[static_cast<std::size_t>(entry)].placed};
  return {};
}

}  // namespace carom::ode_bridge_detail
