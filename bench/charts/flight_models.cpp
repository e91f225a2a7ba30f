// SPDX-License-Identifier: MIT
#include "bench/charts/flight_models.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::charts {
namespace {

using Vec4 = Eigen::Vector4d;

Vec3 spinOf(const Vec3& D, const Quat& q, const Vec3& L) { return q * D.cwiseProduct(q.conjugate() * L); }

// q' = 1/2 (0, omega) q with q as (x, y, z, w), Eigen's order. Not normalised within a step.
Vec4 rate(const Vec3& D, const Vec4& y, const Vec3& L) {
  const Quat q(y);
  const Vec3 w = spinOf(D, q.normalized(), L);
  return 0.5 * (Quat(0, w.x(), w.y(), w.z()) * q).coeffs();
}

Quat turn(const Vec3& theta) {
  const double half = 0.5 * theta.norm();
  const double s = half > 1e-8 ? 0.5 * std::sin(half) / half : 0.5;
  return {std::cos(half), s * theta.x(), s * theta.y(), s * theta.z()};
}

// Equal steps that end at t.
template <class Step>
Quat inSteps(const Quat& start, double t, double step, const Step& advance) {
  Quat q = start;
  const double count = std::max(1.0, std::ceil(std::abs(t) / step - 1e-9));
  const double h = t / count;
  for (double i = 0; i < count; ++i) q = advance(q, h).normalized();
  return q;
}

Quat rungeKutta4(const Vec3& D, const Quat& start, const Vec3& L, double t, double step) {
  return inSteps(start, t, step, [&](const Quat& q, double h) {
    const Vec4 y = q.coeffs();
    const Vec4 a = rate(D, y, L), b = rate(D, y + 0.5 * h * a, L), c = rate(D, y + 0.5 * h * b, L),
               d = rate(D, y + h * c, L);
    return Quat(Vec4(y + h / 6 * (a + 2 * b + 2 * c + d)));
  });
}

Quat commutatorFree4(const Vec3& D, const Quat& start, const Vec3& L, double t, double step) {
  return inSteps(start, t, step, [&](const Quat& q, double h) {
    const Vec3 a = h * spinOf(D, q, L);
    const Quat at_b = turn(0.5 * a) * q;
    const Vec3 b = h * spinOf(D, at_b, L);
    const Vec3 c = h * spinOf(D, turn(0.5 * b) * q, L);
    const Vec3 d = h * spinOf(D, turn(c - 0.5 * a) * at_b, L);
    const Quat first = turn((3 * a + 2 * b + 2 * c - d) / 12) * q;
    return turn((-a + 2 * b + 2 * c + 3 * d) / 12) * first;
  });
}

// The kinetic energy is the sum over the axes of M_i^2/(2 I_i); each term alone turns the body about one of its axes at
// a constant rate.
Quat splitting2(const Vec3& D, const Quat& start, const Vec3& L, double t, double step) {
  return inSteps(start, t, step, [&](Quat q, double h) {
    const auto about = [&](int axis, double time) {
      const double M = (q.conjugate() * L)[axis];
      q = q * turn(time * D[axis] * M * Vec3::Unit(axis));
    };
    about(0, 0.5 * h), about(1, 0.5 * h), about(2, h), about(1, 0.5 * h), about(0, 0.5 * h);
    return q;
  });
}

struct Fehlberg78 {
  static constexpr int kStages = 13;
  // rows of the tableau: stage i uses the first i entries
  static constexpr double a[kStages][kStages - 1] = {
      {},
      {2.0 / 27},
      {1.0 / 36, 1.0 / 12},
      {1.0 / 24, 0, 1.0 / 8},
      {5.0 / 12, 0, -25.0 / 16, 25.0 / 16},
      {1.0 / 20, 0, 0, 1.0 / 4, 1.0 / 5},
      {-25.0 / 108, 0, 0, 125.0 / 108, -65.0 / 27, 125.0 / 54},
      {31.0 / 300, 0, 0, 0, 61.0 / 225, -2.0 / 9, 13.0 / 900},
      {2, 0, 0, -53.0 / 6, 704.0 / 45, -107.0 / 9, 67.0 / 90, 3},
      {-91.0 / 108, 0, 0, 23.0 / 108, -976.0 / 135, 311.0 / 54, -19.0 / 60, 17.0 / 6, -1.0 / 12},
      {2383.0 / 4100, 0, 0, -341.0 / 164, 4496.0 / 1025, -301.0 / 82, 2133.0 / 4100, 45.0 / 82, 45.0 / 164, 18.0 / 41},
      {3.0 / 205, 0, 0, 0, 0, -6.0 / 41, -3.0 / 205, -3.0 / 41, 3.0 / 41, 6.0 / 41, 0},
      {-1777.0 / 4100, 0, 0, -341.0 / 164, 4496.0 / 1025, -289.0 / 82, 2193.0 / 4100, 51.0 / 82, 33.0 / 164, 12.0 / 41,
       0, 1}};
  static constexpr double b[kStages] = {0,        0,         0,         0, 0,          34.0 / 105, 9.0 / 35,
                                        9.0 / 35, 9.0 / 280, 9.0 / 280, 0, 41.0 / 840, 41.0 / 840};
};

Quat fehlberg78(const Vec3& D, const Quat& start, const Vec3& L, double t, double tolerance) {
  Vec4 y = start.coeffs();
  const double rate_scale = (D.maxCoeff() - D.minCoeff()) * L.norm() + D.maxCoeff() * L.norm();
  double done = 0, h = std::min(std::abs(t), 0.5 / std::max(rate_scale, 1e-300));
  const double sign = t < 0 ? -1 : 1;
  while (done < std::abs(t)) {
    h = std::min(h, std::abs(t) - done);
    std::array<Vec4, Fehlberg78::kStages> k;
    for (int i = 0; i < Fehlberg78::kStages; ++i) {
      Vec4 at = y;
      for (int j = 0; j < i; ++j) at += sign * h * Fehlberg78::a[i][j] * k[static_cast<std::size_t>(j)];
      k[static_cast<std::size_t>(i)] = rate(D, at, L);
    }
    Vec4 next = y;
    for (int i = 0; i < Fehlberg78::kStages; ++i) next += sign * h * Fehlberg78::b[i] * k[static_cast<std::size_t>(i)];
    // angles are twice the quaternion's
    const double error = 2 * h * 41.0 / 840 * (k[0] + k[10] - k[11] - k[12]).norm();
    if (error <= tolerance || h < 1e-12 * std::abs(t)) {
      done += h;
      y = next.normalized();
    }
    h *= std::clamp(0.9 * std::pow(tolerance / std::max(error, 1e-300), 1.0 / 8), 0.2, 4.0);
  }
  return Quat(y);
}

}  // namespace

const std::vector<FlightModel>& flightModels() {
  static const std::vector<FlightModel> models = {{"RK4", false, rungeKutta4},
                                                  {"Fehlberg 7(8)", true, fehlberg78},
                                                  {"Lie group 4", false, commutatorFree4},
                                                  {"splitting 2", false, splitting2}};
  return models;
}

}  // namespace carom::charts
