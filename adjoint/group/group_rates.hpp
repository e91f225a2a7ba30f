// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/constrained/constrained_lanes.hpp"
#include "adjoint/group/group_inputs.hpp"
#include "adjoint/group/group_instant.hpp"

namespace carom::adjoint_detail {

/// An instant of a group in numbers that carry the rates along some of its inputs.
struct GroupLanes {
  static constexpr int kColumns = ConstrainedLanes::kColumns;  ///< at a time
  using Number = ConstrainedLanes::Number;
  struct Member {
    V3<Number> x, v, L, w, gravity;
    M3<Number> A, R;  // inverse inertia, world axes; shape axes to world
    Number inverse_mass;
    V3<Number> velocityAt(const V3<Number>& p) const { return v + w.cross(V3<Number>(p - x)); }
  };
  struct Contact {
    V3<Number> n, point, normal_rate, point_rate, u, driven_a, driven_b, slip;
    Number friction, gap;
    V3<Number> push() const { return n - slip * friction; }
  };
  std::vector<Member> members;
  std::vector<Contact> contacts;
};

/// Fills an instant of a group, at time t, and calls visit(lanes, first, count) for the columns first, first + 1, ... of GroupInputs until all
/// were there. `slip`: a direction for each contact that is kept as it is; a zero vector lets it follow the slip.
class GroupRates {
 public:
  GroupRates(const GroupScene& scene, const std::vector<GroupContact>& contacts, const GroupInputs& inputs, const std::vector<State>& states,
             double t, std::vector<Vec3> slip);

  template <class Visit>
  void each(const Visit& visit) {
    for (int first = 0; first < inputs_.count; first += GroupLanes::kColumns) {
      const int count = std::min(GroupLanes::kColumns, inputs_.count - first);
      visit(lanes(first, count), first, count);
    }
  }
  const GroupInstant& now() const { return now_; }
  /// The support of contact k.
  SupportInstant<GroupLanes::Number> support(std::size_t k, int first, int count) const {
    return inputs_.partners[static_cast<std::size_t>(inputs_.partner_of[k])].instant<GroupLanes::Number>(scene_.with[k], first, count, flows_[k]);
  }

 private:
  using Number = GroupLanes::Number;
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  /// Whether a contact slides in the direction in which it goes.
  bool follows(std::size_t k) const { return contacts_[k].mode == ContactMode::slides && slip_[k].isZero(0); }
  GroupLanes lanes(int first, int count) const;
  void placeMember(std::size_t m, int first, int count, GroupLanes::Member& out) const;
  void placeContact(std::size_t k, int first, int count, const GroupLanes& of, GroupLanes::Contact& out) const;
  void placeSide(std::size_t k, bool of_a, int first, int count, const V3<Number>& v, const V3<Number>& w, GroupLanes::Contact& out) const;
  std::optional<Vec6> poseBy(std::size_t k, bool of_a, int column) const;
  int sizeOf(std::size_t k, bool of_a, int column) const;

  const GroupScene& scene_;
  const std::vector<GroupContact>& contacts_;
  const GroupInputs& inputs_;
  const std::vector<State>& states_;
  std::vector<Vec3> slip_;
  GroupInstant now_;
  std::vector<SupportFlow> flows_;
  std::vector<ContactJacobian> jacobians_;
  std::vector<ContactJacobian> jacobian_rates_;  // as both bodies go their ways
};

}  // namespace carom::adjoint_detail
