// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/constrained/constrained_contact.hpp"
#include "adjoint/constrained/support.hpp"

namespace carom::adjoint_detail {

/// A contact of a body of a group with another one, or with what impulses do not move.
struct GroupContact {
  int a = -1, b = -1;                ///< bodies, a < b
  int member_a = -1, member_b = -1;  ///< their places in the group; -1: of what does not belong to it
  FeaturePair features;              ///< frozen
  ContactMode mode = ContactMode::sticks;
  double friction = 0;       ///< coefficient
  bool begins = false;       ///< it slides from no slip on
  Vec3 slip = Vec3::Zero();  ///< unit, of a against b, the direction of its slip at the start; 0 where it sticks

  /// It has no slip at the start.
  bool stands() const { return mode == ContactMode::sticks || begins; }
  bool turns() const { return mode == ContactMode::slides && friction > 0; }
};

struct GroupMember {
  int body = -1;
  std::shared_ptr<const BodyModel> model;
  Vec3 gravity = Vec3::Zero();  ///< m/s^2, its gravity factor included
};

/// Bodies that move in lasting contact with each other, as far as they stay the same along a path.
struct GroupScene {
  std::shared_ptr<const ContactGeometry> geometry;
  std::vector<GroupMember> members;
  std::vector<Support> with;  ///< a contact each, of the body that is no member; unused between members
  double time = 0;            ///< s, at which the path begins
  double length = 1;          ///< m, of the smallest member
  double size = 1;            ///< m, that of positions: what their rounding is of
  double speed = 1;           ///< m/s, that they get by falling as far as they are large, or that they have

  double pull() const { return speed * speed / length; }  ///< m/s^2
  /// N: what is a large force at a contact.
  double forceUnit(const GroupContact& c) const {
    double mass = kInfinity;
    for (const int m : {c.member_a, c.member_b})
      if (m >= 0) mass = std::min(mass, members[static_cast<std::size_t>(m)].model->mass);
    return mass * pull();
  }
};

}  // namespace carom::adjoint_detail
