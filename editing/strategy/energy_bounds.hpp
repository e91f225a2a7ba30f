// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/base/types.h"
#include "editing/problem/edit_problem.hpp"

/// Proofs by energy that no motion meets a constraint; a sentence, or empty where nothing is proven. Internal to editing/.
///
/// Impacts, friction and persistent contact take energy and give none. With m mass, f gravity factor, T kinetic energy at the
/// bounds of the controls, h height of the centre of mass, h_min the lowest that it can come to, of a body i at any time
///   T_i + m_i g f_i (h_i - h_min,i) <= sum_j (T_j(0) + m_j g f_j (h_j(0) - h_min,j)) = E
/// Proven where gravity is along -z, velocities, spins and coefficients alone vary, no kinematic body and no surface moves, no normal
/// is tilted, and below each moving body, but for the one whose height is asked for, there is a fixed horizontal plane that it
/// collides with.
namespace carom::editing_detail {

/// What energy allows the centre of mass of a body that moves.
struct CenterLimits {
  Vec3 start = Vec3::Zero();  ///< where it is, m
  double speed = 0;           ///< at most, m/s
  double lowest = 0;          ///< h_min, m
  double highest = 0;         ///< m
  double offset = 0;          ///< of the origin of the shape from it, m
};
/// Nothing where the bound is none.
std::optional<CenterLimits> centerLimits(const EditProblem& problem, int body);

/// A height above h_min,i + E / (m_i g f_i).
std::string whyItIsTooHigh(const EditProblem& problem, double tolerance);

/// A speed, a component of a velocity, an angular velocity or a kinetic energy above what E allows: sqrt(2 E / m_i), E, and
/// sqrt(2 E / I_i) with the smallest principal moment.
std::string whyItIsTooFast(const EditProblem& problem, double tolerance);

/// A place farther from the start, or from another place that is asked for, than that speed leads to in the time between.
std::string whyItIsTooFar(const EditProblem& problem, double tolerance);

}  // namespace carom::editing_detail
