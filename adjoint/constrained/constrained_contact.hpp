// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "adjoint/constrained/support.hpp"

namespace carom::adjoint_detail {

/// What a contact does while it lasts: its bodies do not move against each other there, or one slides on the other.
enum class ContactMode : char { sticks, slides };

/// A contact of the body of a path with one that stands still, or moves as it is given to.
struct PersistentContact {
  int with = -1;           ///< the other body
  bool is_first = true;    ///< the path's body is the first one of the pair
  FeaturePair features;    ///< frozen
  ContactMode mode = ContactMode::sticks;
  double friction = 0;     ///< coefficient
  bool begins = false;     ///< it slides from no slip on
  Vec3 slip = Vec3::Zero();  ///< unit, the direction of its slip at the start of the path; 0 where it sticks

  /// It has no slip at the start.
  bool stands() const { return mode == ContactMode::sticks || begins; }
};

/// What a path depends on besides its start, as far as it stays the same all the time.
struct ConstrainedScene {
  std::shared_ptr<const ContactGeometry> geometry;
  std::shared_ptr<const BodyModel> model;
  int body = -1;
  Vec3 gravity = Vec3::Zero();       ///< m/s^2, the body's gravity factor included
  std::vector<Support> with;         ///< of each contact's other body
  double time = 0;                   ///< s, at which its path begins
  double length = 1;                 ///< m, the size of the body
  double size = 1;                   ///< m, that of positions: what their rounding is of
  double speed = 1;                  ///< m/s, that it gets by falling as far as it is large, or that it has

  bool isDriven() const {
    return std::any_of(with.begin(), with.end(), [](const Support& s) { return s.drives(); });
  }
  bool isCarried() const {
    return std::any_of(with.begin(), with.end(), [](const Support& s) { return s.moves(); });
  }
  /// At a time.
  ContactMotion contact(const PersistentContact& c, std::size_t k, const Pose& own, const PoseRate& moving, double t) const {
    if (with[k].moves()) {
      const Kinematics other = with[k].arc->kinematicsAt(t);
      return contact(c, own, moving, {other.x, other.R}, {other.v, other.w});
    }
    return contact(c, own, moving, with[k].pose, {});
  }
  ContactMotion contact(const PersistentContact& c, const Pose& own, const PoseRate& moving, const Pose& other,
                        const PoseRate& other_moving) const {
    return c.is_first ? geometry->motion(body, c.with, c.features, own, other, moving, other_moving)
                      : geometry->motion(c.with, body, c.features, other, own, other_moving, moving);
  }
  ContactJacobian jacobian(const PersistentContact& c, std::size_t k, const Pose& own, double t) const {
    const Pose other = with[k].poseAt(t);
    return c.is_first ? geometry->jacobian(body, c.with, c.features, own, other) : geometry->jacobian(c.with, body, c.features, other, own);
  }
};

}  // namespace carom::adjoint_detail
