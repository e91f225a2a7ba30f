// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adjoint/constrained/carrier.hpp"
#include "adjoint/group/group_path.hpp"
#include "adjoint/simulate/event_queue.hpp"
#include "adjoint/simulate/path_transition.hpp"
#include "adjoint/simulate/supported_component.hpp"

/// How bodies in lasting contact go on after an event.
namespace carom::adjoint_detail {

/// How a body in lasting contact goes on: where it is held, by bodies that stand still or move as they are given to, and until when.
struct BodyContactState {
  std::vector<Contact> held;
  double transition = EventQueue::kNever;
  PathTransition why;
  std::size_t steps = 0;  // of an integrated path: of those the above is
};

/// Rest on a carrier, for as long as that holds what it carries, or they are on it.
struct Ride {
  Carrier carrier;
  double until = 0;  // s
  std::optional<Contact> leaving;  // comes to the end of a belt then
  int limit = -1;                  // of BodyGeometry::limits, that it comes to
};

/// Of a component at rest, what one of its bodies is held by, and with what state.
struct RestingMember {
  State state;
  std::vector<Contact> held;
  bool opposed = false;  // every motion of the component slips or opens a contact that bears a load
  std::optional<Ride> ride;
};
struct RestingComponent {
  std::vector<SupportedComponent::Member> members;
  std::vector<Contact> on;
  bool opposed = false;
  std::optional<Ride> ride;
};

/// Of a body that moves in contact with others that do.
struct GroupMembership {
  std::shared_ptr<GroupPath> path;
  int slot = 0;
  std::vector<Contact> held;
};

/// A group a little beyond the end of its path, in the modes that end.
struct GroupBeyond {
  std::vector<int> bodies;
  std::vector<State> states;
  double time = 0;
};

/// How a contact moves against a border of a feature of one of its bodies.
struct BorderMotion {
  double inside = 0;  ///< m, from the border
  double rate = 0;    ///< m/s, of that
  double speed = 0;   ///< m/s, of the place of contact on the body
};

}  // namespace carom::adjoint_detail
