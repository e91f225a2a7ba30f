// SPDX-License-Identifier: MIT
// Free rotation: the reference against independent statements about it, then Arc against the reference.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "adjoint/flight/arc.h"
#include "adjoint/flight/flight_triaxial.hpp"
#include "tests/reference/replay.h"
#include "tests/reference/worst.h"

namespace carom::reference {

using namespace adjoint_detail;

namespace {

constexpr unsigned kSeed = 20240611;

struct Spinner {
  Vec3 inertia, L;
  Quat q;
  double time;  ///< for about ten revolutions
};

Spinner randomSpinner(std::mt19937& generator) {
  std::uniform_real_distribution<double> one(0, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    return Vec3(x, y, z);
  };
  Spinner s;
  // a box's moments always obey the triangle inequality; sometimes two or three are nearly equal
  const double z = one(generator), y = one(generator), x = one(generator);
  Vec3 size = Vec3::Constant(0.3) + 0.7 * Vec3(x, y, z);
  const double kind = one(generator);
  if (kind < 0.2) size.y() = size.x() * (1 + 1e-6 * one(generator));
  if (kind < 0.1) size.z() = size.x() * (1 + 1e-7 * one(generator));
  const double mass = std::exp(2 * normal(generator));
  const Vec3 square = size.cwiseAbs2();
  s.inertia = mass / 12 * Vec3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
  const double faster = std::exp(normal(generator));
  const Vec3 w_body = vector() * faster;
  const Vec3 v = vector();
  s.q = Quat(normal(generator), v.x(), v.y(), v.z()).normalized();
  s.L = s.q * s.inertia.cwiseProduct(w_body);
  s.time = 10 * 2 * M_PI / w_body.norm();
  return s;
}

double worst(const Mat3& found, const Mat3& expected) {
  double error = 0;
  const double scale = std::max(expected.cwiseAbs().maxCoeff(), 1e-3);
  for (int i = 0; i < 9; ++i) keepWorst(error, std::abs(found(i) - expected(i)) / scale);
  return error;
}

/// Two equal moments: the closed form of docs/equations.md section 2.
TEST(FreeRotation, SymmetricClosedForm) {
  const Vec3 L(0.4, -0.7, 1.1);
  const Quat q = Quat(0.4, 0.3, -0.8, 0.2).normalized();
  const Mat3 R0 = q.toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 inertia = Vec3::Constant(0.3);
    inertia[axis] = 0.45;
    for (const double t : {0.0, 0.3, 2.0, 7.0}) {
      const double L_axis = (R0.transpose() * L)[axis];
      const Mat3 expected = Mat3(Eigen::AngleAxisd(L.norm() / 0.3 * t, L.normalized())) * R0 *
                            Mat3(Eigen::AngleAxisd((1 / 0.45 - 1 / 0.3) * L_axis * t, Vec3::Unit(axis)));
      EXPECT_LE(worst(freeRotation(inertia, q, L, {t}, false)[0].R, expected), 1e-14 * (1 + 20 * t));
    }
  }
}

/// Three different moments against the plainest integrator there is (Runge-Kutta of order 4 on the rotation matrix).
TEST(FreeRotation, PlainRungeKutta) {
  using Mat = Eigen::Matrix<long double, 3, 3>;
  using Vec = Eigen::Matrix<long double, 3, 1>;
  const Vec3 inertia(0.2, 0.31, 0.44), L(0.4, -0.7, 1.1);
  const Quat q = Quat(0.4, 0.3, -0.8, 0.2).normalized();
  const Vec momentum = L.cast<long double>(), inverse = inertia.cast<long double>().cwiseInverse();
  const auto rate = [&](const Mat& R) {
    const Vec w = R * inverse.cwiseProduct(Vec(R.transpose() * momentum));
    Mat turning;
    for (int j = 0; j < 3; ++j) turning.col(j) = w.cross(R.col(j));
    return turning;
  };
  Mat R = q.cast<long double>().toRotationMatrix();
  const double T = 3;
  const int steps = 60000;
  const long double h = static_cast<long double>(T) / steps;
  for (int i = 0; i < steps; ++i) {
    const Mat a = rate(R), b = rate(R + h / 2 * a), c = rate(R + h / 2 * b), d = rate(R + h * c);
    R += h / 6 * (a + 2 * b + 2 * c + d);
  }
  EXPECT_LE(worst(freeRotation(inertia, q, L, {T}, false)[0].R, R.cast<double>()), 3e-15);
}

/// Turning everything turns the result; momentum and inertia scaled together change nothing.
TEST(FreeRotation, SensitivityIdentities) {
  std::mt19937 generator(kSeed);
  for (int i = 0; i < 6; ++i) {
    const Spinner s = randomSpinner(generator);
    const Rotation r = freeRotation(s.inertia, s.q, s.L, {s.time / 10}, true)[0];
    const Mat3 turned = r.dtheta_dtheta - r.dtheta_dL * skew(s.L);
    EXPECT_LE(worst(turned, Mat3::Identity()), 1e-12);
    const Vec3 scaled = r.dtheta_dL * s.L + r.dtheta_dI * s.inertia;
    EXPECT_LE(scaled.norm(), 1e-13 * (1 + (r.dtheta_dL * s.L).norm()));
  }
}

/// Arcs over about ten revolutions, entry by entry of the blocks' scales.
TEST(FreeRotation, TriaxialArcs) {
  constexpr int kBodies = 32, kWithSensitivities = 5;
  std::cout << "seed " << kSeed << '\n';
  std::mt19937 generator(kSeed);
  double worst_state = 0, worst_sensitivity = 0;
  for (int i = 0; i < kBodies; ++i) {
    const Spinner s = randomSpinner(generator);
    BodyModel model;
    model.moving = true;
    model.mass = model.inverse_mass = 1;
    model.inertia = s.inertia, model.inverse_inertia = s.inertia.cwiseInverse();
    State start;
    start.q = s.q, start.L = s.L;
    Arc arc(model, Tier::triaxial, Vec3(0, 0, -9.81), 0, start);
    arc.extendTo(s.time);
    const std::vector<double> times = {0.013 * s.time, 0.31 * s.time, s.time};
    const bool sensitivities = i < kWithSensitivities;
    const auto expected = freeRotation(s.inertia, s.q, s.L, times, sensitivities);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double state = worst(arc.stateAt(times[k]).q.toRotationMatrix(), expected[k].R);
      EXPECT_LE(state, 1e-13) << "body " << i << " at " << times[k] << " of " << s.time;
      keepWorst(worst_state, state);
      if (!sensitivities) continue;
      const RotationSensitivity S = arc.rotationSensitivity(times[k], Tier::triaxial);
      for (const double error :
           {worst(S.dtheta_dtheta, expected[k].dtheta_dtheta), worst(S.dtheta_dL, expected[k].dtheta_dL),
            worst(S.dtheta_dI, expected[k].dtheta_dI)}) {
        EXPECT_LE(error, 1e-11) << "body " << i << " at " << times[k] << " of " << s.time;
        keepWorst(worst_sensitivity, error);
      }
    }
  }
  std::cout << "worst orientation " << worst_state << ", worst sensitivity " << worst_sensitivity << '\n';
}

