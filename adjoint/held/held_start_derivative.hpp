// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/held/held_inputs.hpp"

/// The start of a path, differentiated: see heldStart.
namespace carom::adjoint_detail {

using HeldRow = Eigen::RowVectorXd;  ///< by the columns of HeldInputs, of which the first 12 are a state

/// 12 rows, and that of its time. Slips that begin with an acceleration u' are 0 at the start, whenever it is; what the state
/// at a fixed time has of them tells how far the start is moved: dt = -u' . du / |u'|^2.
struct HeldStartDerivative {
  Eigen::MatrixXd state;
  HeldRow time;
};
HeldStartDerivative heldStartDerivative(const HeldPath& path, const HeldInputs& inputs);

/// Where HeldPath::stopsSlips: what that does to a tangent of the state at the time of its own at which the path starts, 12 rows
/// by the inputs. It has to be done there: at a fixed time a slip has a tangent as it begins earlier or later too, and that is
/// how HeldStartDerivative knows it.
Eigen::MatrixXd heldStop(const HeldPath& path, const HeldInputs& inputs);

/// No directions of their own: slips are followed.
inline std::vector<Vec3> followSlips(const HeldPath& path) {
  return std::vector<Vec3>(path.contacts().size(), Vec3::Zero());
}
inline Eigen::Matrix<double, 12, 1> asVector(const StateDerivative& d) {
  return (Eigen::Matrix<double, 12, 1>() << d.x, d.theta, d.v, d.L).finished();
}

}  // namespace carom::adjoint_detail
