// SPDX-License-Identifier: MIT
#include "adjoint/numeric/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace carom::adjoint_detail {

using Eigen::MatrixXd;
using Eigen::VectorXd;

PartialLu::PartialLu(const MatrixXd& A) : lu_(A) {}
void PartialLu::compute(const MatrixXd& A) { lu_.compute(A); }
VectorXd PartialLu::solve(const VectorXd& b) const { return lu_.solve(b); }
MatrixXd PartialLu::solveColumns(const MatrixXd& B) const { return lu_.solve(B); }
MatrixXd PartialLu::inverse() const { return lu_.inverse(); }

FullLu::FullLu(const MatrixXd& A, double threshold) : lu_(A) { lu_.setThreshold(threshold); }
Eigen::Index FullLu::rank() const { return lu_.rank(); }
bool FullLu::isInvertible() const { return lu_.isInvertible(); }
MatrixXd FullLu::kernel() const {
  if (lu_.dimensionOfKernel() == 0) return MatrixXd(lu_.cols(), 0);  // of which Eigen makes a column of 0
  return lu_.kernel();
}
MatrixXd FullLu::solveColumns(const MatrixXd& B) const { return lu_.solve(B); }

PivotingQr::PivotingQr(const MatrixXd& A, double threshold) : qr_(A) { qr_.setThreshold(threshold); }
PivotingQr::PivotingQr(const MatrixXd& A) : qr_(A) {}
Eigen::Index PivotingQr::rank() const { return qr_.rank(); }
Eigen::VectorXi PivotingQr::order() const { return qr_.colsPermutation().indices(); }
MatrixXd PivotingQr::Q() const { return qr_.householderQ(); }
VectorXd PivotingQr::solve(const VectorXd& b) const { return qr_.solve(b); }

VectorXd HouseholderQr::solveNormal(const VectorXd& b, const VectorXd& c) const {
  const Eigen::Index n = qr_.cols();
  const auto R = qr_.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  VectorXd rotated = b;
  rotated.applyOnTheLeft(qr_.householderQ().adjoint());
  const VectorXd half = R.transpose().solve(c);
  return R.solve(VectorXd(rotated.head(n) + half));
}
HouseholderQr::HouseholderQr(const MatrixXd& A) : qr_(A) {}
VectorXd HouseholderQr::solve(const VectorXd& b) const { return qr_.solve(b); }

CompleteOrthogonal::CompleteOrthogonal(const MatrixXd& A, double threshold) {
  whole_.setThreshold(threshold);  // its rank is decided while it is computed
  whole_.compute(A);
}
VectorXd CompleteOrthogonal::solve(const VectorXd& b) const { return whole_.solve(b); }
MatrixXd CompleteOrthogonal::pseudoInverse() const { return whole_.pseudoInverse(); }

VectorXd solveSymmetric(const MatrixXd& A, const VectorXd& b) { return A.ldlt().solve(b); }
MatrixXd inverseOfSymmetric(const MatrixXd& A) { return A.ldlt().solve(MatrixXd::Identity(A.rows(), A.cols())); }

ThinSvd::ThinSvd(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  U = svd.matrixU(), V = svd.matrixV(), s = svd.singularValues();
}

}  // namespace carom::adjoint_detail
