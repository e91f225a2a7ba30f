// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

/// The time of an impact whose features are known. Internal to adjoint/.
namespace carom::adjoint_detail {

/// The gap of an impact at some time, and what rounding leaves of it.
struct GuardValue {
  double gap = 0;    ///< m
  double rate = 0;   ///< d(gap)/dt, m/s; exact where the gap is 0
  double size = 0;   ///< of the coordinates that the gap is made of, m
  double speed = 0;  ///< of whatever moves, m/s
};

struct RootSearch {
  double from = 0;    ///< s; nothing before it
  double until = 0;   ///< s; beyond it a root is late, and not worked out
  double guess = 0;   ///< s; where the root is expected
  double stride = 0;  ///< s, > 0; in which the gap may change altogether: no first step is longer
};

struct GuardRoot {
  enum class Outcome {
    found,
    late,        ///< after `until`
    early,       ///< the bodies are in one another at `from` already
    none,        ///< they come no nearer, or pass without touching
    undefined,   ///< the gap is NaN
    unresolved,  ///< not found in as many steps as are allowed
  };
  Outcome outcome = Outcome::none;
  double time = 0;
  const char* why() const;  ///< "..., " the end of a sentence
};

/// The root of a gap where it falls from above, by Newton's method within a bracket, to rounding. Where the gap at the
/// guess is zero to rounding already, it is the guess.
GuardRoot descendingRoot(const RootSearch& search, const std::function<GuardValue(double)>& gapAt);

}  // namespace carom::adjoint_detail
