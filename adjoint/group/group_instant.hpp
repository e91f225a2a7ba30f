// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/group/group_scene.hpp"

namespace carom::adjoint_detail {

/// The row, or column, of an index.
inline Eigen::Index rowAt(std::size_t i) { return static_cast<Eigen::Index>(i); }

struct MemberInstant {
  Vec3 x = Vec3::Zero(), v = Vec3::Zero(), L = Vec3::Zero(), w = Vec3::Zero(), gravity = Vec3::Zero();
  Mat3 A = Mat3::Zero();  ///< inverse inertia, world axes
  double inverse_mass = 0;
  Vec3 turning() const { return A * L.cross(w); }  ///< of w, without forces
};

/// A contact of a group at one instant. Forces are those on a.
struct GroupContactInstant {
  ContactMode mode = ContactMode::sticks;
  Vec3 n = Vec3::UnitZ(), point = Vec3::Zero();  ///< normal from b to a; the place
  Vec3 normal_rate = Vec3::Zero(), point_rate = Vec3::Zero();
  Vec3 u = Vec3::Zero();        ///< velocity of the material of a against that of b
  Vec3 driven_a = Vec3::Zero(), driven_b = Vec3::Zero();  ///< d/dt of that of what is no member
  double friction = 0, gap = 0;
  Vec3 slip = Vec3::Zero();     ///< unit direction, where it slides

  Vec3 push() const { return n - friction * slip; }
  Vec3 slipVelocity() const { return u - n.dot(u) * n; }
};

struct GroupInstant {
  std::vector<MemberInstant> members;
  std::vector<GroupContactInstant> contacts;
};

/// Of body a of contact k, or of b, at time t.
Pose poseOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, std::size_t k, bool of_a, double t);
/// All but the directions of slip at time t.
void placeInstant(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t,
                  GroupInstant& now);
GroupInstant instantOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t,
                       const std::vector<Vec3>& slip);

}  // namespace carom::adjoint_detail
