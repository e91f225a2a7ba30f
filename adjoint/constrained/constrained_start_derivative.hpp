// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/constrained_inputs.hpp"

/// The start of a path, differentiated: see constrainedStart.
namespace carom::adjoint_detail {

using ConstrainedRow = Eigen::RowVectorXd;  ///< by the columns of ConstrainedInputs, of which the first 12 are a state

/// 12 rows, and that of its time. Slips that begin with an acceleration u' are 0 at the start, whenever it is; what the state
/// at a fixed time has of them tells how far the start is moved: dt = -u' . du / |u'|^2.
struct ConstrainedStartDerivative {
  Eigen::MatrixXd state;
  ConstrainedRow time;
  Eigen::VectorXd shift;  ///< of the other inputs with that time; empty: none

  /// Of rows by the inputs, what that makes of them.
  void addShift(const Eigen::MatrixXd& rows, Eigen::MatrixXd& sum) const {
    if (shift.size() > 0) sum += (rows * shift) * time;
  }
};
ConstrainedStartDerivative constrainedStartDerivative(const ConstrainedPath& path, const ConstrainedInputs& inputs);

/// Where ConstrainedPath::stopsSpeeds: what that does to a tangent of the state at the time of its own at which the path starts, 12 rows
/// by the inputs. It has to be done there: at a fixed time speeds have a tangent as the path starts earlier or later too, and
/// from that of a slip which begins ConstrainedStartDerivative knows when it does.
Eigen::MatrixXd constrainedStop(const ConstrainedPath& path, const ConstrainedInputs& inputs);

/// No directions of their own: slips are followed.
inline std::vector<Vec3> followSlips(const ConstrainedPath& path) {
  return std::vector<Vec3>(path.contacts().size(), Vec3::Zero());
}

}  // namespace carom::adjoint_detail