struct NamedFlight {
  std::string what;
  Vec3 inertia, spin;  // in principal axes
  double time;
};

/// Errors in multiples of what the rounding of the start is worth at the end.
void expectExact(const std::vector<NamedFlight>& flights) {
  const Quat q = Quat(0.4, 0.3, -0.8, 0.2).normalized();
  double worst_state = 0, worst_sensitivity = 0;
  for (const NamedFlight& flight : flights) {
    SCOPED_TRACE(flight.what);
    const Vec3 L = q * flight.inertia.cwiseProduct(flight.spin);
    TriaxialRotation rotation;
    rotation.begin(flight.inertia.cwiseInverse(), q, L);
    rotation.extendTo(flight.time);
    const Rotation exact = freeRotation(flight.inertia, q, L, {flight.time}, true)[0];
    const double rounding = 1.1e-16 * (exact.dtheta_dtheta.norm() + exact.dtheta_dL.norm() * L.norm() +
                                       (exact.dtheta_dI * flight.inertia.asDiagonal()).norm());
    const double state = worst(rotation.orientationAt(flight.time).toRotationMatrix(), exact.R) / rounding;
    EXPECT_LE(state, 10) << "roundings of the start";
    keepWorst(worst_state, state);
    const RotationSensitivity S = rotation.sensitivityAt(flight.time);
    // sensitivities of sensitivities are of the size of their squares
    const double unit = rounding * exact.dtheta_dtheta.norm();
    for (const double error : {worst(S.dtheta_dtheta, exact.dtheta_dtheta), worst(S.dtheta_dL, exact.dtheta_dL),
                               worst(S.dtheta_dI, exact.dtheta_dI)}) {
      EXPECT_LE(error, 10 * unit);
      keepWorst(worst_sensitivity, error / unit);
    }
  }
  std::cout << "worst orientation " << worst_state << " roundings of the start, worst sensitivity " << worst_sensitivity
            << " of them times their growth\n";
}

