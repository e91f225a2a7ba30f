// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "adjoint/base/types.h"
#include "adjoint/numeric/dual.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

/// A stretch of torque-free rotation in principal axes, in any kind of number S: momenta M = R^T L at both ends.
template <class S>
struct RotationStretch {
  V3<S> D;            ///< 1/I
  V3<S> start, end;   ///< M
  V3<S> squares;      ///< integral of M_i^2 - M_i(0)^2 over the stretch
  M3<S> turned;       ///< R(h)^T R(0)
  double elapsed = 0; ///< h
};

/// Its variations in closed form. Euler's equations M_i' = f_i = Delta_i M_j M_k, Delta_i = D_k - D_j for (i, j, k) in
/// cyclic order, let every M_i^2 move along one function z, M_i^2 = m_i + Delta_i z with m = M(0)^2 and z(0) = 0, and
///   dM_i = (a_i + kappa_i + b z) M_i + gamma f_i,  gamma = gamma_0 + c t - b (integral of z),
///   a_i = c + b (m_j/Delta_j + m_k/Delta_k),  kappa_i = -(dDelta_j/Delta_j + dDelta_k/Delta_k)/2
/// solves their variation for any constants b, c, gamma_0, which dM(0) gives. As w.dM + M.dA M/2 stays what it is (w = D M),
/// M.eta is an integral of squares too, and eta = R^T dtheta = ((dM - R^T dL) x M + (M.eta) M)/|M|^2. What is singular:
/// a principal axis (f = 0), the separatrix and two equal moments; see isRegular.
template <class S>
class VariationPass {
 public:
  explicit VariationPass(const RotationStretch<S>& stretch);

  /// Far enough from what is singular for full precision of these variations, `times` so far.
  bool isRegular(double times) const;

  /// dM at the end by dM at the start with R(0) held, and by D.
  M3<S> momentumByStart() const;
  M3<S> momentumByD() const;
  /// eta at the end by dM at the start with R(0) held, by the moments and by the products (yz, xz, xy) of inertia.
  M3<S> turnByStart() const;
  M3<S> turnByInertia() const;
  M3<S> turnByProducts() const;
  /// Of the integrals of squares, by dM at the start and by D.
  M3<S> squaresByStart() const;
  M3<S> squaresByD() const;

 private:
  static constexpr Eigen::Index next(Eigen::Index i) { return (i + 1) % 3; }
  static constexpr Eigen::Index last(Eigen::Index i) { return (i + 2) % 3; }
  V3<S> rates(const V3<S>& M) const {
    return {delta_[0] * M[1] * M[2], delta_[1] * M[2] * M[0], delta_[2] * M[0] * M[1]};
  }
  V3<S> kappa(Eigen::Index i) const;
  V3<S> turn(const V3<S>& of_momentum, const S& along) const {
    return (of_momentum.cross(s_.end) + along * s_.end) / s_.start.squaredNorm();
  }
  void solve();
  void integrate();

  RotationStretch<S> s_;
  V3<S> delta_, m_, f_start_, f_end_, uneven_;  // uneven: |M|^2 D - M.D M
  S regular_;                                   // sum of uneven_i f_i^2, which is constant
  S product_z_, product_Z_;                     // z and its integral, times the product of Delta
  // of dM(0) along each axis: a at the start, b over the product of Delta, c, and gamma at the end
  std::array<V3<S>, 3> a_;
  V3<S> b_, c_, gamma_;
};

template <class S>
VariationPass<S>::VariationPass(const RotationStretch<S>& stretch) : s_(stretch) {
  const V3<S>& D = s_.D;
  delta_ = {D[2] - D[1], D[0] - D[2], D[1] - D[0]};
  m_ = s_.start.cwiseProduct(s_.start);
  f_start_ = rates(s_.start), f_end_ = rates(s_.end);
  for (Eigen::Index i = 0; i < 3; ++i) uneven_[i] = delta_[next(i)] * m_[last(i)] - delta_[last(i)] * m_[next(i)];
  regular_ = uneven_.dot(V3<S>(f_start_.cwiseProduct(f_start_)));
  solve();
  integrate();
}

template <class S>
void VariationPass<S>::solve() {
  const V3<S>& M = s_.start;
  const S M2 = M.squaredNorm(), f2 = f_start_.squaredNorm();
  for (Eigen::Index n = 0; n < 3; ++n) {
    b_[n] = -uneven_[n] * M[n] / regular_;
    c_[n] = (M[n] + b_[n] * f2) / M2;
    for (Eigen::Index i = 0; i < 3; ++i)
      a_[static_cast<std::size_t>(n)][i] =
          c_[n] + b_[n] * delta_[i] * (delta_[last(i)] * m_[next(i)] + delta_[next(i)] * m_[last(i)]);
    const V3<S> along_M = a_[static_cast<std::size_t>(n)].cwiseProduct(M);
    gamma_[n] = (f_start_[n] - along_M.dot(f_start_)) / f2;
  }
}

// z from the axis along which it loses the fewest digits.
template <class S>
void VariationPass<S>::integrate() {
  Eigen::Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double loss = std::abs(primalOf(delta_[next(i)]) * primalOf(delta_[last(i)])) *
                        (std::abs(primalOf(s_.start[i])) + std::abs(primalOf(s_.end[i])));
    if (loss < least) least = loss, best = i;
  }
  const S others = delta_[next(best)] * delta_[last(best)];
  product_z_ = others * (s_.end[best] - s_.start[best]) * (s_.end[best] + s_.start[best]);
  product_Z_ = others * s_.squares[best];
  gamma_ += c_ * S(s_.elapsed) - b_ * product_Z_;
}

