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

/// A height above what all the energy at the start can lift the body to. With m mass, f gravity factor, T kinetic energy at
/// the bounds of the controls, h height of the centre of mass, h_min the lowest that it can come to, i the body:
///   h_i <= h_i(0) + (sum_j T_j + sum_(j != i) m_j g f_j (h_j(0) - h_min,j)) / (m_i g f_i)
/// as impacts, friction and persistent contact take energy and give none. Proven where gravity is along -z, velocities,
/// spins and coefficients alone vary, no kinematic body moves, no normal is tilted, and below each other moving body there
/// is a fixed horizontal plane that it collides with.
std::string whyItIsTooHigh(const EditProblem& problem, double tolerance);

}  // namespace carom::editing_detail
