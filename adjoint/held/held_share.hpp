// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "adjoint/held/held_contact.hpp"
#include "adjoint/held/held_dynamics.hpp"

namespace carom::adjoint_detail {

/// Two contacts that stick may push against each other along the line between them as they like: nothing moves by it. Of
/// all such shares the one that leaves most room in the cones of friction, where a lone contact would have
/// room = mu n.f - |f_t|.
struct HeldShare {
  std::array<std::size_t, 2> contact{};  ///< of the path
  Vec3 along = Vec3::Zero();             ///< unit, from the first to the second
  double push = 0;                       ///< N, on the second one along that, and on the first one against it
  std::array<double, 2> room{};          ///< N, of each
  std::array<double, 2> weight{};        ///< of their rates in that of the smaller room

  Vec3 pushOn(std::size_t i) const { return (i == 0 ? -push : push) * along; }
};

/// One of the two, with the forces of some share.
struct ShareSide {
  Vec3 n, force, along;  ///< along: of the push, a unit vector
  double friction = 0;

  double room(double push) const;
  double slope(double push) const;  ///< of room
};

HeldShare bestShare(const ShareSide& a, const ShareSide& b);

/// The two contacts that stick, of which there are no more.
template <class S>
std::optional<std::array<std::size_t, 2>> stickingPair(const std::vector<ContactInstant<S>>& contacts) {
  std::array<std::size_t, 2> pair{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts[k].mode != HeldMode::sticks) continue;
    if (count == 2) return std::nullopt;
    pair[count++] = k;
  }
  if (count < 2) return std::nullopt;
  return pair;
}

/// The share of such a pair, from any forces(k) that hold the body; none where the two are in one place.
template <class S, class Forces>
std::optional<HeldShare> shareOf(const std::vector<ContactInstant<S>>& contacts, const Forces& forces) {
  const auto pair = stickingPair(contacts);
  if (!pair) return std::nullopt;
  const auto value = [](const V3<S>& v) -> Vec3 { return v.unaryExpr([](const S& x) { return valueOf(x); }); };
  const ContactInstant<S>&c = contacts[(*pair)[0]], &d = contacts[(*pair)[1]];
  const Vec3 between = value(d.r) - value(c.r);
  if (!(between.norm() > 0)) return std::nullopt;
  const Vec3 along = between.normalized();
  HeldShare share = bestShare({value(c.n), value(forces.force((*pair)[0])), -along, valueOf(c.friction)},
                              {value(d.n), value(forces.force((*pair)[1])), along, valueOf(d.friction)});
  share.contact = *pair, share.along = along;
  return share;
}

}  // namespace carom::adjoint_detail
