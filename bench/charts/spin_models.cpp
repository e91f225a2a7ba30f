// SPDX-License-Identifier: MIT
#include "bench/charts/spin_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "adjoint/flight/flight_elliptic.hpp"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/flight/flight_triaxial.hpp"
#include "bench/charts/flight_models.h"

namespace carom::charts {

using namespace adjoint_detail;

namespace {

using Vec7 = Eigen::Matrix<double, 7, 1>;  // q as (x, y, z, w), then M

Vec7 eulerRate(const Vec3& D, const Vec7& y) {
  const Quat q(Eigen::Vector4d(y.head<4>()));
  const Vec3 M = y.tail<3>(), w = D.cwiseProduct(M);
  Vec7 rate;
  rate.head<4>() = 0.5 * (q * Quat(0, w.x(), w.y(), w.z())).coeffs();
  rate.tail<3>() = M.cross(w);
  return rate;
}

Vec7 pack(const Spin& s) {
  Vec7 y;
  y << s.q.coeffs(), s.bodyMomentum();
  return y;
}

Spin unpack(const Spin& like, const Vec7& y) {
  Spin s = like;
  s.q = Quat(Eigen::Vector4d(y.head<4>())).normalized();
  s.L = s.q * Vec3(y.tail<3>());
  return s;
}

Spin eulerRungeKutta4(const Spin& start, double t, double step, int readings) {
  const Vec3 D = start.inertia.cwiseInverse();
  Vec7 y = pack(start);
  const double count = readings * std::max(1.0, std::ceil(t / readings / step - 1e-9)), h = t / count;
  for (double i = 0; i < count; ++i) {
    const Vec7 a = eulerRate(D, y), b = eulerRate(D, y + 0.5 * h * a), c = eulerRate(D, y + 0.5 * h * b),
               d = eulerRate(D, y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
    y.head<4>().normalize();
  }
  return unpack(start, y);
}

struct DormandPrince54 {
  static constexpr std::size_t kStages = 7;
  static constexpr double a[kStages][kStages - 1] = {
      {},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  // of order 5 (the last row of a) less that of order 4
  static constexpr double error[kStages] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                            -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
};

Spin dormandPrince54(const Spin& start, double t, double tolerance, int readings) {
  using Pair = DormandPrince54;
  const Vec3 D = start.inertia.cwiseInverse();
  Vec7 y = pack(start);
  const double momentum = start.L.norm();
  double h = std::min(t / readings, 0.1 / (D.maxCoeff() * momentum)), done = 0;
  std::array<Vec7, Pair::kStages> k;
  k[0] = eulerRate(D, y);
  for (int reading = 1; reading <= readings; ++reading) {
    const double goal = t * reading / readings;
    while (done < goal) {
      const double taken = std::min(h, goal - done);
      Vec7 next = y, error = taken * Pair::error[0] * k[0];
      for (std::size_t i = 1; i < Pair::kStages; ++i) {
        next = y;
        for (std::size_t j = 0; j < i; ++j) next += taken * Pair::a[i][j] * k[j];
        k[i] = eulerRate(D, next);
        error += taken * Pair::error[i] * k[i];
      }
      // as an angle: twice the quaternion's, and the part of the momentum
      const double size = std::max(2 * error.head<4>().norm(), error.tail<3>().norm() / momentum);
      const bool smallest = taken < 1e-12 * t;
      if (size <= tolerance || smallest) {
        done = taken < h ? goal : done + taken;
        y = next;
        y.head<4>().normalize();
        k[0] = k[6];  // first same as last
      }
      const double factor = std::clamp(0.9 * std::pow(tolerance / std::max(size, 1e-300), 0.2), 0.2, 4.0);
      if (size > tolerance || taken == h) h = taken * factor;
    }
  }
  return unpack(start, y);
}

Spin byArc(const Spin& start, Tier tier, double t, int readings) {
  BodyModel model;
  model.moving = true;
  model.mass = model.inverse_mass = 1;
  model.inertia = start.inertia, model.inverse_inertia = start.inertia.cwiseInverse();
  State state;
  state.q = start.q, state.L = start.L;
  Arc arc(model, tier, Vec3::Zero(), 0, state);
  for (int i = 1; i <= readings; ++i) {
    arc.extendTo(t * i / readings);
    state = arc.stateAt(t * i / readings);
  }
  return {start.inertia, state.q, start.L};
}

Spin byElliptic(const Spin& start, double t, int readings) {
  const std::optional<EllipticRotation> rotation = EllipticRotation::of(start.inertia.cwiseInverse(), start.q, start.L);
  if (!rotation) throw std::logic_error("this top has no closed form");
  Spin end = start;
  for (int i = 1; i <= readings; ++i) end.q = rotation->orientationAt(t * i / readings);
  return end;
}

// By flights of a segment each.
Spin bySeries(const Spin& start, double t, int readings) {
  const Vec3 D = start.inertia.cwiseInverse();
  const double length = 0.9 / (start.L.norm() * D.maxCoeff());
  double begun = 0;
  Spin end = start;
  TriaxialRotation part;
  part.begin(D, start.q, start.L);
  for (int i = 1; i <= readings; ++i) {
    const double time = t * i / readings;
    for (; time - begun > length; begun += length) {
      part.extendTo(length);
      part.begin(D, part.orientationAt(length), start.L);
    }
    part.extendTo(time - begun);
    end.q = part.orientationAt(time - begun);
  }
  return end;
}

Spin byFlightModel(const FlightModel& model, const Spin& start, double t, double step, int readings) {
  Spin s = start;
  for (int i = 0; i < readings; ++i)
    s.q = model.rotate(s.inertia.cwiseInverse(), s.q, s.L, t * (i + 1) / readings - t * i / readings, step);
  return s;
}

}  // namespace

Tier Spin::tier() const {
  const int axis = symmetryAxis(inertia);
  return axis == -1 ? Tier::spherical : axis < 3 ? Tier::symmetric : Tier::triaxial;
}

std::vector<SpinModel> spinModels(const Spin& spin) {
  using Steps = SpinModel::Steps;
  std::vector<SpinModel> models;
  const Tier own = spin.tier();
  models.push_back(
      {"carom", Steps::none, [own](const Spin& s, double t, double, int n) { return byArc(s, own, t, n); }});
  if (own == Tier::triaxial) {
    models.push_back({"elliptic functions", Steps::none,
                      [](const Spin& s, double t, double, int n) { return byElliptic(s, t, n); }});
    models.push_back(
        {"Taylor series", Steps::none, [](const Spin& s, double t, double, int n) { return bySeries(s, t, n); }});
  } else {
    models.push_back({"triaxial tier", Steps::none,
                      [](const Spin& s, double t, double, int n) { return byArc(s, Tier::triaxial, t, n); }});
  }
  for (const FlightModel& model : flightModels())
    models.push_back({model.name, model.adaptive ? Steps::adaptive : Steps::fixed,
                      [&model](const Spin& s, double t, double h, int n) { return byFlightModel(model, s, t, h, n); }});
  models.push_back({"Euler RK4", Steps::fixed, eulerRungeKutta4});
  models.push_back({"Dormand-Prince 5(4)", Steps::adaptive, dormandPrince54});
  return models;
}

}  // namespace carom::charts