/// Flights of many periods, where the closed form and the formula for whole periods are in use.
TEST(FreeRotation, LongFlights) {
  const Vec3 direction = Vec3(2, -1, 2) / 3, nearly_middle = Vec3(1e-3, 1, 1e-3).normalized();
  const std::vector<NamedFlight> flights = {
      {"box", {0.0045, 0.0087, 0.0108}, direction, 50},
      {"nearly symmetric", {1, 1 + 1e-6, 1.7}, direction, 50},
      {"nearly symmetric about the least", {1, 1.7, 1.7 + 1e-9}, direction, 50},
      {"strongly triaxial", {1, 3, 3.9}, direction, 50},
      {"backwards about the greatest", {1, 2, 2.5}, {0.3, -0.2, -1}, 50},
      {"nearly about the least", {1, 2, 2.5}, {1, 1e-6, 1e-6}, 40},
      {"about the least but for a rounding", {1, 2, 2.5}, {1, 1e-13, 1e-13}, 40},
      {"nearly about the greatest", {1, 2, 2.5}, {1e-9, 1e-9, 1}, 40},
      {"nearly about the middle", {1, 2, 2.5}, nearly_middle, 170},
      {"nearly on the separatrix", {1, 2, 2.5}, {1, 1e-9, std::sqrt(0.8) * (1 + 1e-5)}, 100}};
  expectExact(flights);
}

/// On both sides of the borders at which the variations in closed form lose digits, and series take over.
TEST(FreeRotation, WhereTheClosedFormEnds) {
  std::vector<NamedFlight> flights;
  for (const double share : {0.01, 0.02, 0.03, 0.04, 0.06, 0.1}) {
    const std::string by = " by " + std::to_string(share);
    flights.push_back({"moments apart" + by, {1, 1 + share, 1.7}, Vec3(2, -1, 2) / 3, 7});
    flights.push_back({"off the least axis" + by, {1, 2, 2.5}, {1, share, share}, 7});
    flights.push_back({"off the separatrix" + by, {1, 2, 2.5}, {1, 0.3, std::sqrt(0.8) * (1 + share)}, 7});
  }
  for (const double turn : {0.01, 0.29, 0.31, 0.5, 1.5})
    flights.push_back({"turn " + std::to_string(turn), {1, 2, 2.5}, {1, 0.7, -0.4}, turn / 1.9});
  expectExact(flights);
}

}  // namespace
}  // namespace carom::reference
