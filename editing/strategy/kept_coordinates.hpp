// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/problem/edit_problem.hpp"

/// Proofs by coordinates that no impact changes. Internal to editing/.
namespace carom::editing_detail {

/// In a sentence, why no motion has a position or a velocity that is asked for, or an impact of two bodies: the speed of the centre of
/// mass of a body along an axis of the world, perpendicular to gravity, is constant, as fixed planes parallel to that axis are all that
/// it can meet (until the two meet), and either without friction, or it is a uniform ball that neither moves nor spins across the mirror
/// plane perpendicular to the axis; or the body meets nothing before the time that is asked for (free_flight.hpp). Where that does not
/// prove it: empty.
std::string whyItStaysAway(const EditProblem& problem, double tolerance);

}  // namespace carom::editing_detail
