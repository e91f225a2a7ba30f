// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/flight/periodic_sensitivity.hpp"
#include "adjoint/flight/variation_pass.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {

namespace {

constexpr std::size_t kOrder = TriaxialRotation::kOrder;

// Variations in principal axes, eta = R^T dtheta, lambda = R^T dL and dM = lambda + M x eta, obey (w = D M, dA the
// change of the inverse inertia tensor: dD on its diagonal, dA_ij = -dJ_ij D_i D_j off it)
//   dM' = dM x w + M x (D dM + dA M),   eta' = -w x eta + D dM + dA M,
// whence (M.eta)' = w.dM + M.dA M and eta = ((dM - lambda) x M + (M.eta) M) / |M|^2: dM and the scalar M.eta are smooth
// like M itself, while eta turns with the body. By superposition eta(h) = R(h)^T R(0) eta(0) + G dM(0) + H dJ, so
//   dtheta(h) = dtheta(0) + R(h) G (R(0)^T dL + M(0) x R(0)^T dtheta(0)) + R(h) H dJ.
// Two columns of G and H need no equation: L -> s L is a change of time scale, so G M(0) = h w(h); I -> s I likewise,
// so H I = -h w(h). The others are Taylor series on the coefficients of the segment: two of dM(0), normal to M(0);
// dI_1; dI_2; and, where products of inertia are asked for, those of yz, xz and xy.
constexpr int kMoments = 4, kProducts = 7;
template <int N>
using Columns = Eigen::Array<double, N, 1>;
template <int N>
using Triple = std::array<Columns<N>, 3>;

template <int N>
struct Variations {
  std::array<Triple<N>, kOrder + 1> dM;
  std::array<Columns<N>, kOrder + 1> along;  // M.eta
  std::size_t order = kOrder;                // further terms make no difference

  // Squares of the terms of an order in units of `size`, the largest.
  double share(std::size_t k, const Columns<N>& size, double momentum) const {
    Columns<N> square = (along[k] / momentum).square();
    for (std::size_t i = 0; i < 3; ++i) square += dM[k][i].square();
    return (square / size.square()).maxCoeff();
  }
};

// Of dM(0), or of what dJ moves.
template <int N>
Columns<N> sizeOf(double momentum, double largest_D) {
  Columns<N> size = Columns<N>::Constant(momentum * largest_D);
  size[0] = size[1] = 1;
  return size;
}

// A stretch much shorter than the segment needs few terms: three in a row that are nothing end the series.
constexpr double kNothing = 1e-19;
constexpr std::size_t kLeastOrder = 5;

struct MomentumSeries {
  std::array<std::array<double, 3>, kOrder> M, w;
};

// dA by the columns.
template <int N>
struct InverseInertiaRates {
  Columns<N> d11 = Columns<N>::Zero(), d22 = d11, d23 = d11, d31 = d11, d12 = d11;

  explicit InverseInertiaRates(const Vec3& D) {
    d11[2] = -D[0] * D[0];
    d22[3] = -D[1] * D[1];
    if constexpr (N == kProducts) d23[4] = -D[1] * D[2], d31[5] = -D[2] * D[0], d12[6] = -D[0] * D[1];
  }
  // dA M
  Triple<N> times(const std::array<double, 3>& M) const {
    Triple<N> out{d11 * M[0], d22 * M[1], Columns<N>::Zero()};
    if constexpr (N == kProducts) {
      out[0] += d12 * M[1] + d31 * M[2];
      out[1] += d12 * M[0] + d23 * M[2];
      out[2] += d31 * M[0] + d23 * M[1];
    }
    return out;
  }
};

// Coefficient k of the products M_i M_j.
struct MomentumSquares {
  double m11 = 0, m22 = 0, m33 = 0, m23 = 0, m31 = 0, m12 = 0;

