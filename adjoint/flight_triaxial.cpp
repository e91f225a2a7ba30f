#include "adjoint/flight_triaxial.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace carom {
namespace {

constexpr std::size_t K = TriaxialRotation::kOrder;

// Truncated to ten binary digits, so that a sum of steps is exact.
double shortBinary(double h) {
  int exponent = 0;
  const double mantissa = std::frexp(h, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, 10)), exponent - 10);
}

using Lanes = std::array<double, 4>;

// Logarithm of the radius of convergence seen from the last two coefficients of u and psi, which are of size 1.
double logRadius(const std::array<Lanes, K + 1>& c) {
  const auto from = [&](std::size_t k) {
    const double size = c[k][0] * c[k][0] + c[k][1] * c[k][1] + c[k][2] * c[k][2] + c[k][3] * c[k][3];
    return size > 0 ? -0.5 * std::log(size) / static_cast<double>(k) : 50.0;
  };
  return std::min(from(K), from(K - 1));
}

}  // namespace

void TriaxialRotation::begin(const Vec3& inverse_inertia, const Quat& q, const Vec3& L) {
  D_ = inverse_inertia;
  L_ = L;
  q_ = q;
  segments_.clear();
}

// With a = u(0).(D u(0)), which is u.(D u) at all times, psi' = l f and f = ((D u(0)).u + a) / (1 + u(0).u). All sums are
// Cauchy products of a left and a right series, in four lanes that the compiler keeps in vector registers:
//   left (u_2, u_3, u_1, 1 + u(0).u), right (u_3, u_1, u_2, f).
void TriaxialRotation::append(double start, const Quat& q) {
  Segment& s = segments_.emplace_back();
  s.start = start;
  s.q = q;
  const double l = L_.norm();
  if (l == 0) {
    s.length = 1e300;
    return;
  }
  const Vec3 u0 = (q.toRotationMatrix().transpose() * L_).normalized(), Du0 = D_.cwiseProduct(u0);
  const double a = u0.dot(Du0);
  const Lanes rate{l * (D_[2] - D_[1]), l * (D_[0] - D_[2]), l * (D_[1] - D_[0]), l};
  std::array<Lanes, K> left, right;
  s.u_psi[0] = {u0[0], u0[1], u0[2], 0};
  for (std::size_t k = 0; k < K; ++k) {
    const Lanes& u = s.u_psi[k];
    const double first = k == 0 ? 1.0 : 0.0;
    left[k] = {u[1], u[2], u[0], first + u0[0] * u[0] + u0[1] * u[1] + u0[2] * u[2]};
    right[k] = {u[2], u[0], u[1], 0};  // f_k is not known yet
    Lanes sum{};
    for (std::size_t j = 0; j <= k; ++j)
      for (std::size_t i = 0; i < 4; ++i) sum[i] += left[j][i] * right[k - j][i];
    sum[3] = right[k][3] = (first * a + Du0[0] * u[0] + Du0[1] * u[1] + Du0[2] * u[2] - sum[3]) / left[0][3];
    for (std::size_t i = 0; i < 4; ++i) s.u_psi[k + 1][i] = rate[i] * sum[i] / static_cast<double>(k + 1);
  }
  // e^-1.85 of the radius makes the last term 1e-16 of the whole and the first neglected one about 1e-17
  s.length = shortBinary(std::exp(logRadius(s.u_psi) - 1.85));
}

Quat TriaxialRotation::orientationIn(const Segment& s, double h) {
  if (h == 0) return s.q;
  Lanes sum = s.u_psi[K];
  for (std::size_t k = K; k-- > 0;)
    for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] * h + s.u_psi[k][i];
  const Vec3 u0(s.u_psi[0][0], s.u_psi[0][1], s.u_psi[0][2]), u(sum[0], sum[1], sum[2]);
  const Vec3 twist = std::sin(0.5 * sum[3]) * u0, swing = u.cross(u0);  // the inverse swing, from u to u(0)
  return (s.q * (Quat(std::cos(0.5 * sum[3]), twist.x(), twist.y(), twist.z()) *
                 Quat(1 + u0.dot(u), swing.x(), swing.y(), swing.z())))
      .normalized();
}

void TriaxialRotation::extendTo(double elapsed) {
  if (segments_.empty()) {
    segments_.reserve(8);
    append(0, q_);
  }
  while (segments_.back().start + segments_.back().length < elapsed) {
    const Segment& last = segments_.back();
    append(last.start + last.length, orientationIn(last, last.length));
  }
}

const TriaxialRotation::Segment& TriaxialRotation::segmentAt(double elapsed) const {
  assert(!segments_.empty() && elapsed <= segments_.back().start + segments_.back().length);
  auto next = std::upper_bound(segments_.begin(), segments_.end(), elapsed,
                               [](double t, const Segment& s) { return t < s.start; });
  return next == segments_.begin() ? *next : *(next - 1);
}

Quat TriaxialRotation::orientationAt(double elapsed) const {
  const Segment& s = segmentAt(elapsed);
  return orientationIn(s, elapsed - s.start);
}

