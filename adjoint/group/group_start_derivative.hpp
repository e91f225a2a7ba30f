// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/group/group_inputs.hpp"
#include "adjoint/group/group_path.hpp"

/// The start of the path of a group, differentiated: see groupStart.
namespace carom::adjoint_detail {

/// 12 rows a member, and that of its time, as ConstrainedStartDerivative.
struct GroupStartDerivative {
  Eigen::MatrixXd state;
  Eigen::RowVectorXd time;
  Eigen::VectorXd shift;  ///< of the other inputs with that time; empty: none

  /// Of rows by the inputs, what that makes of them.
  void addShift(const Eigen::MatrixXd& rows, Eigen::MatrixXd& sum) const {
    if (shift.size() > 0) sum += (rows * shift) * time;
  }
};
GroupStartDerivative groupStartDerivative(const GroupPath& path, const GroupInputs& inputs);

/// No directions of their own: slips are followed.
inline std::vector<Vec3> followSlips(const GroupPath& path) { return std::vector<Vec3>(path.contacts().size(), Vec3::Zero()); }

}  // namespace carom::adjoint_detail
