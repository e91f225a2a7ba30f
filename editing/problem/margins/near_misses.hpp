// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "editing/problem/edit_problem.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Two bodies that pass each other, between their impacts, without meeting.
struct NearMiss {
  double gap = 0;     ///< least distance of their shapes, m
  double length = 0;  ///< of the smaller one of the two, m
  Eigen::VectorXd gradient;  ///< of the gap, by the changes of the controls
};

/// The pairs of bodies that pass nearest to each other, by the length of the smaller one, up to the last instant that
/// counts for the constraints: at most `most` of them, the nearest first. Left out is what nothing that varies has an
/// influence on. `tape` is of a motion simulated at the unknowns, `rows` what the constraints read from it.
std::vector<NearMiss> nearMisses(const EditProblem& problem, const Eigen::VectorXd& unknowns, DerivativeTape& tape,
                                 const RowValues& rows, std::size_t most);

}  // namespace carom::editing_detail
