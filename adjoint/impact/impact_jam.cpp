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

}  // namespace

// min b.X over X = Z y, Z those that move nothing, with mu n.X >= |X_t| at every contact and sum n.X <= 1.
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
  const ThinSvd svd(K);
  Index rank = 0;
  while (rank < svd.s.size() && svd.s[rank] > kMovesNothing * svd.s[0]) ++rank;
  const Eigen::MatrixXd Z = svd.V.rightCols(svd.V.cols() - rank);
  const double fastest = b.cwiseAbs().maxCoeff();
  if (Z.cols() == 0 || !(fastest > 0)) return false;
  std::vector<int> cones;
  Index rows = 1;
  for (const double mu : friction) cones.push_back(mu > 0 ? 3 : 1), rows += cones.back();
  cones.push_back(1);
  Eigen::MatrixXd D(rows, Z.cols());
  Eigen::VectorXd a = Eigen::VectorXd::Zero(rows), pushes = Eigen::VectorXd::Zero(Z.cols());
  Index at = 0;
  for (Index k = 0; k < n; ++k) {
    const Vec3 &axis = normal[static_cast<std::size_t>(k)], across = axis.unitOrthogonal();
    const double mu = friction[static_cast<std::size_t>(k)];
    const auto block = Z.middleRows(3 * k, 3);
    const Eigen::RowVectorXd pressing = axis.transpose() * block;
    pushes += pressing.transpose();
    if (!(mu > 0)) {
      D.row(at++) = pressing;
      continue;
    }
    D.row(at) = mu * pressing;
    D.row(at + 1) = across.transpose() * block;
    D.row(at + 2) = axis.cross(across).transpose() * block;
    at += 3;
  }
  D.row(rows - 1) = -pushes.transpose();
  a[rows - 1] = 1;
  const Eigen::VectorXd cost = Z.transpose() * b / fastest;
  InteriorPoint point(D, a, cost, cones);
  for (int i = 0; i < kJamSteps; ++i) {
    point.step();
    const Eigen::VectorXd& y = point.unknowns();
    if (!y.allFinite() || !std::isfinite(point.gap())) return false;
    if (!(cost.dot(y) < -kOpposes)) continue;
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
