// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "adjoint/scene/scene.h"
#include "bench/edits/wanted.h"
#include "editing/constraint.h"
#include "editing/control.h"

namespace carom::bench {

/// What every task keeps to.
struct TaskLimits {
  /// Of throws with a start near by: the hidden throw differs from the start by this much: the norm of the changes of
  /// all numbers together, each in its own natural scale (the person's weights left out). Those that need another
  /// impact sequence may lie further.
  static constexpr double kNearest = 0.05, kFarthestSame = 0.5, kFarthestOther = 0.8;
  static constexpr double kSmallestMargin = 1e-3;  ///< of grazing and of stick and slip, of both motions
  static constexpr double kSmallestMiss = 1e-2;    ///< largest scaled residual of every constraint at the start
  /// Largest entry of the dimensionless Jacobian at the hidden throw.
  static constexpr double kLargestGrowth = 1e6;
  /// Smallest singular value of that Jacobian with rows of length 1: its rows are independent.
  static constexpr double kSmallestSingular = 1e-3;
};

/// One edit that can be met: the scene of a throw, what may vary, and what another throw (hidden from the solver) does.
struct Task {
  std::uint64_t seed = 0;
  int index = 0;
  Wanted wanted;
  Scene start;
  double duration = 0;
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
  std::vector<std::string> sequence;  ///< required: with which the motion begins, see beginsWith

  int numbers = 0, rows = 0;
  Eigen::VectorXd hidden_values;  ///< of the numbers that vary
  double hidden_distance = 0;     ///< TaskLimits::kNearest and so on
  double hidden_objective = 0;    ///< 1/2 |changes|^2, weighted: an upper bound of the smallest change
  double growth = 0;              ///< largest entry of the dimensionless Jacobian at the hidden throw
  double miss = 0;                ///< largest scaled residual at the start; infinite where it lacks a row
  int attempts = 0;               ///< draws until one kept to the limits
};

/// The same seed and index give the same task. Throws std::runtime_error where no draw keeps to the limits.
Task makeTask(std::uint64_t seed, int index);

}  // namespace carom::bench
