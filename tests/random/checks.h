// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "tests/random/brute_force.h"

namespace carom::brute {

/// What the checks of a motion found. `failures` holds a sentence each; the worst figures are kept in any case.
struct Findings {
  std::vector<std::string> failures;
  int events = 0, single = 0, joint = 0;
  int undecided = 0;  ///< events whose time, or whose very taking place, long double cannot settle: too near grazing
  int tied = 0;       ///< single contacts where two directions are equally good within 1e-9 m; either is accepted
  std::map<std::string, int> kinds;  ///< contacts by the shapes that met
  Real worst_time = 0, worst_flight = 0, worst_velocity = 0, worst_overlap = 0, worst_energy = 0, worst_gap = 0;

  void fail(const std::string& what) { failures.push_back(what); }
  void add(const Findings& other);
  std::string summary() const;
};

/// Every number of every event and sampled state is finite; no pair overlaps by more than 1e-9 m at any of `samples`
/// times over the motion, at any impact and 1e-7 s before and after it. Overlap is that of tests/random/solid.h.
void checkStates(const Motion& motion, int samples, Findings& findings);

/// Energy of the participants does not grow over an event; that of a body is constant in flight, and does not grow in
/// lasting contact.
void checkEnergy(const Motion& motion, Findings& findings);

/// The events are those that BruteForce finds when it starts afresh after each of them: the same pairs, within 1e-9 s;
/// the flights agree; velocities after single contacts follow from the law of tests/random/impact_law.h to 1e-10, and
/// the contacts of a joint impact meet what it asks of them as well. Up to the first event after which a contact lasts.
void checkSequence(const Motion& motion, Findings& findings);

}  // namespace carom::brute
