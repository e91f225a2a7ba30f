// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "adjoint/motion/motion.h"
#include "bench/edits/tasks.h"
#include "editing/problem/edit_problem.hpp"

namespace carom::bench {

/// Whether the first `count` impacts are ordinary ones: single, and far from grazing and from the boundary of stick and
/// slip.
bool isPlain(const Motion& motion, std::size_t count);

/// Whether two bodies touch in the first `count` events.
bool meets(const Motion& motion, std::size_t count, const std::string& body, const std::string& other);

/// Ends a little after the last constraint. An impact whose time is free may come later under way.
double durationFor(const std::vector<Constraint>& constraints, double last);

/// Largest scaled residual of the constraint that is met best.
double smallestMiss(const editing_detail::ConstraintSet& constraints, const editing_detail::RowValues& rows);

/// Largest scaled residual of all rows; 0 where impacts alone are held.
double largestMiss(const editing_detail::RowValues& rows);

/// The dimensionless change of a number, weighted.
double changeOf(const editing_detail::Variable& variable, double value);

/// Whether the hidden values meet the rows of the task, which can be told apart there: TaskLimits. Fills in `growth` of
/// the task.
bool isReachable(Task& task, const Eigen::VectorXd& hidden_values, ContactSource& contacts);

}  // namespace carom::bench
