// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/contact_source.h"

namespace carom::adjoint_detail {

/// What a contact does while it lasts: its bodies do not move against each other there, or one slides on the other.
enum class ContactMode : char { sticks, slides };

/// A contact of the body of a path with one that stands still.
struct PersistentContact {
  int with = -1;           ///< the body that stands still
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
  std::vector<Pose> with;            ///< of each contact's other body
  double length = 1;                 ///< m, the size of the body
  double size = 1;                   ///< m, that of positions: what their rounding is of
  double speed = 1;                  ///< m/s, that it gets by falling as far as it is large, or that it has

  ContactMotion contact(const PersistentContact& c, std::size_t k, const Pose& own, const Vec3& v, const Vec3& w) const {
    const PoseRate moving{v, w};
    return c.is_first ? geometry->motion(body, c.with, c.features, own, with[k], moving, {})
                      : geometry->motion(c.with, body, c.features, with[k], own, {}, moving);
  }
};

}  // namespace carom::adjoint_detail
