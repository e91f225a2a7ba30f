// SPDX-License-Identifier: MIT
#include "adjoint/impact/impact_jam.hpp"

#include <cmath>

#include "adjoint/contact/interior_point.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// Impulses that move bodies by less than this share of the others move nothing.
constexpr double kMovesNothing = 1e-12;
// By which the velocities are to oppose them, as a share of the fastest, and how far outside of the cones is rounding.
constexpr double kOpposes = 1e-6, kOutside = 1e-9;
constexpr int kJamSteps = 40;
// Where the least value may fall by no more than this, far below kOpposes, it is known.
constexpr double kSettled = 1e-8;

}  // namespace

// min b.X over X = B Z y, Z those that move nothing, with mu n.X >= |X_t| at every contact and sum n.X <= 1.
bool frictionGrows(const Eigen::MatrixXd& all_K, const Eigen::VectorXd& all_b, const std::vector<int>& contacts, const std::vector<Vec3>& normal,
                   const std::vector<double>& friction) {
  const auto n = static_cast<Index>(normal.size());
  Eigen::MatrixXd K(3 * n, 3 * n);
  Eigen::VectorXd b(3 * n);
  for (Index i = 0; i < n; ++i) {
    const Index from = 3 * contacts[static_cast<std::size_t>(i)];
    b.segment<3>(3 * i) = all_b.segment<3>(from);
    for (Index j = 0; j < n; ++j) K.block<3, 3>(3 * i, 3 * j) = all_K.block<3, 3>(from, 3 * contacts[static_cast<std::size_t>(j)]);
  }
  // X = B x: along the normal alone where there is no friction, so that the rows below tell all x apart
  std::vector<int> cones;
  for (const double mu : friction) cones.push_back(mu > 0 ? 3 : 1);
  Index unknowns = 0;
  for (const int size : cones) unknowns += size;
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3 * n, unknowns);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(unknowns), pushes_by = Eigen::VectorXd::Zero(unknowns);
  Index at = 0;
  for (Index k = 0; k < n; ++k) {
    const auto kk = static_cast<std::size_t>(k);
    const Vec3 &axis = normal[kk], across = axis.unitOrthogonal();
    B.block<3, 1>(3 * k, at) = axis;
    pushes_by[at] = 1;
    if (cones[kk] == 3) {
      scale[at] = friction[kk];
      B.block<3, 1>(3 * k, at + 1) = across;
      B.block<3, 1>(3 * k, at + 2) = axis.cross(across);
    }
    at += cones[kk];
  }
  const Eigen::MatrixXd moved = K * B;
  const ThinSvd svd(moved);
  Index rank = 0;
  while (rank < svd.s.size() && svd.s[rank] > kMovesNothing * svd.s[0]) ++rank;
  const double fastest = b.cwiseAbs().maxCoeff();
  if (rank >= svd.V.cols() || !(fastest > 0) || !svd.V.allFinite()) return false;
  const Eigen::MatrixXd Z = svd.V.rightCols(svd.V.cols() - rank);
  const Index rows = unknowns + 1;
  cones.push_back(1);
  Eigen::MatrixXd D(rows, Z.cols());
  D.topRows(unknowns) = scale.asDiagonal() * Z;
  Eigen::VectorXd a = Eigen::VectorXd::Zero(rows);
  const Eigen::VectorXd pushes = Z.transpose() * pushes_by;
  D.row(rows - 1) = -pushes.transpose();
  a[rows - 1] = 1;
  const Eigen::VectorXd cost = (B * Z).transpose() * b / fastest;
  InteriorPoint point(D, a, cost, cones);
  for (int i = 0; i < kJamSteps; ++i) {
    point.step();
    const Eigen::VectorXd& y = point.unknowns();
    if (!y.allFinite() || !std::isfinite(point.gap())) return false;
    if (!(cost.dot(y) < -kOpposes)) {
      const double lacks = point.gap() * static_cast<double>(cones.size()) + point.unbalanced();
      if (lacks < kSettled) return false;  // no X is opposed by more than that
      continue;
    }
    const Eigen::VectorXd s = D * y + a;
    bool within = true;
    Index row = 0;
    for (const int size : cones) {
      within = within && s[row] - (size == 3 ? s.segment<2>(row + 1).norm() : 0) >= -kOutside;
      row += size;
    }
    if (within) return true;
  }
  return false;
}

}  // namespace carom::adjoint_detail
