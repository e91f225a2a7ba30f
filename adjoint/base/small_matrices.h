// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <type_traits>

#include <Eigen/Core>

// Sums, differences, products and multiples of fixed-size matrices up to 7x12, for any scalar type, as values in
// place of Eigen's expression templates; `A * x + b` is written as before. Eigen instantiates a class of some two
// hundred members for every expression, which took a sixth of the compile time. Besides, a product is summed in one
// order, whatever the alignment of its vectors: Eigen takes two rows at a time from an even address on and the odd
// one by itself, in another order.

namespace carom {

namespace small_matrices {

template <class Derived>
std::true_type isMatrix(const Eigen::MatrixBase<Derived>&);  // also for classes derived from an expression

template <class T>
concept Small = requires(const T& matrix) { isMatrix(matrix); } && int(T::SizeAtCompileTime) > 0 &&
                int(T::SizeAtCompileTime) <= 7 * 12;

template <class T>
using ValueOf = Eigen::Matrix<typename T::Scalar, T::RowsAtCompileTime, T::ColsAtCompileTime>;

template <class A, class B>
using ProductOf = Eigen::Matrix<typename A::Scalar, A::RowsAtCompileTime, B::ColsAtCompileTime>;

template <class A, class B>
concept Alike = Small<A> && Small<B> && std::is_same_v<ValueOf<A>, ValueOf<B>>;

template <class A, class B>
concept Multiply = Small<A> && Small<B> && std::is_same_v<typename A::Scalar, typename B::Scalar> &&
                   int(A::ColsAtCompileTime) == int(B::RowsAtCompileTime) && Small<ProductOf<A, B>>;

template <class S, class A>
concept ScalarOf = Small<A> && std::is_convertible_v<S, typename A::Scalar> && !requires(const S& s) { isMatrix(s); };

/// A reference to what has entries in memory, the value of what computes them.
template <class T>
decltype(auto) entries(const T& matrix) {
  if constexpr ((int(Eigen::internal::traits<T>::Flags) & Eigen::DirectAccessBit) != 0) {
    return (matrix);
  } else {
    return ValueOf<T>(matrix);
  }
}

/// Two doubles that are computed with at a time; in memory they may lie anywhere.
using Two [[gnu::vector_size(16)]] = double;
inline Two two(const double* at) {
  Two value;
  std::memcpy(&value, at, sizeof value);
  return value;
}
inline void put(double* at, const Two& value) { std::memcpy(at, &value, sizeof value); }

template <class T>
inline constexpr bool kInOnePlace = std::is_same_v<T, ValueOf<T>> && std::is_same_v<typename T::Scalar, double>;

/// The matrix of operation(a(i, j), b(i, j)).
template <class A, class B, class Operation>
ValueOf<A> entryByEntry(const A& a, const B& b, Operation operation) {
  ValueOf<A> out;
  if constexpr (kInOnePlace<A> && kInOnePlace<B>) {
    constexpr int count = A::SizeAtCompileTime;
    for (int k = 0; k + 1 < count; k += 2) put(out.data() + k, operation(two(a.data() + k), two(b.data() + k)));
    if constexpr (count % 2 == 1) out.coeffRef(count - 1) = operation(a.coeff(count - 1), b.coeff(count - 1));
  } else {
    const auto& x = entries(a);
    const auto& y = entries(b);
    for (int j = 0; j < A::ColsAtCompileTime; ++j)
      for (int i = 0; i < A::RowsAtCompileTime; ++i) out.coeffRef(i, j) = operation(x.coeff(i, j), y.coeff(i, j));
  }
  return out;
}

/// The matrix of operation(a(i, j)).
template <class A, class Operation>
ValueOf<A> entryByEntry(const A& a, Operation operation) {
  ValueOf<A> out;
  if constexpr (kInOnePlace<A>) {
    constexpr int count = A::SizeAtCompileTime;
    for (int k = 0; k + 1 < count; k += 2) put(out.data() + k, operation(two(a.data() + k)));
    if constexpr (count % 2 == 1) out.coeffRef(count - 1) = operation(a.coeff(count - 1));
  } else {
    const auto& x = entries(a);
    for (int j = 0; j < A::ColsAtCompileTime; ++j)
      for (int i = 0; i < A::RowsAtCompileTime; ++i) out.coeffRef(i, j) = operation(x.coeff(i, j));
  }
  return out;
}

}  // namespace small_matrices

/// a + b.
template <class A, class B>
  requires small_matrices::Alike<A, B>
small_matrices::ValueOf<A> operator+(const A& a, const B& b) {
  return small_matrices::entryByEntry(a, b, [](const auto& x, const auto& y) { return x + y; });
}

/// a - b.
template <class A, class B>
  requires small_matrices::Alike<A, B>
small_matrices::ValueOf<A> operator-(const A& a, const B& b) {
  return small_matrices::entryByEntry(a, b, [](const auto& x, const auto& y) { return x - y; });
}

/// -a.
template <class A>
  requires small_matrices::Small<A>
small_matrices::ValueOf<A> operator-(const A& a) {
  return small_matrices::entryByEntry(a, [](const auto& x) { return -x; });
}

/// a times factor.
template <class A, class S>
  requires small_matrices::ScalarOf<S, A>
small_matrices::ValueOf<A> operator*(const A& a, const S& factor) {
  const typename A::Scalar s(factor);
  return small_matrices::entryByEntry(a, [&s](const auto& x) { return x * s; });
}

/// factor times a.
template <class A, class S>
  requires small_matrices::ScalarOf<S, A>
small_matrices::ValueOf<A> operator*(const S& factor, const A& a) {
  const typename A::Scalar s(factor);
  return small_matrices::entryByEntry(a, [&s](const auto& x) { return s * x; });
}

/// a / divisor.
template <class A, class S>
  requires small_matrices::ScalarOf<S, A>
small_matrices::ValueOf<A> operator/(const A& a, const S& divisor) {
  const typename A::Scalar s(divisor);
  return small_matrices::entryByEntry(a, [&s](const auto& x) { return x / s; });
}

/// a b, each entry summed in order.
template <class A, class B>
  requires small_matrices::Multiply<A, B>
small_matrices::ProductOf<A, B> operator*(const A& a, const B& b) {
  using namespace small_matrices;
  constexpr int rows = A::RowsAtCompileTime, common = A::ColsAtCompileTime;
  // two rows at a time where columns lie in one piece
  constexpr int paired = kInOnePlace<A> && !A::IsRowMajor ? rows / 2 * 2 : 0;
  const auto& x = entries(a);
  const auto& y = entries(b);
  ProductOf<A, B> out;
  for (int j = 0; j < B::ColsAtCompileTime; ++j) {
    if constexpr (paired > 0)
      for (int i = 0; i < paired; i += 2) {
        Two sum = two(x.data() + i) * y.coeff(0, j);
        for (int k = 1; k < common; ++k) sum += two(x.data() + rows * k + i) * y.coeff(k, j);
        put(out.data() + rows * j + i, sum);
      }
    for (int i = paired; i < rows; ++i) {
      typename A::Scalar sum = x.coeff(i, 0) * y.coeff(0, j);
      for (int k = 1; k < common; ++k) sum += x.coeff(i, k) * y.coeff(k, j);
      out.coeffRef(i, j) = sum;
    }
  }
  return out;
}

}  // namespace carom
