// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "adjoint/contact/cone.hpp"
#include "adjoint/contact/symmetric_inverse.hpp"

/// The conditions of a cone program on its active set, for any number, with rates and adjoints of the solution. On the
/// set f = f(y): (f_n, f_t) inside; f = (p - offset) n + mu p t on the side, with p and the turn of t; p n free.
///   V = b + K (f - sum lambda n),  J = df/dy:   J^T V = 0,  -(n.(K f) - rise) = 0
namespace carom::adjoint_detail {

template <class S>
struct ConeTerms {
  using Program = ConeProgramOf<S>;
  using Index = Eigen::Index;
  const Program* program;
  ConePointOf<S> at;
  MatrixOf<S> J, C;  // C = K N of the equations
  VectorOf<S> f, V, Kf, residual;
  MatrixOf<S> M;              // of the Newton step: (dy, dlambda)
  std::vector<Index> first;   // column of a contact in J
  std::vector<V3<S>> turned;  // n x t

  ConeTerms(const Program& of, ConePointOf<S> point) : program(&of), at(std::move(point)) { assemble(); }

  static int unknownsOf(const Program& q, const ConePointOf<S>& at, int k) {
    const auto kk = static_cast<std::size_t>(k);
    switch (at.state[kk]) {
      case ConeState::apex:
        return 0;
      case ConeState::free:
        return 1;
      case ConeState::slides:
        return q.friction[kk] > S(0) ? 2 : 1;
      case ConeState::inside:
        break;
    }
    return 3;
  }

  // The Newton step is taken; lambda was part of the unknowns.
  void step(const VectorOf<S>& d) {
    using std::sqrt;
    const Program& q = *program;
    for (int k = 0; k < q.contacts(); ++k) {
      const auto kk = static_cast<std::size_t>(k);
      const Index c = first[kk];
      const S mu = q.friction[kk];
      if (at.state[kk] == ConeState::inside) at.f[kk] += d.template segment<3>(c);
      if (at.state[kk] == ConeState::free) at.pressure[kk] += d[c];
      if (at.state[kk] != ConeState::slides) continue;
      const S p = at.pressure[kk];
      at.pressure[kk] += d[c];
      if (!(mu > S(0))) continue;
      // f_t moves across t by d[c + 1]
      const V3<S> along = mu * p * at.direction[kk] + d[c + 1] * turned[kk];
      const S size = sqrt(along.dot(along));
      at.direction[kk] = along / size;
    }
    at.lambda += d.tail(at.lambda.size());
  }

 private:
  void assemble() {
    const Program& q = *program;
    const int n = q.contacts();
    Index columns = 0;
    for (int k = 0; k < n; ++k) first.push_back(columns), columns += unknownsOf(q, at, k);
    const auto equations = static_cast<Index>(q.equal.size());
    J = MatrixOf<S>::Zero(3 * n, columns);
    f = VectorOf<S>::Zero(3 * n);
    turned.assign(static_cast<std::size_t>(n), V3<S>::Zero());
    for (int k = 0; k < n; ++k) addContact(k);
    C = MatrixOf<S>::Zero(3 * n, equations);
    for (Index e = 0; e < equations; ++e) {
      const auto k = static_cast<std::size_t>(q.equal[static_cast<std::size_t>(e)]);
      C.col(e) = q.K.middleCols(3 * static_cast<Index>(k), 3) * q.normal[k];
    }
    Kf = q.K * f;
    V = q.b + Kf - C * at.lambda;
    residual.resize(columns + equations);
    residual.head(columns) = J.transpose() * V;
    for (Index e = 0; e < equations; ++e) {
      const auto k = static_cast<std::size_t>(q.equal[static_cast<std::size_t>(e)]);
      const V3<S> rise = Kf.template segment<3>(3 * static_cast<Index>(k));
      residual[columns + e] = q.rise[static_cast<std::size_t>(e)] - q.normal[k].dot(rise);
    }
    M = MatrixOf<S>::Zero(columns + equations, columns + equations);
    M.topLeftCorner(columns, columns) = J.transpose() * q.K * J;
    const MatrixOf<S> across = -J.transpose() * C;
    M.topRightCorner(columns, equations) = across;
    M.bottomLeftCorner(equations, columns) = across.transpose();
    for (int k = 0; k < n; ++k) addCurvature(k);
  }

  void addContact(int k) {
    const Program& q = *program;
    const auto kk = static_cast<std::size_t>(k);
    const V3<S>&n = q.normal[kk], t = at.direction[kk];
    const Index c = first[kk];
    const S mu = q.friction[kk], p = at.pressure[kk];
    auto own = f.template segment<3>(3 * k);
    auto rows = J.middleRows(3 * k, 3);
    switch (at.state[kk]) {
      case ConeState::apex:
        own = -q.offset[kk] * n;
        break;
      case ConeState::free:
        own = p * n;
        rows.col(c) = n;
        break;
      case ConeState::inside:
        own = at.f[kk];
        rows.middleCols(c, 3).setIdentity();
        break;
      case ConeState::slides:
        turned[kk] = n.cross(t);
        own = (p - q.offset[kk]) * n + mu * p * t;
        rows.col(c) = n + mu * t;
        if (mu > S(0)) rows.col(c + 1) = turned[kk];
        break;
    }
  }
  void addCurvature(int k) {
    const Program& q = *program;
    const auto kk = static_cast<std::size_t>(k);
    if (at.state[kk] != ConeState::slides || !(q.friction[kk] > S(0))) return;
    const V3<S> v = V.template segment<3>(3 * k);
    const Index c = first[kk];
    const S p = at.pressure[kk], slip = -at.direction[kk].dot(v);
    if (slip > S(0)) M(c + 1, c + 1) += slip / (q.friction[kk] * p);
    const S twist = turned[kk].dot(v) / p;
    M(c, c + 1) += twist;
    M(c + 1, c) += twist;
  }
};

/// Units of the unknowns of M.
template <class S>
auto unitsOf(const ConeTerms<S>& t) {
  using T = Value<S>;
  const std::vector<T> force = forceUnits<T>(valuesOf(t.program->K));
  VectorOf<T> units(t.M.rows());
  for (int k = 0; k < t.program->contacts(); ++k)
    for (int i = 0; i < ConeTerms<S>::unknownsOf(*t.program, t.at, k); ++i)
      units[t.first[static_cast<std::size_t>(k)] + i] = force[static_cast<std::size_t>(k)];
  for (std::size_t e = 0; e < t.program->equal.size(); ++e)
    units[t.J.cols() + static_cast<Eigen::Index>(e)] = force[static_cast<std::size_t>(t.program->equal[e])];
  return units;
}

}  // namespace carom::adjoint_detail