template <class S>
bool VariationPass<S>::isRegular(double times) const {
  constexpr double kLeastDifference = 0.05, kLeastAcross = 0.08, kLeastCancelled = 0.05;
  const Vec3 delta = valuesOf(delta_), f = valuesOf(f_start_), M = valuesOf(s_.start);
  const double largest = delta.cwiseAbs().maxCoeff();
  const double terms = valuesOf(uneven_).cwiseAbs().dot(f.cwiseAbs2());
  return delta.cwiseAbs().minCoeff() > times * kLeastDifference * largest &&
         f.norm() > times * kLeastAcross * largest * M.squaredNorm() &&
         std::abs(valueOf(regular_)) > times * kLeastCancelled * terms;
}

template <class S>
M3<S> VariationPass<S>::momentumByStart() const {
  M3<S> out;
  for (Eigen::Index n = 0; n < 3; ++n)
    for (Eigen::Index i = 0; i < 3; ++i)
      out(i, n) = (a_[static_cast<std::size_t>(n)][i] + b_[n] * product_z_) * s_.end[i] + gamma_[n] * f_end_[i];
  return out;
}

// By D_i.
template <class S>
V3<S> VariationPass<S>::kappa(Eigen::Index i) const {
  V3<S> by;  // dDelta/Delta
  by[i] = 0;
  by[next(i)] = 1.0 / delta_[next(i)];
  by[last(i)] = -1.0 / delta_[last(i)];
  return V3<S>(by[1] + by[2], by[2] + by[0], by[0] + by[1]) * S(-0.5);
}

template <class S>
M3<S> VariationPass<S>::momentumByD() const {
  const M3<S> by_start = momentumByStart();
  M3<S> out;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const V3<S> k = kappa(i);
    out.col(i) = k.cwiseProduct(s_.end) - by_start * V3<S>(k.cwiseProduct(s_.start));
  }
  return out;
}

template <class S>
M3<S> VariationPass<S>::turnByStart() const {
  const M3<S> dM = momentumByStart() - s_.turned;
  M3<S> out;
  for (Eigen::Index n = 0; n < 3; ++n) out.col(n) = turn(dM.col(n), s_.D[n] * s_.start[n] * S(s_.elapsed));
  return out;
}

template <class S>
M3<S> VariationPass<S>::turnByInertia() const {
  const M3<S> dM = momentumByD();
  M3<S> out;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const S along = m_[i] * S(s_.elapsed) + S(0.5) * s_.squares[i];
    out.col(i) = turn(dM.col(i), along) * S(-s_.D[i] * s_.D[i]);
  }
  return out;
}

// A product of inertia turns the principal axes about the third one, by 1/(I_j - I_k).
template <class S>
M3<S> VariationPass<S>::turnByProducts() const {
  const M3<S> G = turnByStart();
  M3<S> out;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const V3<S> axis = V3<S>::Unit(i);
    const V3<S> by_axes = s_.turned.col(i) - axis + G * s_.start.cross(axis);
    out.col(i) = by_axes * S(s_.D[next(i)] * s_.D[last(i)] / delta_[i]);
  }
  return out;
}

// z'^2 is a cubic in z, so that the integral of z^2 is one of the integral of z and of z'.
template <class S>
M3<S> VariationPass<S>::squaresByStart() const {
  const auto product = [](const V3<S>& M) { return S(M[0] * M[1] * M[2]); };
  Eigen::Index largest = 0;
  valuesOf(delta_).cwiseAbs().maxCoeff(&largest);
  const S Z = s_.squares[largest] / delta_[largest], h = s_.elapsed;
  S linear = 0, quadratic = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    linear += m_[next(i)] * m_[last(i)] * delta_[i];
    quadratic += m_[i] * delta_[next(i)] * delta_[last(i)];
  }
  const S third = product(s_.end) - product(s_.start) - linear * h - S(2) * quadratic * Z;
  M3<S> out;
  for (Eigen::Index n = 0; n < 3; ++n) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const S& a = a_[static_cast<std::size_t>(n)][i];
      const S change = (s_.end[i] - s_.start[i]) * (s_.end[i] + s_.start[i]);
      out(i, n) = S(2) * a * (m_[i] * h + s_.squares[i]) + S(2) * b_[n] * m_[i] * product_Z_ -
                  c_[n] * s_.squares[i] + gamma_[n] * change + b_[n] * delta_[i] * third;
    }
    out(n, n) -= S(2) * s_.start[n] * h;
  }
  return out;
}

template <class S>
M3<S> VariationPass<S>::squaresByD() const {
  const M3<S> by_start = squaresByStart();
  M3<S> out;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const V3<S> k = kappa(i), held = k.cwiseProduct(s_.start);
    // of M(t) = M(0): 2 kappa (integral of M^2), less the squares at the start, which stay
    out.col(i) = S(2) * k.cwiseProduct(V3<S>(m_ * S(s_.elapsed) + s_.squares)) - by_start * held -
                 S(2 * s_.elapsed) * held.cwiseProduct(s_.start);
  }
  return out;
}

}  // namespace carom::adjoint_detail
