// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_inputs.hpp"

/// What becomes of tangents where slips end with a path. A slip has no tangent across its way there: whichever way it came,
/// it goes to 0 as a power of |u|. What is left is taken back by turns of the frictions of all that stop, which are all that
/// turns them there.
namespace carom::adjoint_detail {

/// Of the contacts whose slips are 0 at the end of a path.
struct SlipTurns {
  Eigen::MatrixXd across;                              ///< their slips across their ways, by all inputs at that time: a row each
  Eigen::MatrixXd turned;                              ///< the same by the turns of their frictions
  Eigen::Matrix<double, 6, Eigen::Dynamic> change;     ///< of (v, L) by these turns

  /// Turns that take `left` back, which is `across` by the inputs at the start: a row each of those that are needed.
  Eigen::MatrixXd takingBack(const Eigen::MatrixXd& left) const { return takingBack(turned, left); }

  /// Whether the first of them turns its own slip, not another one about which it goes round.
  static bool turns(const Eigen::MatrixXd& turned);
  static Eigen::MatrixXd takingBack(const Eigen::MatrixXd& turned, const Eigen::MatrixXd& left);
};
/// Nothing where none stops at t, or turns take nothing back.
std::optional<SlipTurns> slipTurns(const ConstrainedPath& path, const ConstrainedInputs& inputs, double t);

}  // namespace carom::adjoint_detail
