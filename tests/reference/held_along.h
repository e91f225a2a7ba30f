// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "adjoint/held/held_path.hpp"
#include "adjoint/motion/motion.h"
#include "tests/reference/held_series.h"

namespace carom::reference {

/// The held paths of the first body that go on for a while, and how far.
struct HeldSpan {
  const adjoint_detail::HeldPath* path;
  std::size_t arc;
  double until;

  bool any(auto what) const { return std::ranges::any_of(path->contacts(), what); }
};
std::vector<HeldSpan> heldPathsOf(const Motion& motion);

HeldState stateOf(const BodyModel& model, const State& s);
HeldBody bodyOf(const adjoint_detail::HeldPath& path);

/// The corners of a box that a path holds, to all digits. Throws std::runtime_error where it holds something else.
std::vector<HeldCorner> cornersOf(const adjoint_detail::HeldPath& path, const Vec3& size);

/// Series after series from a start on, as it is projected: states at times that grow.
class HeldAlong {
 public:
  HeldAlong(const HeldBody& body, std::vector<HeldCorner> corners, const HeldState& start, const Real& time, int order,
            const Real& tolerance);

  HeldState at(const Real& time);

 private:
  Real next() const;

  HeldSeries series_;
  Real time_;
};

}  // namespace carom::reference
