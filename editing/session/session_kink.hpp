// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// Boundaries of impact sequences that a motion crosses without a jump. Internal to editing/.
namespace carom::editing_detail {

/// The plane normal . y = offset in the space of the unknowns.
struct Kink {
  Eigen::VectorXd normal;  ///< a unit vector
  double offset = 0;
};

/// Where the rows are continuous across a boundary (an impact that comes to the time of a constraint, a slide that comes
/// to stick), their derivatives on its two sides differ by one rank: J_a - J_b = s u n^T. The boundary itself is, to
/// first order, where both linearisations agree: n . y = u . (v_b - v_a + J_a y_a - J_b y_b) / s, with v the rows'
/// values. Null when that plane does not part the two points, which are of different sequences and differentiated.
std::optional<Kink> kinkBetween(const EditProblem& problem, const EditPoint& a, const EditPoint& b);

/// Boundaries at which the motion jumps (an impact moves to another feature, or is missed), between `a`, which is of
/// another sequence than `b`, and b: to first order at a, and a little on its side of them.
std::vector<Kink> jumpsBetween(const EditProblem& problem, const EditPoint& a, const EditPoint& b);

}  // namespace carom::editing_detail
