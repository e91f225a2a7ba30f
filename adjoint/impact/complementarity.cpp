// SPDX-License-Identifier: MIT
#include "adjoint/impact/complementarity.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "adjoint/errors.h"

namespace carom {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// An eigen-decomposition of numbers that are not finite ends nowhere.
void requireComputable(const MatrixXd& A, const VectorXd& b) {
  if (!A.allFinite() || !b.allFinite())
    throw NotComputable("the effective masses of its contacts are beyond the range of doubles");
}

}  // namespace

LeastNormSolve::LeastNormSolve(const MatrixXd& A, const VectorXd& b) {
  requireComputable(A, b);
  if (b.size() == 0) {  // no contact: no impulse
    inverse = rest = A;
    y = inverse_y = b;
    return;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  const VectorXd& values = eigen.eigenvalues();  // in increasing order
  const MatrixXd& vectors = eigen.eigenvectors();
  Index null = 0;
  while (null < values.size() && values[null] <= 1e-11 * values[values.size() - 1]) ++null;
  const MatrixXd range = vectors.rightCols(values.size() - null);
  inverse = range * values.tail(values.size() - null).cwiseInverse().asDiagonal() * range.transpose();
  rest = vectors.leftCols(null) * vectors.leftCols(null).transpose();
  y = -inverse * b;
  inverse_y = inverse * y;
}

VectorXd LeastNormSolve::tangent(const MatrixXd& dA, const VectorXd& db) const {
  return -inverse * (db + dA * y) + rest * (dA * inverse_y);
}

void LeastNormSolve::pullback(const VectorXd& y_bar, MatrixXd& A_bar, VectorXd& b_bar) const {
  const VectorXd z = inverse * y_bar;
  b_bar = -z;
  A_bar = -z * y.transpose() + (rest.transpose() * y_bar) * inverse_y.transpose();
}

namespace {

using Contacts = std::vector<int>;

// Where contacts are redundant several sets give the same velocities. The one that spreads the impulses over all
// contacts that just meet their condition is taken when it pulls nowhere: a box on a face is held at its four corners,
// not at two.
Contacts spread(const MatrixXd& A, const VectorXd& b, const VectorXd& y, Contacts active) {
  const VectorXd w = A * y + b;
  const double scale = b.cwiseAbs().maxCoeff();
  Contacts met;
  for (Index i = 0; i < b.size(); ++i)
    if (y[i] > 0 || std::abs(w[i]) <= 1e-9 * scale) met.push_back(static_cast<int>(i));
  if (met.empty() || met.size() == active.size()) return active;
  const LeastNormSolve solve(A(met, met), b(met));
  if ((A(met, met) * solve.y + b(met)).cwiseAbs().maxCoeff() > 1e-9 * scale) return active;
  const double least = 1e-9 * solve.y.cwiseAbs().maxCoeff();
  return solve.y.minCoeff() > least ? met : active;
}

}  // namespace

// Active set of Lawson and Hanson: contacts enter one at a time, the most violated first, and leave at the first
// impulse that would turn negative.
std::vector<int> activeContacts(const MatrixXd& A, const VectorXd& b, bool in_range) {
  const Index n = b.size();
  requireComputable(A, b);
  if (n == 0) return {};
  const double tolerance = 1e-13 * b.cwiseAbs().maxCoeff();
  std::vector<bool> in(static_cast<std::size_t>(n), false);
  VectorXd y = VectorXd::Zero(n);
  const auto members = [&] {
    Contacts list;
    for (Index i = 0; i < n; ++i)
      if (in[static_cast<std::size_t>(i)]) list.push_back(static_cast<int>(i));
    return list;
  };
  for (Index round = 0; round < 10 * n + 10; ++round) {
    const VectorXd w = A * y + b;
    Index enter = -1;
    for (Index i = 0; i < n; ++i)
      if (!in[static_cast<std::size_t>(i)] && w[i] < -tolerance && (enter < 0 || w[i] < w[enter])) enter = i;
    if (enter < 0) break;
    in[static_cast<std::size_t>(enter)] = true;
    for (bool feasible = false; !feasible;) {
      const Contacts list = members();
      const LeastNormSolve solve(A(list, list), b(list));
      const VectorXd against = solve.rest * b(list);  // no impulse changes this part of the velocities
      if (!in_range && against.norm() > 1e-9 * b.cwiseAbs().maxCoeff()) {
        // more of -against leaves the velocities alone and is wanted: up to where the first contact leaves
        double most = std::numeric_limits<double>::infinity();
        Index first = -1;
        for (std::size_t c = 0; c < list.size(); ++c) {
          const double rate = -against[static_cast<Index>(c)];
          if (rate < -1e-12 * against.norm() && -y[list[c]] / rate < most) most = -y[list[c]] / rate, first = list[c];
        }
        if (first < 0) throw NotComputable("a body is squeezed between others that nothing moves");
        for (std::size_t c = 0; c < list.size(); ++c) y[list[c]] -= most * against[static_cast<Index>(c)];
        in[static_cast<std::size_t>(first)] = false, y[first] = 0;
        continue;
      }
      double step = 1;
      Index leave = -1;
      for (std::size_t c = 0; c < list.size(); ++c) {
        const double from = y[list[c]], to = solve.y[static_cast<Index>(c)];
        if (to <= 0 && from / (from - to) < step && from > to) step = from / (from - to), leave = list[c];
      }
      for (std::size_t c = 0; c < list.size(); ++c) y[list[c]] += step * (solve.y[static_cast<Index>(c)] - y[list[c]]);
      feasible = leave < 0;
      if (!feasible) in[static_cast<std::size_t>(leave)] = false, y[leave] = 0;
    }
  }
  return spread(A, b, y, members());
}

}  // namespace carom
