// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_contact.hpp"
#include "adjoint/constrained/constrained_dynamics.hpp"

namespace carom::adjoint_detail {

/// Contacts that stick may push against each other without moving anything: two along the line between them, several at
/// one corner as they like. Of all such shares the one that leaves most room in the least of the cones of friction, where a
/// lone contact would have room = mu n.f - |f_t|.
struct ConstrainedShare {
  std::vector<std::size_t> contact;  ///< of the path: those that stick, in their order
  std::vector<Vec3> push;            ///< N, on each; without sum and moment
  /// How the least room changes with the forces: by the sum of weight mu n.f + turn.f_t; weights have the sum 1.
  std::vector<double> weight;
  std::vector<Vec3> turn;
};

/// One of them, with the forces of some share.
struct ShareSide {
  Vec3 n, r, force;     ///< r: from the centre of mass
  double friction = 0;

  double room(const Vec3& push) const;
  double slope(const Vec3& push, const Vec3& along) const;  ///< of room, along a unit vector
};

/// None where nothing can be shared: a lone contact.
std::optional<ConstrainedShare> bestShare(const std::vector<ShareSide>& sides);

/// The share of all that stick, from any forces(k) that hold the body.
template <class S, class Forces>
std::optional<ConstrainedShare> shareOf(const std::vector<ContactInstant<S>>& contacts, const Forces& forces) {
  std::vector<std::size_t> sticking;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts[k].mode == ContactMode::sticks) sticking.push_back(k);
  if (sticking.size() < 2) return std::nullopt;
  const auto value = [](const V3<S>& v) -> Vec3 { return v.unaryExpr([](const S& x) { return valueOf(x); }); };
  std::vector<ShareSide> sides;
  for (const std::size_t k : sticking)
    sides.push_back({value(contacts[k].n), value(contacts[k].r), value(forces.force(k)), valueOf(contacts[k].friction)});
  std::optional<ConstrainedShare> share = bestShare(sides);
  if (share) share->contact = std::move(sticking);
  return share;
}

}  // namespace carom::adjoint_detail
