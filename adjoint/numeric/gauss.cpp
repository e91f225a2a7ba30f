// SPDX-License-Identifier: MIT
#include "adjoint/numeric/gauss.hpp"

#include <cmath>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr int kDegree = Gauss::kNodes;

// P_0 to P_n at x in [-1, 1].
Eigen::Matrix<double, 1, kDegree + 1> legendreAt(double x) {
  Eigen::Matrix<double, 1, kDegree + 1> P;
  P[0] = 1, P[1] = x;
  for (int k = 1; k < kDegree; ++k) P[k + 1] = ((2 * k + 1) * x * P[k] - k * P[k - 1]) / (k + 1);
  return P;
}

// The roots of P_n by Newton's method, half of them: the others lie opposite.
Gauss make() {
  Gauss g;
  for (int i = 0; i < kDegree / 2; ++i) {
    double x = elementary::cos(std::numbers::pi * (i + 0.75) / (kDegree + 0.5)), slope = 0;
    for (int round = 0; round < 8; ++round) {
      const auto P = legendreAt(x);
      slope = kDegree * (x * P[kDegree] - P[kDegree - 1]) / (x * x - 1);
      x -= P[kDegree] / slope;
    }
    g.node[i] = 0.5 * (1 - x), g.node[kDegree - 1 - i] = 0.5 * (1 + x);
    g.weight[i] = g.weight[kDegree - 1 - i] = 1 / ((1 - x * x) * slope * slope);
  }
  Gauss::Square integrals;
  for (int i = 0; i < kDegree; ++i) {
    g.legendre.row(i) = Gauss::values(g.node[i]);
    integrals.row(i) = Gauss::integrals(g.node[i]);
  }
  // P_k are orthogonal in the quadrature, which is exact for their products.
  for (int k = 0; k < kDegree; ++k)
    for (int i = 0; i < kDegree; ++i) g.coefficients(k, i) = (2 * k + 1) * g.weight[i] * g.legendre(i, k);
  g.integral = integrals * g.coefficients;
  return g;
}

}  // namespace

const Gauss& Gauss::get() {
  static const Gauss gauss = make();
  return gauss;
}

Gauss::Row Gauss::values(double t) { return legendreAt(2 * t - 1).head<kDegree>(); }

Gauss::Row Gauss::integrals(double t) {
  const auto P = legendreAt(2 * t - 1);
  Row out;
  out[0] = t;
  for (int k = 1; k < kDegree; ++k) out[k] = (P[k + 1] - P[k - 1]) / (2 * (2 * k + 1));
  return out;
}

}  // namespace carom::adjoint_detail
