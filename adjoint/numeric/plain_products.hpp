// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

// Internal to the libraries: not installed, and no public header includes it.

/// Matrices of numbers with a member `kPlainProducts` are multiplied an entry at a time, as sums over k in order. Eigen's
/// blocked products are made for doubles: for other numbers they are not quicker, and every one of them takes half a
/// second to compile.
namespace Eigen::internal {

template <class Number>
concept WithPlainProducts = requires { Number::kPlainProducts; };

template <class A, class B>
  requires WithPlainProducts<typename A::Scalar>
struct generic_product_impl<A, B, DenseShape, DenseShape, GemmProduct>
    : generic_product_impl<A, B, DenseShape, DenseShape, CoeffBasedProductMode> {};
template <class A, class B>
  requires WithPlainProducts<typename A::Scalar>
struct generic_product_impl<A, B, DenseShape, DenseShape, GemvProduct>
    : generic_product_impl<A, B, DenseShape, DenseShape, CoeffBasedProductMode> {};
template <int Mode, bool LhsIsTriangular, class A, class B>
  requires WithPlainProducts<typename A::Scalar>
struct triangular_product_impl<Mode, LhsIsTriangular, A, false, B, false> {
  template <class Sum>
  static void run(Sum& sum, const A& a, const B& b, const typename A::Scalar& factor) {
    using Whole = Matrix<typename A::Scalar, Dynamic, Dynamic>;
    Whole left = a, right = b;
    (LhsIsTriangular ? left : right) = Whole((LhsIsTriangular ? left : right).template triangularView<Mode>());
    sum += factor * (left * right);
  }
};

}  // namespace Eigen::internal