// Variations in principal axes, eta = R^T dtheta and dM = R^T dL + M x eta, obey (w = D M)
//   dM'_1 = (D3 - D2)(dM2 M3 + M2 dM3) + (dD3 - dD2) M2 M3, cyclic;   eta' = -w x eta + D dM + dD M.
// By superposition eta(h) = R(h)^T R(0) eta(0) + G dM(0) + H dI, so
//   dtheta(h) = dtheta(0) + R(h) G (R(0)^T dL + M(0) x R(0)^T dtheta(0)) + R(h) H dI.
// Two columns of G and H need no equation: L -> s L is a change of time scale, so G M(0) = h w(h); I -> s I likewise,
// so H I = -h w(h). Four columns are integrated, as Taylor series on the coefficients of the segment.
RotationSensitivity TriaxialRotation::segmentSensitivity(const Segment& s, double h) const {
  using Columns = Eigen::Array4d;
  using Triple = std::array<Columns, 3>;
  const Mat3 R0 = s.q.toRotationMatrix(), Rh = orientationIn(s, h).toRotationMatrix();
  const Vec3 M0 = R0.transpose() * L_;
  const Vec3 wh = D_.cwiseProduct(Rh.transpose() * L_);
  RotationSensitivity S;
  if (M0.isZero(0)) {  // at rest: dM is constant and eta = h D dM
    S.dtheta_dL = h * R0 * D_.asDiagonal() * R0.transpose();
    return S;
  }
  const Vec3 axis = M0.normalized(), u1 = axis.unitOrthogonal(), u2 = axis.cross(u1);
  std::array<Triple, K + 1> dM, eta;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    dM[0][i] << u1[e], u2[e], 0, 0;
    eta[0][i].setZero();
  }
  Columns dD0(0, 0, -D_[0] * D_[0], 0), dD1(0, 0, 0, -D_[1] * D_[1]);  // columns 2, 3: unit dI1, dI2
  const double d32 = D_[2] - D_[1], d13 = D_[0] - D_[2], d21 = D_[1] - D_[0];
  const double l = L_.norm();
  std::array<std::array<double, 3>, K> M, w;
  for (std::size_t k = 0; k < K; ++k) {
    M[k] = {l * s.u_psi[k][0], l * s.u_psi[k][1], l * s.u_psi[k][2]};
    w[k] = {D_[0] * M[k][0], D_[1] * M[k][1], D_[2] * M[k][2]};
    Columns p23 = Columns::Zero(), p31 = p23, p12 = p23, e1 = p23, e2 = p23, e3 = p23;
    double m23 = 0, m31 = 0, m12 = 0;
    for (std::size_t j = 0; j <= k; ++j) {
      const auto &m = M[j], &n = M[k - j], &o = w[j];
      const Triple &d = dM[k - j], &e = eta[k - j];
      p23 += m[1] * d[2] + m[2] * d[1];
      p31 += m[2] * d[0] + m[0] * d[2];
      p12 += m[0] * d[1] + m[1] * d[0];
      e1 += o[2] * e[1] - o[1] * e[2];
      e2 += o[0] * e[2] - o[2] * e[0];
      e3 += o[1] * e[0] - o[0] * e[1];
      m23 += m[1] * n[2], m31 += m[2] * n[0], m12 += m[0] * n[1];
    }
    const double f = 1.0 / static_cast<double>(k + 1);
    dM[k + 1] = {f * (d32 * p23 - dD1 * m23), f * (d13 * p31 + dD0 * m31), f * (d21 * p12 + (dD1 - dD0) * m12)};
    eta[k + 1] = {f * (e1 + D_[0] * dM[k][0] + dD0 * M[k][0]), f * (e2 + D_[1] * dM[k][1] + dD1 * M[k][1]),
                  f * (e3 + D_[2] * dM[k][2])};
  }
  Eigen::Matrix<double, 3, 4> end;
  for (std::size_t i = 0; i < 3; ++i) {
    Columns sum = eta[K][i];
    for (std::size_t k = K; k-- > 0;) sum = sum * h + eta[k][i];
    end.row(static_cast<Eigen::Index>(i)) = sum.matrix().transpose();
  }
  const Mat3 G = end.col(0) * u1.transpose() + end.col(1) * u2.transpose() + (h / M0.norm()) * wh * axis.transpose();
  Mat3 H;
  H.leftCols<2>() = end.rightCols<2>();
  H.col(2) = -D_[2] * (h * wh + H.col(0) / D_[0] + H.col(1) / D_[1]);
  const Mat3 RG = Rh * G;
  S.dtheta_dL = RG * R0.transpose();
  S.dtheta_dtheta = Mat3::Identity() + RG * skew(M0) * R0.transpose();
  S.dtheta_dI = Rh * H;
  return S;
}

RotationSensitivity TriaxialRotation::sensitivityAt(double elapsed) const {
  RotationSensitivity total;
  for (const Segment& s : segments_) {
    if (s.start >= elapsed && s.start > 0) break;
    const RotationSensitivity S = segmentSensitivity(s, std::min(s.length, elapsed - s.start));
    total.dtheta_dL = S.dtheta_dtheta * total.dtheta_dL + S.dtheta_dL;
    total.dtheta_dI = S.dtheta_dtheta * total.dtheta_dI + S.dtheta_dI;
    total.dtheta_dtheta = S.dtheta_dtheta * total.dtheta_dtheta;
  }
  return total;
}

}  // namespace carom
