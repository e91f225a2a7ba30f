// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "adjoint/base/types.h"
#include "editing/problem/edit_problem.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Where the origin of a shape is to be: from `lower` to `upper`, which may be infinite.
struct PositionRange {
  std::array<double, 3> lower{-kInfinity, -kInfinity, -kInfinity}, upper{kInfinity, kInfinity, kInfinity};
  bool any = false;  ///< something is asked for
};

/// Whether a row is a component of a position.
bool readsPosition(const Row& row);

/// The place that a constraint asks for, with its tolerance.
PositionRange placeOf(const ConstraintSet& set, int constraint, double tolerance);

/// The least distance of two places.
double distanceOf(const PositionRange& a, const PositionRange& b);

/// Whether a control of a body varies one of these.
bool varies(const EditProblem& problem, const std::string& body, std::initializer_list<const char*> words);

}  // namespace carom::editing_detail
