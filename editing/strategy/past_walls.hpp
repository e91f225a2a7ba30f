// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/problem/edit_problem.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Why a body does not get to the other side of a fixed box that stands along the axes: its centre of mass would have
/// to pass through the box, in which that of a convex body never is, or over, under or beside it, where neither its
/// energy nor its speed takes it until then (energy_bounds.hpp). Where that does not prove it: empty.
std::string whyItStaysBefore(const EditProblem& problem, double tolerance);

}  // namespace carom::editing_detail
