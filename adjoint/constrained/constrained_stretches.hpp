// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_inputs.hpp"
#include "adjoint/constrained/straight_slips.hpp"

/// The pieces of a path over which derivatives are taken in one go, and how its slopes vary at their nodes.
namespace carom::adjoint_detail {

/// A piece of a step, and of each contact the direction that its slip keeps, 0 where it follows. What a slip u has across
/// its direction goes as a power of |u|, also where the path itself is straight, and polynomials follow that only while |u|
/// does not change by much.
struct ConstrainedStretch {
  const ConstrainedStep* step;
  double from, until;
  std::vector<Vec3> straight;
};

/// Those from the start of a path to a time, in order.
std::vector<ConstrainedStretch> stretchesUntil(const ConstrainedPath& path, double t);

/// Derivatives of the slopes (x, theta, v, L) of the tangent where the state is `state` at time t, by the tangent of the state there
/// and the other inputs: 12 rows. `slip`: of each contact the direction that its slip keeps.
Eigen::MatrixXd slopeRates(const ConstrainedPath& path, const ConstrainedInputs& inputs, const State& state, double t,
                           const std::vector<Vec3>& slip);

/// Across the slip of a contact, along its face.
inline Vec3 acrossSlip(const ConstrainedInstant& now, std::size_t k) { return now.contacts[k].n.cross(now.contacts[k].slip); }

}  // namespace carom::adjoint_detail