  void add(const std::array<double, 3>& m, const std::array<double, 3>& n) {
    m23 += m[1] * n[2], m31 += m[2] * n[0], m12 += m[0] * n[1];
    m11 += m[0] * n[0], m22 += m[1] * n[1], m33 += m[2] * n[2];
  }
  // M x (dA M)
  template <int N>
  Triple<N> torque(const InverseInertiaRates<N>& dA) const {
    Triple<N> out{-dA.d22 * m23, dA.d11 * m31, (dA.d22 - dA.d11) * m12};
    if constexpr (N == kProducts) {
      out[0] += dA.d23 * (m22 - m33) + dA.d31 * m12 - dA.d12 * m31;
      out[1] += dA.d31 * (m33 - m11) + dA.d12 * m23 - dA.d23 * m12;
      out[2] += dA.d12 * (m11 - m22) + dA.d23 * m31 - dA.d31 * m23;
    }
    return out;
  }
  // M.(dA M)
  template <int N>
  Columns<N> energy(const InverseInertiaRates<N>& dA) const {
    Columns<N> out = dA.d11 * m11 + dA.d22 * m22;
    if constexpr (N == kProducts) out += 2 * (dA.d23 * m23 + dA.d31 * m31 + dA.d12 * m12);
    return out;
  }
};

template <int N>
Variations<N> variations(const MomentumSeries& s, const Vec3& D, const Vec3& u1, const Vec3& u2, double momentum,
                         double h) {
  Variations<N> v;
  const Columns<N> size = sizeOf<N>(momentum, D.maxCoeff());
  double power = 1;  // h^k
  int nothing = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    v.dM[0][i].setZero();
    v.dM[0][i][0] = u1[static_cast<Eigen::Index>(i)];
    v.dM[0][i][1] = u2[static_cast<Eigen::Index>(i)];
  }
  v.along[0].setZero();
  const InverseInertiaRates<N> dA(D);
  const double d32 = D[2] - D[1], d13 = D[0] - D[2], d21 = D[1] - D[0];
  for (std::size_t k = 0; k < kOrder; ++k) {
    Columns<N> p23 = Columns<N>::Zero(), p31 = p23, p12 = p23, wd = p23;
    MomentumSquares squares;
    for (std::size_t j = 0; j <= k; ++j) {
      const auto &m = s.M[j], &w = s.w[j];
      const auto& d = v.dM[k - j];
      p23 += m[1] * d[2] + m[2] * d[1];
      p31 += m[2] * d[0] + m[0] * d[2];
      p12 += m[0] * d[1] + m[1] * d[0];
      wd += w[0] * d[0] + w[1] * d[1] + w[2] * d[2];
      squares.add(m, s.M[k - j]);
    }
    const double f = 1.0 / static_cast<double>(k + 1);
    const Triple<N> torque = squares.torque(dA);
    v.dM[k + 1] = {f * (d32 * p23 + torque[0]), f * (d13 * p31 + torque[1]), f * (d21 * p12 + torque[2])};
    v.along[k + 1] = f * (wd + squares.energy(dA));
    power *= h;
    if (k + 1 < kLeastOrder) continue;
    nothing = std::sqrt(v.share(k + 1, size, momentum)) * power < kNothing ? nothing + 1 : 0;
    if (nothing == 3) {
      v.order = k + 1;
      break;
    }
  }
  return v;
}

// Step within which the last terms of the variations are 4e-15 of their size, the neglected ones below 1e-15.
template <int N>
double variationStep(const Variations<N>& v, double momentum, double largest_D) {
  const Columns<N> size = sizeOf<N>(momentum, largest_D);
  double log_step = 700;
  for (std::size_t k : {kOrder, kOrder - 1}) {
    const double share = v.share(k, size, momentum);
    if (share > 0) log_step = std::min(log_step, (-0.5 * elementary::log(share) - 33.2) / static_cast<double>(k));
  }
  return elementary::exp(log_step);
}

// The turn below which eta comes from its own equation, because dM - lambda would be a difference of nearly equal
// numbers.
constexpr double kSmallTurn = 0.05;

// eta by its own series for small turns; a dozen terms leave 1e-24 of it.
template <int N>
Eigen::Matrix<double, 3, N> smallTurn(const MomentumSeries& s, const Variations<N>& v, const Vec3& D, double h) {
  constexpr std::size_t kTerms = 12;
  const std::size_t terms = std::min(kTerms, v.order);
  std::array<Triple<N>, kTerms + 1> eta;
  for (Columns<N>& e : eta[0]) e.setZero();
  const InverseInertiaRates<N> dA(D);
  for (std::size_t k = 0; k < terms; ++k) {
    Triple<N> sum = dA.times(s.M[k]);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += D[static_cast<Eigen::Index>(i)] * v.dM[k][i];
    for (std::size_t j = 0; j <= k; ++j) {
      const auto& w = s.w[j];
      const auto& e = eta[k - j];
      sum[0] += w[2] * e[1] - w[1] * e[2];
      sum[1] += w[0] * e[2] - w[2] * e[0];
      sum[2] += w[1] * e[0] - w[0] * e[1];
    }
    for (std::size_t i = 0; i < 3; ++i) eta[k + 1][i] = sum[i] / static_cast<double>(k + 1);
  }
  Eigen::Matrix<double, 3, N> out;
  for (std::size_t i = 0; i < 3; ++i) {
    Columns<N> sum = eta[terms][i];
    for (std::size_t k = terms; k-- > 0;) sum = sum * h + eta[k][i];
    out.row(static_cast<Eigen::Index>(i)) = sum.matrix().transpose();
  }
  return out;
}

// eta from dM and M.eta at h; `lambda` of the first two columns.
template <int N>
Eigen::Matrix<double, 3, N> largeTurn(const Variations<N>& v, double h, const Vec3& M, const Vec3& lambda1,
                                      const Vec3& lambda2) {
  Triple<N> dM = v.dM[v.order];
  Columns<N> along = v.along[v.order];
  for (std::size_t k = v.order; k-- > 0;) {
    for (std::size_t i = 0; i < 3; ++i) dM[i] = dM[i] * h + v.dM[k][i];
    along = along * h + v.along[k];
  }
  Eigen::Matrix<double, 3, N> out;
  for (Eigen::Index c = 0; c < N; ++c) {
    Vec3 d(dM[0][c], dM[1][c], dM[2][c]);
    if (c == 0) d -= lambda1;
    if (c == 1) d -= lambda2;
    out.col(c) = (d.cross(M) + along[c] * M) / M.squaredNorm();
  }
  return out;
}

}  // namespace

