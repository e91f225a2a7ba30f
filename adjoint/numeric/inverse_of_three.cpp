// SPDX-License-Identifier: MIT
#include "adjoint/numeric/inverse_of_three.hpp"

#include <Eigen/Cholesky>

#include "adjoint/numeric/double_double.hpp"

namespace carom::adjoint_detail {

template <class T>
M3<T> inverseOfThree(const M3<T>& A) {
  return Eigen::LDLT<M3<T>>(A).solve(M3<T>::Identity());
}

template M3<double> inverseOfThree(const M3<double>&);
template M3<DoubleDouble> inverseOfThree(const M3<DoubleDouble>&);

}  // namespace carom::adjoint_detail
