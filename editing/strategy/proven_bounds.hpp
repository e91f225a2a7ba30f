// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/problem/edit_problem.hpp"

/// Proofs that no motion meets a constraint, from what holds in every motion; a sentence, or empty where nothing is proven.
/// Internal to editing/.
namespace carom::editing_detail {

/// An impact of two bodies that never collide: filters keep them apart, or neither moves.
std::string whyTheyNeverMeet(const EditProblem& problem);

/// A rest where nothing that can bear the body is within its reach. Proven where gravity acts and does not vary, nor do the
/// sizes of the body and the poses and sizes of all that it may collide with, which are fixed.
std::string whyItCannotRest(const EditProblem& problem, double tolerance);

}  // namespace carom::editing_detail
