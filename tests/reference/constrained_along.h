// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/motion/motion.h"
#include "tests/reference/constrained_series.h"

namespace carom::reference {

/// The held paths of the first body that go on for a while, and how far.
struct ConstrainedSpan {
  const adjoint_detail::ConstrainedPath* path;
  std::size_t arc;
  double until;

  bool any(auto what) const { return std::ranges::any_of(path->contacts(), what); }
};
std::vector<ConstrainedSpan> constrainedPathsOf(const Motion& motion);

ConstrainedState stateOf(const BodyModel& model, const State& s);
ConstrainedBody bodyOf(const adjoint_detail::ConstrainedPath& path);

/// The corners of a box that a path holds, to all digits. Throws std::runtime_error where it holds something else.
std::vector<ConstrainedCorner> cornersOf(const adjoint_detail::ConstrainedPath& path, const Vec3& size);

/// Series after series from a start on, as it is projected: states at times that grow.
class ConstrainedAlong {
 public:
  ConstrainedAlong(const ConstrainedBody& body, std::vector<ConstrainedCorner> corners, const ConstrainedState& start, const Real& time, int order,
            const Real& tolerance);

  ConstrainedState at(const Real& time);

 private:
  Real next() const;

  ConstrainedSeries series_;
  Real time_;
};

}  // namespace carom::reference
