// SPDX-License-Identifier: MIT
#include "adjoint/flight/flight_elliptic.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// L^2 - 2 E I_j as a sum of terms in which the moments have been subtracted first.
double excess(const Vec3& M, const Vec3& I, Eigen::Index j) {
  double sum = 0;
  for (Eigen::Index i = 0; i < 3; ++i) sum += M[i] * M[i] * (I[i] - I[j]) / I[i];
  return sum;
}

// Turn about e_z by the angle of (x, y), a unit vector.
Quat aboutZ(double x, double y) {
  if (x >= 0) {
    const double cosine = std::sqrt(0.5 * (1 + x));
    return {cosine, 0, 0, 0.5 * y / cosine};
  }
  const double sine = std::copysign(std::sqrt(0.5 * (1 - x)), y);
  return {0.5 * y / sine, 0, 0, sine};
}

// The axes in the order of the formulae: the third is the one that the body goes around, an end of the moments.
Mat3 orderedAxes(const Vec3& I, const Vec3& M) {
  std::array<Eigen::Index, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) { return I[i] < I[j]; });
  if (excess(M, I, order[1]) < 0) std::swap(order[0], order[2]);
  Mat3 P = Mat3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) P(i, order[static_cast<std::size_t>(i)]) = 1;
  if (P.determinant() < 0) P.row(1) *= -1;
  if (P.row(2).dot(M) < 0) P.bottomRows<2>() *= -1;
  return P;
}

}  // namespace

std::optional<EllipticRotation> EllipticRotation::of(const Vec3& inverse_inertia, const Quat& q, const Vec3& L) {
  const Vec3 body_M = q.toRotationMatrix().transpose() * L, body_I = inverse_inertia.cwiseInverse();
  const Mat3 P = orderedAxes(body_I, body_M);
  const Vec3 M = P * body_M, I = P.cwiseAbs() * body_I;
  const double e1 = excess(M, I, 0), e2 = excess(M, I, 1), e3 = excess(M, I, 2);
  const double m = e3 * (I[0] - I[1]) / (e1 * (I[2] - I[1])), m1 = (I[2] - I[0]) * e2 / (e1 * (I[2] - I[1]));
  constexpr double kSmallest = 1e-200;
  if (!(m > kSmallest && m1 > kSmallest && m <= 1 && m1 <= 1)) return std::nullopt;

  EllipticRotation r(m, m1);
  r.axes_ = Quat(P);
  const double side = M[0] < 0 ? -1 : 1;
  r.amplitude_ = Vec3(side * std::sqrt(e3 * I[0] / (I[0] - I[2])), -side * std::sqrt(e3 * I[1] / (I[1] - I[2])),
                      std::sqrt(e1 * I[2] / (I[2] - I[0])));
  r.p_ = std::copysign(std::sqrt(e1 * (I[2] - I[1]) / I.prod()), I[1] - I[2]);
  r.e_ = r.modulus_.incompleteF(M[0] / r.amplitude_[0], M[1] / r.amplitude_[1]);
  r.A2_ = L.norm() / I[0];
  r.prepareTheta(std::sqrt(I[0] * (I[2] - I[1]) / (I[2] * (I[1] - I[0]))));
  r.before_ = q * r.relative(0).conjugate();
  return r;
}

