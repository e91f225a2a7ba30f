// SPDX-License-Identifier: MIT
#include "adjoint/numeric/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

#include "adjoint/numeric/double_double.hpp"

namespace carom::adjoint_detail {

template <class T>
SymmetricEigen<T>::SymmetricEigen(const MatrixOf<T>& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixOf<T>> solver(A);
  values = solver.eigenvalues();
  vectors = solver.eigenvectors();
}

template struct SymmetricEigen<double>;
template struct SymmetricEigen<DoubleDouble>;

}  // namespace carom::adjoint_detail
