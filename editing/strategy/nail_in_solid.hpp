// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/problem/edit_problem.hpp"
#include "editing/why_not.h"

/// Internal to editing/.
namespace carom::editing_detail {

/// Nails at which the body would overlap a fixed body that nothing moves. A nail of place and orientation is tried with
/// the body itself, one of position alone with the largest ball about the shape's origin that the body contains
/// (ShapeKind::innerRadius). A component left free counts only before a plane that it runs along. Uses the
/// problem's source of contacts, which finds bodies that overlap.
std::vector<WhyNot::Inside> nailsInSolids(const EditProblem& problem, const Scene& scene);

/// "the nail of 'mug' at 1.2 s lies inside 'wall', which no motion can reach".
std::string describeInside(const WhyNot::Inside& inside);

}  // namespace carom::editing_detail
