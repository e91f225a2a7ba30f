// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/simulate/contact_modes.hpp"

namespace carom::adjoint_detail {

struct PathTransition {
  double elapsed = kInfinity;  ///< s from the start of the path
  TransitionCause cause = TransitionCause::none;
  int contact = -1;  ///< of those of the path, that leaves
  int limit = -1;    ///< of BodyGeometry::limits, that it reaches
};

/// The first one within `until` seconds from the start of a path that rests on `contacts`.
PathTransition firstTransition(const Motion& motion, const ContactChoice& choice, double until);
/// When a contact of the path comes to one of its limits, whatever comes before it.
std::optional<double> whenContactLeaves(const Motion& motion, const ContactChoice& choice, int contact, int limit,
                                        double until);

}  // namespace carom::adjoint_detail
