#include <algorithm>
#include <cmath>

#include "adjoint/flight_triaxial.h"

namespace carom {
namespace {

constexpr std::size_t K = TriaxialRotation::kOrder;

// Variations in principal axes, eta = R^T dtheta, lambda = R^T dL and dM = lambda + M x eta, obey (w = D M)
//   dM'_1 = (D3 - D2)(dM2 M3 + M2 dM3) + (dD3 - dD2) M2 M3, cyclic;   eta' = -w x eta + D dM + dD M,
// whence (M.eta)' = w.dM + M.dD M and eta = ((dM - lambda) x M + (M.eta) M) / |M|^2: dM and the scalar M.eta are smooth
// like M itself, while eta turns with the body. By superposition eta(h) = R(h)^T R(0) eta(0) + G dM(0) + H dI, so
//   dtheta(h) = dtheta(0) + R(h) G (R(0)^T dL + M(0) x R(0)^T dtheta(0)) + R(h) H dI.
// Two columns of G and H need no equation: L -> s L is a change of time scale, so G M(0) = h w(h); I -> s I likewise,
// so H I = -h w(h). The other four are Taylor series on the coefficients of the segment.
using Columns = Eigen::Array4d;  // two of dM(0), normal to M(0); dI_1; dI_2

struct Variations {
  std::array<std::array<Columns, 3>, K + 1> dM;
  std::array<Columns, K + 1> along;  // M.eta
};

struct MomentumSeries {
  std::array<std::array<double, 3>, K> M, w;
};

Variations variations(const MomentumSeries& s, const Vec3& D, const Vec3& u1, const Vec3& u2) {
  Variations v;
  for (std::size_t i = 0; i < 3; ++i)
    v.dM[0][i] << u1[static_cast<Eigen::Index>(i)], u2[static_cast<Eigen::Index>(i)], 0, 0;
  v.along[0].setZero();
  const Columns dD1(0, 0, -D[0] * D[0], 0), dD2(0, 0, 0, -D[1] * D[1]);
  const double d32 = D[2] - D[1], d13 = D[0] - D[2], d21 = D[1] - D[0];
  for (std::size_t k = 0; k < K; ++k) {
    Columns p23 = Columns::Zero(), p31 = p23, p12 = p23, wd = p23;
    double m23 = 0, m31 = 0, m12 = 0, m11 = 0, m22 = 0;
    for (std::size_t j = 0; j <= k; ++j) {
      const auto &m = s.M[j], &n = s.M[k - j], &w = s.w[j];
      const auto& d = v.dM[k - j];
      p23 += m[1] * d[2] + m[2] * d[1];
      p31 += m[2] * d[0] + m[0] * d[2];
      p12 += m[0] * d[1] + m[1] * d[0];
      wd += w[0] * d[0] + w[1] * d[1] + w[2] * d[2];
      m23 += m[1] * n[2], m31 += m[2] * n[0], m12 += m[0] * n[1], m11 += m[0] * n[0], m22 += m[1] * n[1];
    }
    const double f = 1.0 / static_cast<double>(k + 1);
    v.dM[k + 1] = {f * (d32 * p23 - dD2 * m23), f * (d13 * p31 + dD1 * m31), f * (d21 * p12 + (dD2 - dD1) * m12)};
    v.along[k + 1] = f * (wd + dD1 * m11 + dD2 * m22);
  }
  return v;
}

// Step within which the last terms of the variations are 4e-15 of their size, the neglected ones below 1e-15 (that of
// dM(0), or of what dI moves).
double variationStep(const Variations& v, double momentum, double largest_D) {
  const Columns size(1, 1, momentum * largest_D, momentum * largest_D);
  double log_step = 700;
  for (std::size_t k : {K, K - 1}) {
    Columns square = (v.along[k] / momentum).square();
    for (std::size_t i = 0; i < 3; ++i) square += v.dM[k][i].square();
    const double share = (square / size.square()).maxCoeff();
    if (share > 0) log_step = std::min(log_step, (-0.5 * std::log(share) - 33.2) / static_cast<double>(k));
  }
  return std::exp(log_step);
}

// The turn below which eta comes from its own equation, because dM - lambda would be a difference of nearly equal
// numbers.
constexpr double kSmallTurn = 0.05;

// eta by its own series for small turns; a dozen terms leave 1e-24 of it.
Eigen::Matrix<double, 3, 4> smallTurn(const MomentumSeries& s, const Variations& v, const Vec3& D, double h) {
  constexpr std::size_t kTerms = 12;
  std::array<std::array<Columns, 3>, kTerms + 1> eta;
  for (Columns& e : eta[0]) e.setZero();
  const Columns dD1(0, 0, -D[0] * D[0], 0), dD2(0, 0, 0, -D[1] * D[1]);
  for (std::size_t k = 0; k < kTerms; ++k) {
    std::array<Columns, 3> sum{D[0] * v.dM[k][0] + dD1 * s.M[k][0], D[1] * v.dM[k][1] + dD2 * s.M[k][1],
                               D[2] * v.dM[k][2]};
    for (std::size_t j = 0; j <= k; ++j) {
      const auto& w = s.w[j];
      const auto& e = eta[k - j];
      sum[0] += w[2] * e[1] - w[1] * e[2];
      sum[1] += w[0] * e[2] - w[2] * e[0];
      sum[2] += w[1] * e[0] - w[0] * e[1];
    }
    for (std::size_t i = 0; i < 3; ++i) eta[k + 1][i] = sum[i] / static_cast<double>(k + 1);
  }
  Eigen::Matrix<double, 3, 4> out;
  for (std::size_t i = 0; i < 3; ++i) {
    Columns sum = eta[kTerms][i];
    for (std::size_t k = kTerms; k-- > 0;) sum = sum * h + eta[k][i];
    out.row(static_cast<Eigen::Index>(i)) = sum.matrix().transpose();
  }
  return out;
}

// eta from dM and M.eta at h; `lambda` of the first two columns.
Eigen::Matrix<double, 3, 4> largeTurn(const Variations& v, double h, const Vec3& M, const Vec3& lambda1,
                                      const Vec3& lambda2) {
  std::array<Columns, 3> dM = v.dM[K];
  Columns along = v.along[K];
  for (std::size_t k = K; k-- > 0;) {
    for (std::size_t i = 0; i < 3; ++i) dM[i] = dM[i] * h + v.dM[k][i];
    along = along * h + v.along[k];
  }
  Eigen::Matrix<double, 3, 4> out;
  for (Eigen::Index c = 0; c < 4; ++c) {
    Vec3 d(dM[0][c], dM[1][c], dM[2][c]);
    if (c == 0) d -= lambda1;
    if (c == 1) d -= lambda2;
    out.col(c) = (d.cross(M) + along[c] * M) / M.squaredNorm();
  }
  return out;
}

}  // namespace

// Over [0, h] of the segment, or as much of it as the series of the variations allow: h is cut back to that.
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
  for (std::size_t k = 0; k < K; ++k) {
    const auto& u = segment.u_psi[k];
    s.M[k] = {l * u[0], l * u[1], l * u[2]};
    s.w[k] = {D_[0] * s.M[k][0], D_[1] * s.M[k][1], D_[2] * s.M[k][2]};
  }
  const Vec3 axis = M0 / l, u1 = axis.unitOrthogonal(), u2 = axis.cross(u1);
  const Variations v = variations(s, D_, u1, u2);
  h = std::min(h, variationStep(v, l, D_.maxCoeff()));
  const Mat3 Rh = orientationIn(segment, h).toRotationMatrix(), R_h0 = Rh.transpose() * R0;
  const Vec3 Mh = Rh.transpose() * L_, wh = D_.cwiseProduct(Mh);
  const Eigen::Matrix<double, 3, 4> eta =
      l * D_.maxCoeff() * h < kSmallTurn ? smallTurn(s, v, D_, h) : largeTurn(v, h, Mh, R_h0 * u1, R_h0 * u2);
  const Mat3 G = eta.col(0) * u1.transpose() + eta.col(1) * u2.transpose() + (h / l) * wh * axis.transpose();
  Mat3 H;
  H.leftCols<2>() = eta.rightCols<2>();
  H.col(2) = -D_[2] * (h * wh + H.col(0) / D_[0] + H.col(1) / D_[1]);
  const Mat3 RG = Rh * G;
  S.dtheta_dL = RG * R0.transpose();
  S.dtheta_dtheta = Mat3::Identity() + RG * skew(M0) * R0.transpose();
  S.dtheta_dI = Rh * H;
  return S;
}

RotationSensitivity TriaxialRotation::sensitivityAt(double elapsed) const {
  RotationSensitivity total;
  for (const Segment& segment : segments_) {
    if (segment.start >= elapsed && segment.start > 0) break;
    const double end = std::min(segment.length, elapsed - segment.start);
    Segment part = segment;
    for (double done = 0;;) {
      double h = end - done;
      const RotationSensitivity S = segmentSensitivity(part, h);
      total.dtheta_dL = S.dtheta_dtheta * total.dtheta_dL + S.dtheta_dL;
      total.dtheta_dI = S.dtheta_dtheta * total.dtheta_dI + S.dtheta_dI;
      total.dtheta_dtheta = S.dtheta_dtheta * total.dtheta_dtheta;
      if (!(done + h < end)) break;
      done += h;
      part = makeSegment(0, orientationIn(segment, done));
    }
  }
  return total;
}

}  // namespace carom
