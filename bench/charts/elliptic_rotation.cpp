#include "bench/charts/elliptic_rotation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::charts {
namespace {

// The arithmetic-geometric mean gives all of it, from 1 - m, so that no digits are lost near m = 1.
double completeK(double m1) {
  double a = 1, b = std::sqrt(m1);
  for (int i = 0; i < 12 && std::abs(a - b) > 1e-16 * a; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return M_PI / (a + b);
}

// F(phi | m), |phi| <= pi/2
double incompleteF(double phi, double m1) {
  double a = 1, b = std::sqrt(m1), power = 1;
  for (int i = 0; i < 12 && std::abs(a - b) > 1e-16 * a; ++i) {
    // tan(next - phi) = b/a tan phi, on the branch next to 2 phi
    const double turns = std::round(phi / M_PI);
    phi += turns * M_PI + std::atan2(b * std::sin(phi - turns * M_PI), a * std::cos(phi - turns * M_PI));
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
    power *= 2;
  }
  return phi / (power * a);
}

struct Jacobi {
  double sn, cn, dn;
};

Jacobi jacobi(double u, double m1) {
  std::array<double, 14> ratio{};
  double a = 1, b = std::sqrt(m1), power = 1;
  std::size_t n = 0;
  while (n + 1 < ratio.size() && std::abs(a - b) > 1e-16 * a) {
    const double c = 0.5 * (a - b), mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
    power *= 2;
    ratio[++n] = c / a;
  }
  double phi = power * a * u;
  for (; n > 0; --n) phi = 0.5 * (phi + std::asin(ratio[n] * std::sin(phi)));
  const double sn = std::sin(phi), cn = std::cos(phi);
  return {sn, cn, std::sqrt(cn * cn + m1 * sn * sn)};
}

// Turns the direction of M to e_z, about e_z no more than the azimuth of M.
Mat3 toZ(const Vec3& M) {
  const Vec3 u = M.normalized();
  const double across = std::hypot(u.x(), u.y());
  Mat3 B;
  B.row(0) << u.x() * u.z() / across, u.y() * u.z() / across, -across;
  B.row(1) << -u.y() / across, u.x() / across, 0;
  B.row(2) = u;
  return B;
}

}  // namespace

EllipticRotation::EllipticRotation(const Vec3& inverse_inertia, const Quat& q, const Vec3& L) : l_(L.norm()) {
  const Mat3 R0 = q.toRotationMatrix();
  Vec3 M = R0.transpose() * L;
  const Vec3 I = inverse_inertia.cwiseInverse();
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return I[i] < I[j]; });
  // L^2 - 2 E I_j, term by term
  const auto excess = [&](double Ij) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += M[i] * M[i] * (I[i] - Ij) / I[i];
    return sum;
  };
  if (excess(I[order[1]]) < 0) std::swap(order[0], order[2]);
  P_.setZero();
  for (int i = 0; i < 3; ++i) P_(i, order[static_cast<std::size_t>(i)]) = 1;
  if (P_.determinant() < 0) P_.row(1) *= -1;
  if (P_.row(2).dot(M) < 0) P_.bottomRows<2>() *= -1;
  const double e1 = excess(I[order[0]]), e2 = excess(I[order[1]]), e3 = excess(I[order[2]]);
  for (int i = 0; i < 3; ++i) I_[i] = I[order[static_cast<std::size_t>(i)]];
  M = P_ * M;
  const double side = M[0] < 0 ? -1 : 1;
  amplitude_ = Vec3(side * std::sqrt(e3 * I_[0] / (I_[0] - I_[2])), -side * std::sqrt(e3 * I_[1] / (I_[1] - I_[2])),
                    std::sqrt(e1 * I_[2] / (I_[2] - I_[0])));
  p_ = std::copysign(std::sqrt(e1 * (I_[2] - I_[1]) / (I_[0] * I_[1] * I_[2])), I_[1] - I_[2]);
  m_ = e3 * (I_[0] - I_[1]) / (e1 * (I_[2] - I_[1]));
  m1_ = (I_[2] - I_[0]) * e2 / (e1 * (I_[2] - I_[1]));
  e_ = incompleteF(std::atan2(M[1] / amplitude_[1], M[0] / amplitude_[0]), m1_);

  K_ = completeK(m1_);
  const double K1 = completeK(m_);
  nome_ = std::exp(-M_PI * K1 / K_);
  // sin of the angle is amplitude_[2] / l; the cosine without cancellation
  const double across = std::sqrt(e3 * I_[0] / (I_[0] - I_[2]));
  eta_ = K1 - incompleteF(std::atan2(amplitude_[2], across), m_);
  const double xi = std::exp(M_PI * eta_ / K_), q2 = nome_ * nome_;
  double sum = (xi + 1) / (xi - 1), power = 1, grows = 1;
  for (int n = 1; n < 400; ++n) {
    power *= q2, grows *= xi;
    const double term = 2 * power / (1 - power) * (grows - 1 / grows);
    sum -= term;
    if (std::abs(term) < 1e-17 * std::abs(sum)) break;
  }
  A2_ = l_ / I_[0] + M_PI * p_ / (2 * K_) * sum;
  A1_ = -thetaArgument(e_);
  before_ = R0 * P_.transpose() * toZ(momentumAt(e_)).transpose();
}

Vec3 EllipticRotation::momentumAt(double u) const {
  const Jacobi j = jacobi(u, m1_);
  return amplitude_.cwiseProduct(Vec3(j.cn, j.sn, j.dn));
}

// arg of the sum over n of (-1)^n q^(n (n + 1)) sin((2 n + 1) (x + i y)), by Chebyshev's recurrences
double EllipticRotation::thetaArgument(double u) const {
  const double x = 0.5 * M_PI * u / K_, y = 0.5 * M_PI * eta_ / K_;
  const double grow = std::exp(y), c2 = 2 * std::cos(2 * x), sin_x = std::sin(x), cos_x = std::cos(x);
  double s_before = -sin_x, s = sin_x, c_before = cos_x, c = cos_x, up = grow, down = 1 / grow;
  double weight = 1, power = 1, re = 0, im = 0;
  for (int n = 0; n < 60; ++n) {
    re += weight * 0.5 * (up + down) * s;
    im += weight * 0.5 * (up - down) * c;
    power *= nome_ * nome_;
    weight *= -power;
    up *= grow * grow, down /= grow * grow;
    if (std::abs(weight) * up < 1e-17 * grow) break;
    const double s_next = c2 * s - s_before, c_next = c2 * c - c_before;
    s_before = s, s = s_next, c_before = c, c = c_next;
  }
  return std::atan2(im, re);
}

Quat EllipticRotation::orientationAt(double t) const {
  const double u = p_ * t + e_;
  const double psi = A1_ + A2_ * t + thetaArgument(u);
  return Quat(Mat3(before_ * Eigen::AngleAxisd(psi, Vec3::UnitZ()).toRotationMatrix() * toZ(momentumAt(u)) * P_))
      .normalized();
}

}  // namespace carom::charts
