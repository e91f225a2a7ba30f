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

template <std::size_t N>
double norm(const std::array<double, N>& c) {
  double sum = 0;
  for (double x : c) sum += x * x;
  return std::sqrt(sum);
}

// Logarithm of the radius of convergence seen from the last two coefficients of a series of size `scale`.
template <class Series>
double logRadius(const Series& c, double scale) {
  const auto from = [&](std::size_t k) {
    const double size = norm(c[k]);
    return size > 0 ? std::log(scale / size) / static_cast<double>(k) : 50.0;
  };
  return std::min(from(K), from(K - 1));
}

template <std::size_t N>
std::array<double, N> horner(const std::array<std::array<double, N>, K + 1>& c, double h) {
  std::array<double, N> sum = c[K];
  for (std::size_t k = K; k-- > 0;)
    for (std::size_t i = 0; i < N; ++i) sum[i] = sum[i] * h + c[k][i];
  return sum;
}

using MomentumSeries = std::array<std::array<double, 3>, K + 1>;

Quat unitQuaternion(const std::array<double, 4>& c) { return Quat(c[3], c[0], c[1], c[2]).normalized(); }

}  // namespace

void TriaxialRotation::begin(const Vec3& inverse_inertia, const Quat& q, const Vec3& L) {
  D_ = inverse_inertia;
  L_ = L;
  q_ = q;
  segments_.clear();
}

std::array<double, 3> TriaxialRotation::momentum(const Quat& q) const {
  const Vec3 M = q.toRotationMatrix().transpose() * L_;
  return {M.x(), M.y(), M.z()};
}

// Taylor coefficients from M' = M x (D M), q' = 1/2 q o (0, D M), order by order. With w = D M / 2 the product is
//   q o (0, w) = w_0 (q_w, q_z, -q_y, -q_x) + w_1 (-q_z, q_w, q_x, -q_y) + w_2 (q_y, -q_x, q_w, -q_z),
// written over four lanes so that the compiler keeps them in vector registers.
void TriaxialRotation::append(double start, const Quat& q0) {
  using Lanes = std::array<double, 4>;
  Segment& s = segments_.emplace_back();
  s.start = start;
  MomentumSeries M;
  M[0] = momentum(q0);
  s.q[0] = {q0.x(), q0.y(), q0.z(), q0.w()};
  const double d32 = D_[2] - D_[1], d13 = D_[0] - D_[2], d21 = D_[1] - D_[0];
  std::array<std::array<double, 3>, K> w;
  std::array<std::array<Lanes, 3>, K> turned;  // q by each component of w
  for (std::size_t k = 0; k < K; ++k) {
    const Lanes& q = s.q[k];
    turned[k] = {Lanes{q[3], q[2], -q[1], -q[0]}, Lanes{-q[2], q[3], q[0], -q[1]}, Lanes{q[1], -q[0], q[3], -q[2]}};
    for (std::size_t i = 0; i < 3; ++i) w[k][i] = 0.5 * D_[static_cast<Eigen::Index>(i)] * M[k][i];
    double m23 = 0, m31 = 0, m12 = 0;
    Lanes sum{};
    for (std::size_t j = 0; j <= k; ++j) {
      const auto &a = M[j], &b = M[k - j], &o = w[k - j];
      const auto& p = turned[j];
      m23 += a[1] * b[2], m31 += a[2] * b[0], m12 += a[0] * b[1];
      for (std::size_t l = 0; l < 4; ++l) sum[l] += o[0] * p[0][l] + o[1] * p[1][l] + o[2] * p[2][l];
    }
    const double f = 1.0 / static_cast<double>(k + 1);
    M[k + 1] = {d32 * m23 * f, d13 * m31 * f, d21 * m12 * f};
    for (std::size_t l = 0; l < 4; ++l) s.q[k + 1][l] = f * sum[l];
  }
  // h = radius / e^2 makes the first neglected term about e^(-2 K) = 4e-18 of the whole
  const double log_radius = std::min(logRadius(s.q, 1.0), logRadius(M, std::max(L_.norm(), 1e-300)));
  s.length = shortBinary(std::exp(log_radius - 2));
}

void TriaxialRotation::extendTo(double elapsed) {
  if (segments_.empty()) {
    segments_.reserve(8);
    append(0, q_);
  }
  while (segments_.back().start + segments_.back().length < elapsed) {
    const Segment& last = segments_.back();
    append(last.start + last.length, unitQuaternion(horner(last.q, last.length)));
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
  return unitQuaternion(horner(s.q, elapsed - s.start));
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
  MomentumSeries M;
  M[0] = momentum(unitQuaternion(s.q[0]));
  const Vec3 M0(M[0][0], M[0][1], M[0][2]);
  const Mat3 R0 = unitQuaternion(s.q[0]).toRotationMatrix();
  const Mat3 Rh = unitQuaternion(horner(s.q, h)).toRotationMatrix();
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
  std::array<std::array<double, 3>, K> w;
  for (std::size_t k = 0; k < K; ++k) {
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
    M[k + 1] = {d32 * m23 * f, d13 * m31 * f, d21 * m12 * f};
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
