// SPDX-License-Identifier: MIT
#include "tests/support/brute/flight.h"

#include <cmath>

#include "tests/support/exact/shape_numbers.h"

namespace carom::brute {
namespace {

constexpr int kDegree = 14;
using Square = Eigen::Matrix<Real, kDegree + 1, kDegree + 1>;

Real pi() { return std::acos(Real(-1)); }

// Nodes x_k = -cos(pi k/N) on [-1, 1] and the matrix that integrates the polynomial through values at the nodes from -1
// to each of them.
struct Chebyshev {
  Eigen::Matrix<Real, kDegree + 1, 1> x;
  Square integrate;

  Chebyshev() {
    constexpr int N = kDegree;
    Square coefficients, integrals;  // values -> a_m of sum a_m T_m; a_m -> integral of T_m from -1 to x_k
    const auto T = [](int m, int k) { return std::cos(pi() * (m % (2 * N)) * (N - k) / N); };
    for (int k = 0; k <= N; ++k) {
      x[k] = T(1, k);
      for (int m = 0; m <= N; ++m) {
        const int ends = (m == 0 || m == N ? 2 : 1) * (k == 0 || k == N ? 2 : 1);
        coefficients(m, k) = Real(2) / (N * ends) * T(m, k);
      }
    }
    const auto primitive = [&](int m, int k) -> Real {
      if (m == 0) return T(1, k);
      if (m == 1) return T(2, k) / 4;
      return T(m + 1, k) / (2 * (m + 1)) - T(m - 1, k) / (2 * (m - 1));
    };
    for (int k = 0; k <= N; ++k)
      for (int m = 0; m <= N; ++m) integrals(k, m) = primitive(m, k) - primitive(m, 0);
    integrate = integrals * coefficients;
  }
};

const Chebyshev& chebyshev() {
  static const Chebyshev table;
  return table;
}

Rotation toRotation(const Eigen::Matrix<Real, 1, 4>& row) {
  return Rotation(row[0], row[1], row[2], row[3]).normalized();
}

}  // namespace

MassProperties massOf(const Body& body) {
  MassProperties m;
  m.moving = !body.fixed;
  if (body.fixed) return m;
  const auto solid = exact::integralsOf(exact::numbersOf<Real>(body.shape));
  m.mass = body.mass ? Real(*body.mass) : Real(*body.density) * solid.volume;
  m.inverse_mass = 1 / m.mass;
  m.center = body.center_of_mass ? widen(*body.center_of_mass) : widen(solid.center());
  if (body.inertia.source == Inertia::Source::derived) {
    const auto found = exact::principal<Real>(m.mass * solid.unitInertia(), 1e-19L);
    m.inertia = widen(found.moments);
    for (int i = 0; i < 3; ++i) m.axes.col(i) = widen(found.axes.column[i]);
  } else {
    m.inertia = widen(body.inertia.moments);
    m.axes = body.inertia.axes.cast<Real>().normalized().toRotationMatrix();
  }
  m.inverse_inertia = m.inertia.cwiseInverse();
  const bool round = m.inertia[0] == m.inertia[1] && m.inertia[1] == m.inertia[2] && m.center.isZero(0);
  m.ball = round && std::holds_alternative<Sphere>(body.shape);
  return m;
}

Flight::Flight(const MassProperties& mass, const Vector& gravity, Real start, const Vector& x, const Rotation& q,
               const Vector& v, const Vector& L)
    : mass_(mass), gravity_(gravity), x_(x), v_(v), L_(L), q_(q.normalized()), start_(start) {
  if (mass.ball) return;
  // Energy is constant, so I_min |omega|^2 <= L . omega; and |d omega_i/dt| = |I_j - I_k|/I_i |omega_j omega_k|.
  const Vector& I = mass.inertia;
  spin_bound_ = std::sqrt(L.dot(spin(q_.toRotationMatrix())) / I.minCoeff());
  Real factor = 0;
  for (int i = 0; i < 3; ++i) factor = std::max(factor, std::abs(I[(i + 1) % 3] - I[(i + 2) % 3]) / I[i]);
  spin_rate_bound_ = factor * spin_bound_ * spin_bound_;
  length_ = spin_bound_ > 0 ? std::min(Real(10), Real(0.7L) / spin_bound_) : Real(10);
}

Flight Flight::fixedAt(const Vector& x, const Rotation& q) {
  Flight flight;
  flight.mass_.ball = true;  // its rotation never changes
  flight.x_ = x;
  flight.q_ = q.normalized();
  return flight;
}

Flight::Stretch Flight::solve(const Eigen::Matrix<Real, 1, 4>& from) const {
  static_assert(kNodes == kDegree + 1);
  Stretch q = from.replicate<kNodes, 1>(), rate;
  for (int round = 0; round < 60; ++round) {
    for (int k = 0; k < kNodes; ++k) {
      const Rotation r(q(k, 0), q(k, 1), q(k, 2), q(k, 3));
      const Vector w = spin(r.normalized().toRotationMatrix());
      const Rotation d = Rotation(0, w[0] / 2, w[1] / 2, w[2] / 2) * r;
      rate.row(k) << d.w(), d.x(), d.y(), d.z();
    }
    const Stretch next = from.replicate<kNodes, 1>() + length_ / 2 * (chebyshev().integrate * rate);
    const Real change = (next - q).cwiseAbs().maxCoeff();
    q = next;
    if (change < 1e-18L) break;
  }
  return q;
}

Rotation Flight::rotationAt(Real t) {
  if (mass_.ball || spin_bound_ == 0) return q_;
  const Vector& I = mass_.inertia;
  if (I[0] == I[1] && I[1] == I[2])  // constant spin
    return Rotation(Eigen::AngleAxis<Real>(L_.norm() / I[0] * (t - start_), L_.normalized())) * q_;
  const Real elapsed = std::max(t - start_, Real(0));
  const auto index = static_cast<std::size_t>(elapsed / length_);
  while (stretches_.size() <= index) {
    Eigen::Matrix<Real, 1, 4> from;
    if (stretches_.empty())
      from << q_.w(), q_.x(), q_.y(), q_.z();
    else
      from = stretches_.back().row(kNodes - 1).normalized();
    stretches_.push_back(solve(from));
  }
  const Real at = 2 * (elapsed - static_cast<Real>(index) * length_) / length_ - 1;
  Eigen::Matrix<Real, 1, 4> sum = Eigen::Matrix<Real, 1, 4>::Zero();  // barycentric interpolation
  Real weights = 0;
  for (int k = 0; k < kNodes; ++k) {
    const Real apart = at - chebyshev().x[k];
    if (apart == 0) return toRotation(stretches_[index].row(k));
    const Real weight = (k % 2 ? -1 : 1) * (k == 0 || k == kDegree ? Real(0.5L) : Real(1)) / apart;
    sum += weight * stretches_[index].row(k);
    weights += weight;
  }
  return toRotation(sum / weights);
}

Kinematic Flight::at(Real t) {
  Kinematic k;
  k.x = positionAt(t);
  k.v = velocityAt(t);
  k.R = rotationAt(t).toRotationMatrix();
  if (mass_.moving) k.w = mass_.ball ? Vector(mass_.inverse_inertia[0] * L_) : spin(k.R);
  return k;
}

}  // namespace carom::brute
