// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace carom::adjoint_detail {

/// Gauss collocation on [0, 1] with 12 nodes. Slopes are a polynomial of degree 11 through the nodes, in Legendre
/// polynomials P_k(2 t - 1); its integral is exact to order 24 at the end, and as good as that polynomial between.
struct Gauss {
  static constexpr int kNodes = 12;
  using Row = Eigen::Matrix<double, 1, kNodes>;
  using Square = Eigen::Matrix<double, kNodes, kNodes>;

  Row node, weight;    ///< where, and of the integral over [0, 1]
  Square legendre;     ///< P_k at node i: (i, k)
  Square coefficients; ///< slopes at the nodes to coefficients: (k, i)
  Square integral;     ///< A: slopes at the nodes to integrals from 0 to the nodes, (i, j)

  static const Gauss& get();

  /// P_k at t.
  static Row values(double t);
  /// The integrals of P_k from 0 to t.
  static Row integrals(double t);
};

}  // namespace carom::adjoint_detail