// Over [0, h] of the segment, or as much of it as the series of the variations allow: h is cut back to that.
template <int N>
RotationSensitivity TriaxialRotation::segmentSensitivity(const Segment& segment, double& h) const {
  const Mat3 R0 = segment.q.toRotationMatrix();
  const Vec3 M0 = R0.transpose() * L_;
  const double l = L_.norm();
  RotationSensitivity S;
  if (l == 0) {  // at rest: dM is constant and eta = h D dM
    S.dtheta_dL = h * R0 * D_.asDiagonal() * R0.transpose();
    return S;
  }
  MomentumSeries s;
  for (std::size_t k = 0; k < kOrder; ++k) {
    const auto& u = segment.u_psi[k];
    s.M[k] = {l * u[0], l * u[1], l * u[2]};
    s.w[k] = {D_[0] * s.M[k][0], D_[1] * s.M[k][1], D_[2] * s.M[k][2]};
  }
  const Vec3 axis = M0 / l, u1 = axis.unitOrthogonal(), u2 = axis.cross(u1);
  const Variations<N> v = variations<N>(s, D_, u1, u2, l, h);
  if (v.order == kOrder) h = std::min(h, variationStep(v, l, D_.maxCoeff()));
  const Mat3 Rh = orientationIn(segment, h).toRotationMatrix(), R_h0 = Rh.transpose() * R0;
  const Vec3 Mh = Rh.transpose() * L_, wh = D_.cwiseProduct(Mh);
  const Eigen::Matrix<double, 3, N> eta =
      l * D_.maxCoeff() * h < kSmallTurn ? smallTurn(s, v, D_, h) : largeTurn(v, h, Mh, R_h0 * u1, R_h0 * u2);
  const Mat3 G = eta.col(0) * u1.transpose() + eta.col(1) * u2.transpose() + (h / l) * wh * axis.transpose();
  Mat3 H;
  H.leftCols<2>() = eta.template middleCols<2>(2);
  H.col(2) = -D_[2] * (h * wh + H.col(0) / D_[0] + H.col(1) / D_[1]);
  const Mat3 RG = Rh * G;
  S.dtheta_dL = RG * R0.transpose();
  S.dtheta_dtheta = Mat3::Identity() + RG * skew(M0) * R0.transpose();
  S.dtheta_dI = Rh * H;
  if constexpr (N == kProducts) S.dtheta_dproducts = Rh * eta.template rightCols<3>();
  return S;
}

// Segment by segment, or in shorter steps where the series of the variations demand them.
RotationSensitivity TriaxialRotation::sensitivityOver(double elapsed, bool products) const {
  if (const auto stretch = stretchOver(elapsed)) return closedSensitivity(*stretch, products);
  RotationSensitivity total;
  std::size_t steps = 0;
  for (double t = 0; t < elapsed;) {
    const Segment* around = t < endOfSegments() ? &segmentAt(t) : nullptr;
    const Segment part = around && around->start == t ? *around : makeSegment(t, orientationAt(t));
    const double rest = elapsed - t;
    double h = std::min(part.length, rest);
    if (around) h = std::min(h, around->start + around->length - t);
    total = chained(total, products ? segmentSensitivity<kProducts>(part, h) : segmentSensitivity<kMoments>(part, h));
    if (h == rest) break;
    if (++steps == kMostSegments || !(t + h > t))
      throw NotComputable("the derivative of a rotation takes more than " + std::to_string(kMostSegments) +
                          " Taylor series");
    t += h;
  }
  return total;
}

// Whole periods in the time that one takes.
RotationSensitivity TriaxialRotation::sensitivityAt(double elapsed, bool products) const {
  if (!closed_form_ || !(elapsed > endOfSegments())) return sensitivityOver(elapsed, products);
  const double period = closed_form_->period(), count = std::floor(elapsed / period);
  if (count < 2) return sensitivityOver(elapsed, products);
  const double rest = std::max(0.0, std::fma(-period, count, elapsed));
  const auto omega = [&](const Quat& q) { return Vec3(q * D_.cwiseProduct(q.conjugate() * L_)); };
  const auto turnAfter = [&](double n) { return orientationAt(n * period) * q_.conjugate(); };
  const PeriodicSensitivity periodic(sensitivityOver(period, products), turnAfter(1), L_, omega(q_));
  const Quat turn = turnAfter(count);
  return periodic.over(count, turn, turned(sensitivityOver(rest, products), turn), omega(orientationAt(elapsed)));
}

}  // namespace carom::adjoint_detail
