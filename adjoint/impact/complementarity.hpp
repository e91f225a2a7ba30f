// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace carom::adjoint_detail {

/// y = -A^+ b for symmetric positive semidefinite A with b in its range, and its derivatives at constant rank:
/// dy = -A^+ (db + dA y) + (1 - A A^+) dA A^+ y. Throws NotComputable for numbers that are not finite; of no size it is
/// empty. T is double or DoubleDouble. The rank is that of D A D, where D makes the diagonal alike: contacts of bodies
/// of unlike masses are not taken for redundant.
template <class T>
struct LeastNormSolveOf {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  Matrix inverse, rest;  ///< A^+, 1 - A A^+
  Vector y, inverse_y;

  LeastNormSolveOf(const Matrix& A, const Vector& b);
  Vector tangent(const Matrix& dA, const Vector& db) const;
};
using LeastNormSolve = LeastNormSolveOf<double>;

/// Contacts, in increasing order, that have an impulse in the solution of y >= 0, A y + b >= 0, complementary, with A
/// symmetric positive semidefinite and b in its range unless `in_range` is false (equation 4.5). Contacts that are
/// `held` (none, or one entry a contact) have impulses of either sign and A y + b = 0. Where redundant contacts leave a
/// choice, the impulses are spread over all of them. Throws NotComputable for numbers that are not finite, and where a
/// b outside of the range of A leaves no solution.
template <class T>
std::vector<int> activeContactsOf(const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>& A,
                                  const Eigen::Matrix<T, Eigen::Dynamic, 1>& b, bool in_range,
                                  const std::vector<char>& held = {});
inline std::vector<int> activeContacts(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, bool in_range = true) {
  return activeContactsOf<double>(A, b, in_range);
}

/// Of contacts with impulses y that meet the conditions of activeContactsOf, those whose impulses of least norm push.
template <class T>
std::vector<int> pushingContactsOf(const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>& A,
                                   const Eigen::Matrix<T, Eigen::Dynamic, 1>& b, Eigen::Matrix<T, Eigen::Dynamic, 1> y,
                                   const std::vector<char>& held);

/// Whether the velocity of contact k is a combination of those of `contacts`, as A has it for impulses: where theirs are
/// 0, it is 0 too.
template <class T>
bool followsFrom(const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>& A, const std::vector<int>& contacts, int k);

}  // namespace carom::adjoint_detail
