// SPDX-License-Identifier: MIT
#include "adjoint/constrained/slip_stop.hpp"

#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

// It is not further than this from that at a node, rad.
constexpr double kMostAlign = 0.01;
// What turns of directions do less to accelerations than this share decides nothing.
constexpr double kDecides = 1e-9;

}  // namespace

std::optional<Eigen::VectorXd> turnsAtStop(const Eigen::MatrixXd& J, const Eigen::VectorXd& r, double pull) {
  // where all turn alike and friction alone pulls, any direction is that of its acceleration: it stays
  if (!(J.cwiseAbs().maxCoeff() > kDecides * pull)) return std::nullopt;
  const bool each = FullLu(J, kDecides).rank() == J.rows();
  Eigen::VectorXd turn = -(each ? PartialLu(J).solve(r) : CompleteOrthogonal(J, kDecides).solve(r));
  if (!(turn.cwiseAbs().maxCoeff() < kMostAlign)) return std::nullopt;
  return turn;
}

}  // namespace carom::adjoint_detail