// eta has the amplitude whose tangent is given. In the nome of k,
//   theta_1(x + i y) ~ sum of (-1)^n q^(n (n + 1)) sin((2n + 1)(x + i y)),  x = pi u/2K, y = pi eta/2K,
// and psi grows by p times the logarithmic derivative of theta_1 at i y. In the nome of k' Jacobi's transformation
// makes it exp(-pi (u + i eta)^2/4KK') theta_1(pi (i u - eta)/2K'); the argument of the factor is linear in u, and its
// part in t cancels one of the rate's.
void EllipticRotation::prepareTheta(double tan_eta) {
  const double K = modulus_.completeK(), K1 = complement_.completeK(), eta = complement_.incompleteF(1, tan_eta);
  circular_ = K <= K1;
  const double quarter = circular_ ? K : K1, nome = elementary::exp(-M_PI * (circular_ ? K1 / K : K / K1));
  scale_ = 0.5 * M_PI / quarter;
  const double y = scale_ * eta;
  // sines and cosines of odd multiples of y, then those of even ones; sums of positive products keep their digits
  const double sine = circular_ ? elementary::sinh(y) : elementary::sin(y);
  const double cosine = circular_ ? elementary::cosh(y) : elementary::cos(y);
  const double sign = circular_ ? 1 : -1;
  const double sine2 = 2 * sine * cosine, cosine2 = cosine * cosine + sign * sine * sine;
  const auto advance = [&](double& sn, double& cn) {
    const double next = sn * cosine2 + cn * sine2;
    cn = cn * cosine2 + sign * sn * sine2, sn = next;
  };
  double weight = 1, power = 1, sn = sine, cn = cosine;
  for (std::size_t n = 0; n < kTerms; ++n) {
    re_[n] = weight * (circular_ ? cn : -sn);
    im_[n] = weight * (circular_ ? sn : cn);
    power *= nome * nome;
    weight *= -power;
    advance(sn, cn);
  }
  double slope = cosine / sine;
  power = nome * nome, sn = sine2, cn = cosine2;
  for (int n = 1; n < 40 && power * (std::abs(sn) + std::abs(cn)) > 1e-18; ++n) {
    slope -= sign * 4 * power / (1 - power) * sn;
    power *= nome * nome;
    advance(sn, cn);
  }
  A2_ += p_ * scale_ * slope;
  turn_per_half_period_ = circular_ ? M_PI : M_PI + M_PI * eta / K1;
}

EllipticRotation::Argument EllipticRotation::argumentAt(double t) const {
  const double K = modulus_.completeK(), u = p_ * t + e_, half_periods = std::round(u / (2 * K));
  return {half_periods, std::fma(-2 * K, half_periods, u)};
}

// Of length 1.
Vec3 EllipticRotation::momentumAt(const Argument& u) const {
  const EllipticModulus::Functions f = modulus_.at(u.reduced);
  const double sign = 2 * std::round(0.5 * u.half_periods) == u.half_periods ? 1 : -1;
  return amplitude_.cwiseProduct(Vec3(sign * f.cn, sign * f.sn, f.dn)).normalized();
}

Vec3 EllipticRotation::directionAt(double t) const { return axes_.conjugate() * momentumAt(argumentAt(t)); }

// exp([psi e_z]x) A(t), up to a constant turn about e_z: A is the turn of M to e_z by the shortest way, after one about
// e_z by the azimuth of M, which is taken from psi.
Quat EllipticRotation::relative(double t) const {
  const auto [half_periods, reduced] = argumentAt(t);
  const Vec3 M = momentumAt({half_periods, reduced});

  // theta_1 by Chebyshev's recurrences
  double re = 0, im = 0;
  if (circular_) {
    const auto [sine, cosine] = elementary::sincos(scale_ * reduced);
    const double twice = 2 * (cosine * cosine - sine * sine);
    double s_before = -sine, s = sine, c_before = cosine, c = cosine;
    for (std::size_t n = 0; n < kTerms; ++n) {
      re += re_[n] * s, im += im_[n] * c;
      const double s_next = twice * s - s_before, c_next = twice * c - c_before;
      s_before = s, s = s_next, c_before = c, c = c_next;
    }
  } else {
    const double b = scale_ * reduced, grow = elementary::exp(b), grow2 = grow * grow;
    double up = 0.5 * grow, down = 0.5 / grow;
    const double sinh_b = std::abs(b) < 0.5 ? elementary::sinh(b) : up - down;
    for (std::size_t n = 0; n < kTerms; ++n) {
      re += re_[n] * (up + down), im += im_[n] * (n == 0 ? sinh_b : up - down);
      up *= grow2, down /= grow2;
    }
  }
  const auto [s, c] = elementary::sincos(A2_ * t + turn_per_half_period_ * half_periods);  // of psi
  // psi + arg theta_1 less the azimuth of M
  const double x = re * M.x() + im * M.y(), y = im * M.x() - re * M.y(), size = elementary::hypot(x, y);
  const Quat spin = aboutZ((x * c - y * s) / size, (x * s + y * c) / size);
  const Quat swing(1 + M.z(), M.y(), -M.x(), 0);
  return (spin * swing).normalized() * axes_;
}

}  // namespace carom::adjoint_detail
