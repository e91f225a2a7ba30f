// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/constrained/constrained_step.hpp"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Which of the contacts that are closed hold a body, and how.
struct ConstrainedModes {
  std::vector<std::size_t> held;       ///< of the candidates, in their order; empty: it flies
  std::vector<PersistentContact> contacts;   ///< these, with mode and direction of slip
  bool redundant = false;              ///< forces are those of least norm
  Vec3 acceleration = Vec3::Zero(), spin_rate = Vec3::Zero();  ///< of the body: m/s^2, rad/s^2
  std::string unresolved;              ///< why none were found, as the end of a sentence
};

/// What is known of the modes before they are looked for.
struct ModeHint {
  TransitionCause cause = TransitionCause::none;
  int contact = -1;  ///< of the candidates: the one that a transition is about
  double no_slip = 0;  ///< m/s: slips that are slower count as none, too
  /// The body a little later, and when, in the modes that end: at the transition itself both may hold.
  std::optional<std::pair<State, double>> beyond;
  std::vector<std::size_t> idle;  ///< of the candidates: they did not hold the body, and come to it only if they fall
};

/// N >= 0 and alpha >= 0, complementary, for all candidates, with Coulomb's law: (11.23). A slip slower than `no_slip`
/// counts as none. The answer is the one with as little slip as possible that is found first, in an order that does not
/// depend on anything but the candidates.
ConstrainedModes chooseModes(const ConstrainedScene& scene, const std::vector<PersistentContact>& candidates, const State& state,
                      const ModeHint& hint, double no_slip);

/// The modes of `contacts` as they are, from another state: the directions in which they begin to slip are found anew.
ConstrainedModes modesAs(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state);

}  // namespace carom::adjoint_detail
