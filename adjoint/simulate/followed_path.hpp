// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/simulate/path_arc.hpp"

namespace carom::adjoint_detail {

/// What a body in lasting contact is held by, where its path follows that of another motion.
struct FollowedPath {
  std::vector<Contact> contacts;
  PathTransition transition;

  /// When the contact that the event `was` begins with comes to the border that it came to, in seconds from the start of
  /// the arc.
  std::optional<double> leaves(const Motion& motion, const Arc& arc, const Event& was) const {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      if (!(contacts[k].features == was.contacts[0].features)) continue;
      const auto contact = static_cast<int>(k);
      if (transition.cause == was.cause && transition.contact == contact && transition.limit == was.border)
        return transition.elapsed;
      const ContactChoice choice =
          contactPathOf(motion, arc.path()->body, arc.startState(), pointersTo(contacts), arc.path()->form);
      return whenContactLeaves(motion, choice, contact, was.border, motion.duration - arc.start());
    }
    return std::nullopt;
  }
};

}  // namespace carom::adjoint_detail
