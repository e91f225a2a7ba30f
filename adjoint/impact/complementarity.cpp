// SPDX-License-Identifier: MIT
#include "adjoint/impact/complementarity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/symmetric_eigen.hpp"
#include "adjoint/numeric/double_double.hpp"

namespace carom::adjoint_detail {

using Eigen::Index;

namespace {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

template <class T>
struct Precision;
template <>
struct Precision<double> {
  static constexpr double kNull = 1e-11, kRounding = 1e-13;
};
// Normals and points are doubles: what they make of redundant contacts is of size 1e-32.
template <>
struct Precision<DoubleDouble> {
  static constexpr double kNull = 1e-28, kRounding = 1e-28;
};

// An eigen-decomposition of numbers that are not finite ends nowhere.
template <class T>
void requireComputable(const Matrix<T>& A, const Vector<T>& b) {
  const auto number = [](const T& x) { return rounded(x); };
  if (!A.unaryExpr(number).allFinite() || !b.unaryExpr(number).allFinite())
    throw NotComputable("the effective masses of its contacts are beyond the range of doubles");
}

// Powers of 16, which round nothing, that bring the diagonal of D A D within a factor of 16 either way of the largest
// entry of A; contacts of bodies of like masses keep 1.
template <class T>
Vector<T> scaleOf(const Matrix<T>& A) {
  const auto size = [](const T& x) { return std::ilogb(rounded(x)); };
  const T largest = A.diagonal().maxCoeff();
  Vector<T> D = Vector<T>::Ones(A.rows());
  for (Index i = 0; i < A.rows(); ++i)
    if (A(i, i) > T(0)) D[i] = std::ldexp(1.0, 4 * ((size(largest) - size(A(i, i)) + 4) / 8));
  return D;
}

// Of independent columns, twice over, since their rows may differ much in size.
template <class T>
Matrix<T> orthonormal(Matrix<T> columns) {
  using std::sqrt;
  for (int pass = 0; pass < 2; ++pass)
    for (Index c = 0; c < columns.cols(); ++c) {
      for (Index before = 0; before < c; ++before) {
        const T along = columns.col(before).dot(columns.col(c));
        columns.col(c) -= columns.col(before) * along;
      }
      const T length = sqrt(columns.col(c).dot(columns.col(c)));
      columns.col(c) /= length;
    }
  return columns;
}

}  // namespace

template <class T>
LeastNormSolveOf<T>::LeastNormSolveOf(const Matrix& A, const Vector& b) {
  requireComputable<T>(A, b);
  if (b.size() == 0) {  // no contact: no impulse
    inverse = rest = A;
    y = inverse_y = b;
    return;
  }
  const Vector D = scaleOf<T>(A);
  const bool alike = (D.array() == T(1)).all();
  const SymmetricEigen<T> eigen(alike ? A : Matrix(D.asDiagonal() * A * D.asDiagonal()));
  const Vector& values = eigen.values;  // in increasing order
  const Matrix& vectors = eigen.vectors;
  Index null = 0;
  while (null < values.size() && values[null] <= T(Precision<T>::kNull) * values[values.size() - 1]) ++null;
  const Matrix range = vectors.rightCols(values.size() - null);
  inverse = range * values.tail(values.size() - null).cwiseInverse().asDiagonal() * range.transpose();
  if (alike) {
    rest = vectors.leftCols(null) * vectors.leftCols(null).transpose();
  } else {  // A D v = 0 where D A D v = 0; D (D A D)^+ D inverts A up to parts in there
    const Matrix none = orthonormal<T>(D.asDiagonal() * vectors.leftCols(null));
    rest = none * none.transpose();
    const Matrix across = Matrix::Identity(A.rows(), A.rows()) - rest;
    inverse = (across * (D.asDiagonal() * inverse * D.asDiagonal()) * across).eval();
  }
  y = -inverse * b;
  inverse_y = inverse * y;
}

template <class T>
typename LeastNormSolveOf<T>::Vector LeastNormSolveOf<T>::tangent(const Matrix& dA, const Vector& db) const {
  return -inverse * (db + dA * y) + rest * (dA * inverse_y);
}

template struct LeastNormSolveOf<double>;
template struct LeastNormSolveOf<DoubleDouble>;

namespace {

using Contacts = std::vector<int>;

template <class T>
T absOf(const T& x) {
  return x < T(0) ? T(-x) : x;
}

bool isConstrained(const std::vector<char>& held, int contact) {
  return !held.empty() && held[static_cast<std::size_t>(contact)];
}

// Where contacts are redundant several sets give the same velocities. The one that spreads the impulses over all
// contacts that just meet their condition is taken when it pulls nowhere: a box on a face is held at its four corners,
// not at two.
template <class T>
Contacts spread(const Matrix<T>& A, const Vector<T>& b, const Vector<T>& y, const Contacts& active,
                const std::vector<char>& held) {
  const Vector<T> w = A * y + b;
  const T scale = b.unaryExpr(&absOf<T>).maxCoeff(), least = T(1e-9) * scale;
  Contacts met;
  for (Index i = 0; i < b.size(); ++i)
    if (y[i] > T(0) || isConstrained(held, static_cast<int>(i)) || absOf<T>(w[i]) <= least) met.push_back(static_cast<int>(i));
  if (met.empty() || met.size() == active.size()) return active;
  const LeastNormSolveOf<T> solve(A(met, met), b(met));
  const Vector<T> left = A(met, met) * solve.y + b(met);
  for (std::size_t c = 0; c < met.size(); ++c) {
    const auto i = static_cast<Index>(c);
    // an impulse counts by the velocity that it gives its own contact
    if (absOf<T>(left[i]) > least) return active;
    if (!isConstrained(held, met[c]) && !(A(met[c], met[c]) * solve.y[i] > least)) return active;
  }
  return met;
}

}  // namespace

// Active set of Lawson and Hanson: contacts enter one at a time, the most violated first, and leave at the first
// impulse that would turn negative.
template <class T>
std::vector<int> activeContactsOf(const Matrix<T>& A, const Vector<T>& b, bool in_range,
                                  const std::vector<char>& held) {
  using std::sqrt;
  const Index n = b.size();
  requireComputable<T>(A, b);
  if (n == 0) return {};
  const T largest = b.unaryExpr(&absOf<T>).maxCoeff();
  Contacts list;  // those with an impulse, in increasing order
  Vector<T> y = Vector<T>::Zero(n);
  const auto leaves = [&](int contact) { std::erase(list, contact), y[contact] = T(0); };
  // what the contact's velocity may be off by
  const auto rounding = [&](Index i) {
    T sum = T(0);
    for (Index j = 0; j < n; ++j) sum += absOf<T>(A(i, j) * y[j]);
    return T(1e-15) * largest + T(1e-13) * absOf<T>(b[i]) + T(Precision<T>::kRounding) * sum;
  };
  for (int i = 0; i < n; ++i)
    if (isConstrained(held, i)) list.push_back(i);
  if (!list.empty()) y(list) = LeastNormSolveOf<T>(A(list, list), b(list)).y;
  for (Index round = 0; round < 10 * n + 10; ++round) {
    const Vector<T> w = A * y + b;
    int enter = -1;
    for (int i = 0; i < n; ++i)
      if (!std::ranges::binary_search(list, i) && w[i] < -rounding(i) && (enter < 0 || w[i] < w[enter])) enter = i;
    if (enter < 0) break;
    list.insert(std::ranges::upper_bound(list, enter), enter);
    for (bool feasible = false; !feasible && !list.empty();) {
      const LeastNormSolveOf<T> solve(A(list, list), b(list));
      const Vector<T> against = solve.rest * b(list);  // no impulse changes this part of the velocities
      const T size = sqrt(against.dot(against));
      if (!in_range && size > T(1e-9) * largest) {
        // more of -against leaves the velocities alone and is wanted: up to where the first contact leaves
        T most = T(std::numeric_limits<double>::infinity());
        int first = -1;
        for (std::size_t c = 0; c < list.size(); ++c) {
          const T rate = -against[static_cast<Index>(c)];
          if (!isConstrained(held, list[c]) && rate < T(-1e-12) * size && -y[list[c]] / rate < most)
            most = -y[list[c]] / rate, first = list[c];
        }
        if (first < 0) throw NotComputable("a body is squeezed between fixed or kinematic ones");
        y(list) -= most * against;
        leaves(first);
        continue;
      }
      T step = T(1);
      int leave = -1;
      for (std::size_t c = 0; c < list.size(); ++c) {
        const T from = y[list[c]], to = solve.y[static_cast<Index>(c)];
        if (!isConstrained(held, list[c]) && to <= T(0) && from > to && from / (from - to) < step)
          step = from / (from - to), leave = list[c];
      }
      y(list) += step * (solve.y - y(list));
      feasible = leave < 0;
      if (!feasible) leaves(leave);
    }
  }
  return spread<T>(A, b, y, list, held);
}

template <class T>
std::vector<int> pushingContactsOf(const Matrix<T>& A, const Vector<T>& b, Vector<T> y, const std::vector<char>& held) {
  Contacts list;
  for (int i = 0; i < static_cast<int>(y.size()); ++i)
    if (y[i] > T(0) || isConstrained(held, i)) list.push_back(i);
  while (!list.empty()) {  // on the way to the impulses of least norm the velocities stay
    const LeastNormSolveOf<T> solve(A(list, list), b(list));
    T step = T(1);
    int leave = -1;
    for (std::size_t c = 0; c < list.size(); ++c) {
      const T from = y[list[c]], to = solve.y[static_cast<Index>(c)];
      if (!isConstrained(held, list[c]) && to <= T(0) && from / (from - to) < step) step = from / (from - to), leave = list[c];
    }
    if (leave < 0) break;
    y(list) += step * (solve.y - y(list));
    std::erase(list, leave);
  }
  return list;
}

template <class T>
bool followsFrom(const Matrix<T>& A, const Contacts& contacts, int k) {
  if (contacts.empty()) return false;
  const Vector<T> a = A(contacts, k);
  const LeastNormSolveOf<T> solve(A(contacts, contacts), a);
  const T rest = A(k, k) + a.dot(solve.y);
  return rest <= T(Precision<T>::kNull) * A(k, k);
}

template bool followsFrom(const Matrix<double>&, const Contacts&, int);
template bool followsFrom(const Matrix<DoubleDouble>&, const Contacts&, int);
template std::vector<int> pushingContactsOf(const Matrix<double>&, const Vector<double>&, Vector<double>,
                                            const std::vector<char>&);
template std::vector<int> pushingContactsOf(const Matrix<DoubleDouble>&, const Vector<DoubleDouble>&, Vector<DoubleDouble>,
                                            const std::vector<char>&);
template std::vector<int> activeContactsOf(const Matrix<double>&, const Vector<double>&, bool,
                                           const std::vector<char>&);
template std::vector<int> activeContactsOf(const Matrix<DoubleDouble>&, const Vector<DoubleDouble>&, bool, const std::vector<char>&);

}  // namespace carom::adjoint_detail
