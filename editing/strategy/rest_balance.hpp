// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/problem/edit_problem.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Why a body cannot rest in the orientation that is asked for: all that it can touch is one fixed plane, and the line
/// of gravity through its centre of mass meets that plane outside of what it would stand on. (Contact forces f_i at
/// points x_i of the plane that balance gravity have sum f_i = -m g, and, about the point p of that line, sum (x_i - p)
/// x f_i = 0; its components in the plane are sum (n . f_i) (x_i - p) = 0 with n . f_i >= 0: p is a mean of the x_i,
/// whatever friction does.) Proven where gravity does not vary, nor do the plane or the size of the body. Where that
/// does not prove it: empty.
std::string whyItCannotBalance(const EditProblem& problem, double tolerance);

}  // namespace carom::editing_detail
