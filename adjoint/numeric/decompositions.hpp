// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

// Internal to the libraries: not installed, and no public header includes it.

/// Eigen's decompositions of matrices of doubles of any size, compiled in one file: in each of those who solve with
/// them they would take a second or two to compile.
namespace carom::adjoint_detail {

/// LU with rows exchanged, of a square matrix that has an inverse.
class PartialLu {
 public:
  PartialLu() = default;
  explicit PartialLu(const Eigen::MatrixXd& A);
  void compute(const Eigen::MatrixXd& A);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solveColumns(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

/// LU with rows and columns exchanged; pivots up to `threshold` times the largest count as 0.
class FullLu {
 public:
  FullLu(const Eigen::MatrixXd& A, double threshold);
  Eigen::Index rank() const;
  bool isInvertible() const;
  Eigen::MatrixXd kernel() const;  ///< a basis in its columns; none where there is only 0
  Eigen::MatrixXd solveColumns(const Eigen::MatrixXd& B) const;

 private:
  Eigen::FullPivLU<Eigen::MatrixXd> lu_;
};

/// QR with columns exchanged; pivots up to `threshold` times the largest count as 0.
class PivotingQr {
 public:
  PivotingQr(const Eigen::MatrixXd& A, double threshold);
  explicit PivotingQr(const Eigen::MatrixXd& A);  ///< with Eigen's threshold
  Eigen::Index rank() const;
  Eigen::VectorXi order() const;  ///< of the columns, the largest pivot first
  Eigen::MatrixXd Q() const;      ///< square
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;  ///< least squares

 private:
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};

/// QR of a matrix whose columns are independent.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& A);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;  ///< least squares
  /// x with A^T A x = A^T b + c, without the square of A.
  Eigen::VectorXd solveNormal(const Eigen::VectorXd& b, const Eigen::VectorXd& c) const;

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
};

/// The decomposition of that name: the solution of least norm among those of least squares, whatever the rank.
class CompleteOrthogonal {
 public:
  CompleteOrthogonal(const Eigen::MatrixXd& A, double threshold);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd pseudoInverse() const;

 private:
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> whole_;
};

/// A^-1 b and A^-1 of a symmetric A, by LDL^T.
Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd inverseOfSymmetric(const Eigen::MatrixXd& A);

/// A = U diag(s) V^T with as many columns as the smaller dimension of A has, s falling.
struct ThinSvd {
  explicit ThinSvd(const Eigen::MatrixXd& A);
  Eigen::MatrixXd U, V;
  Eigen::VectorXd s;
};

}  // namespace carom::adjoint_detail
