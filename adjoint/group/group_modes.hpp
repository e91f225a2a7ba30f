// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/group/group_forces.hpp"

namespace carom::adjoint_detail {

/// Which of the closed contacts of a group hold, and how.
struct GroupModes {
  std::vector<std::size_t> held;       ///< of the candidates, in their order
  std::vector<GroupContact> contacts;  ///< these, with mode and direction of slip
  bool redundant = false;              ///< their forces are not independent
  std::string unresolved;              ///< why none were found, as the end of a sentence
};

/// What is known of the modes before they are looked for.
struct GroupHint {
  double no_slip = 0;  ///< m/s: slips that are slower count as none
  /// The group a little later, and when, in the modes that end: at the transition itself several may hold.
  std::optional<std::pair<std::vector<State>, double>> beyond;
};

/// N >= 0 and alpha >= 0, complementary, with Coulomb's law at all contacts at once: (11.35). From the cone program of velocities without
/// slip, then with its shift, by Newton's method on the modes of all contacts.
GroupModes chooseGroupModes(const GroupScene& scene, const std::vector<GroupContact>& candidates, const std::vector<State>& states, double t,
                            const GroupHint& hint);

/// These contacts in the modes that they have, with the directions of their slips at states at time t. Throws NotComputable where slips that
/// begin have none.
std::vector<GroupContact> inSameModes(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t);

}  // namespace carom::adjoint_detail
