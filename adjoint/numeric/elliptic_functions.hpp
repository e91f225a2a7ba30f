// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace carom::adjoint_detail {

/// Jacobi's elliptic functions and Legendre's integral of the first kind for one modulus k, 0 <= k < 1, by descending
/// Landen transformations (NIST Digital Library of Mathematical Functions, 22.7(i) and 19.8(ii)). Made from the
/// complementary parameter m1 = 1 - k^2 > 0, so that no digits are lost near k = 1.
class EllipticModulus {
 public:
  explicit EllipticModulus(double m1);

  /// K(k), the complete integral.
  double completeK() const { return K_; }
  /// F(phi, k) for the angle phi of the vector (x, y), -pi <= phi <= pi: digits of a small x are used.
  double incompleteF(double x, double y) const;

  struct Functions {
    double sn, cn, dn;
  };
  /// For |u| <= K; errors of a few roundings of 1.
  Functions at(double u) const;

 private:
  struct Step {
    double complement;  // k' before the step
    double k1;          // modulus after it, (1 - k')/(1 + k')
  };
  std::array<Step, 16> steps_{};
  std::size_t count_ = 0;
  double shrinking_ = 1;  // product of 1 + k1
  double K_ = 0;
};

}  // namespace carom::adjoint_detail
