// SPDX-License-Identifier: MIT
#include "adjoint/held/held_dynamics.hpp"

#include "adjoint/base/errors.h"

namespace carom::adjoint_detail {

namespace {

// Forces of redundant contacts: what is smaller than this share of the largest pivot is rounding.
constexpr double kRank = 1e-10;

}  // namespace

Eigen::VectorXd solveForces(const Eigen::MatrixXd& B, const Eigen::VectorXd& b, bool redundant,
                            Eigen::MatrixXd* inverse) {
  if (!B.allFinite() || !b.allFinite()) throw NotComputable("forces at its contacts are beyond the range of doubles");
  if (B.rows() == 0) return {};
  if (B.rows() == 1 && !redundant) {
    if (inverse) *inverse = B.cwiseInverse();
    return -b / B(0, 0);
  }
  if (redundant) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> whole;
    whole.setThreshold(kRank);
    whole.compute(B);
    if (inverse) *inverse = whole.pseudoInverse();
    return -whole.solve(b);
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> whole(B);
  if (inverse) *inverse = whole.inverse();
  return -whole.solve(b);
}

}  // namespace carom::adjoint_detail
