// SPDX-License-Identifier: MIT
#include "adjoint/flight/flight_triaxial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// Truncated to ten binary digits, so that a sum of steps is exact.
double shortBinary(double h) {
  int exponent = 0;
  const double mantissa = std::frexp(h, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, 10)), exponent - 10);
}

using SeriesLanes = std::array<double, 4>;

// Logarithm of the radius of convergence seen from the last two coefficients of u and psi, which are of size 1.
double logRadius(const std::array<SeriesLanes, TriaxialRotation::kOrder + 1>& c) {
  const auto from = [&](std::size_t k) {
    const double size = c[k][0] * c[k][0] + c[k][1] * c[k][1] + c[k][2] * c[k][2] + c[k][3] * c[k][3];
    if (size > 1e-290 && size < 1e300) return -0.5 * elementary::log(size) / static_cast<double>(k);
    double largest = 0;  // of a spin below 1e-7 or above 5e7 rad/s, whose squares leave the range of doubles
    for (double x : c[k]) largest = std::max(largest, std::abs(x));
    return largest > 0 ? -elementary::log(largest) / static_cast<double>(k) : 50.0;
  };
  return std::min(from(TriaxialRotation::kOrder), from(TriaxialRotation::kOrder - 1));
}

}  // namespace

void TriaxialRotation::begin(const Vec3& inverse_inertia, const Quat& q, const Vec3& L) {
  D_ = inverse_inertia;
  L_ = L;
  q_ = q;
  segments_.clear();
  closed_form_.reset();
  const double middle = D_.sum() - D_.maxCoeff() - D_.minCoeff();
  shifted_D_ = D_.array() - middle;
  const Vec3 u = (q.toRotationMatrix().transpose() * L).normalized();
  energy_ = u.dot(shifted_D_.cwiseProduct(u));
}

// Moves u, the direction of L in the body, by rounding-sized steps to the energy of the start, and turns q so that R u
// stays the direction of L; returns u. Energy is counted from that of the middle axis, so that it has all its digits
// where two moments are nearly equal.
Vec3 TriaxialRotation::restoreEnergy(Quat& q) const {
  const Vec3 u = (q.toRotationMatrix().transpose() * L_).normalized();
  const Vec3 Du = shifted_D_.cwiseProduct(u);
  const double a = u.dot(Du);
  const Vec3 slope = Du - a * u;
  // near a principal axis the energy hardly depends on u, and what it seems to be off by is rounding
  if (!(slope.norm() > 5e-4 * shifted_D_.cwiseAbs().maxCoeff())) return u;
  const Vec3 moved = (u - 0.5 * (a - energy_) / slope.squaredNorm() * slope).normalized();
  const Vec3 turn = 0.5 * moved.cross(u);
  q = (q * Quat(1, turn.x(), turn.y(), turn.z())).normalized();
  return moved;
}

// With a = u(0).(D u(0)), which is u.(D u) at all times, psi' = l f and f = ((D u(0)).u + a) / (1 + u(0).u). All sums
// are Cauchy products of a left and a right series, in four lanes that the compiler keeps in vector registers:
//   left (u_2, u_3, u_1, 1 + u(0).u), right (u_3, u_1, u_2, f).
TriaxialRotation::Segment TriaxialRotation::makeSegment(double start, const Quat& q) const {
  Segment s;
  s.start = start;
  s.q = q;
  const double l = L_.norm();
  if (l == 0) {
    s.length = 1e300;
    s.u_psi.fill({});
    return s;
  }
  const Vec3 u0 = restoreEnergy(s.q);
  const Vec3 Du0 = D_.cwiseProduct(u0);
  const double a = u0.dot(Du0);
  const SeriesLanes rate{l * (D_[2] - D_[1]), l * (D_[0] - D_[2]), l * (D_[1] - D_[0]), l};
  std::array<SeriesLanes, kOrder> left, right;
  s.u_psi[0] = {u0[0], u0[1], u0[2], 0};
  for (std::size_t k = 0; k < kOrder; ++k) {
    const SeriesLanes& u = s.u_psi[k];
    const double first = k == 0 ? 1.0 : 0.0;
    left[k] = {u[1], u[2], u[0], first + u0[0] * u[0] + u0[1] * u[1] + u0[2] * u[2]};
    right[k] = {u[2], u[0], u[1], 0};  // f_k is not known yet
    SeriesLanes sum{};
    for (std::size_t j = 0; j <= k; ++j)
      for (std::size_t i = 0; i < 4; ++i) sum[i] += left[j][i] * right[k - j][i];
    sum[3] = right[k][3] = (first * a + Du0[0] * u[0] + Du0[1] * u[1] + Du0[2] * u[2] - sum[3]) / left[0][3];
    for (std::size_t i = 0; i < 4; ++i) s.u_psi[k + 1][i] = rate[i] * sum[i] / static_cast<double>(k + 1);
  }
  // e^-2 of the radius makes the last term 4e-18 of the whole, and leaves room for the variations, whose terms are
  // larger
  s.length = shortBinary(elementary::exp(logRadius(s.u_psi) - 2));
  return s;
}

Quat TriaxialRotation::orientationIn(const Segment& s, double h) {
  if (h == 0) return s.q;
  SeriesLanes sum = s.u_psi[kOrder];
  for (std::size_t k = kOrder; k-- > 0;)
    for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] * h + s.u_psi[k][i];
  const Vec3 u0(s.u_psi[0][0], s.u_psi[0][1], s.u_psi[0][2]), u(sum[0], sum[1], sum[2]);
  const auto [sine, cosine] = elementary::sincos(0.5 * sum[3]);
  const Vec3 twist = sine * u0, swing = u.cross(u0);  // the inverse swing, from u to u(0)
  return (s.q * (Quat(cosine, twist.x(), twist.y(), twist.z()) *
                 Quat(1 + u0.dot(u), swing.x(), swing.y(), swing.z())))
      .normalized();
}

void TriaxialRotation::extendTo(double elapsed) {
  checkedNumber("TriaxialRotation::extendTo", "the time", elapsed);
  if (closed_form_) return;
  if (segments_.empty()) {
    segments_.reserve(2);  // most flights end within them
    segments_.push_back(makeSegment(0, q_));
  }
  while (endOfSegments() < elapsed) {
    if (segments_.size() == kSegments) closed_form_ = EllipticRotation::of(D_, q_, L_);
    if (closed_form_) return;
    const Segment& last = segments_.back();
    if (segments_.size() >= kMostSegments || !(last.start + last.length > last.start))
      throw NotComputable("its rotation takes more than " + std::to_string(kMostSegments) + " Taylor series");
    segments_.push_back(makeSegment(last.start + last.length, orientationIn(last, last.length)));
  }
}

double TriaxialRotation::availableUntil() const {
  if (closed_form_) return std::numeric_limits<double>::infinity();
  return segments_.empty() ? 0 : endOfSegments();
}

const TriaxialRotation::Segment& TriaxialRotation::segmentAt(double elapsed) const {
  if (segments_.empty() || !(elapsed <= endOfSegments()))
    refuseNumber("TriaxialRotation", "the time", elapsed, "one up to which it was extended");
  auto next = std::upper_bound(segments_.begin(), segments_.end(), elapsed,
                               [](double t, const Segment& s) { return t < s.start; });
  return next == segments_.begin() ? *next : *(next - 1);
}

Quat TriaxialRotation::orientationAt(double elapsed) const {
  if (closed_form_ && elapsed > endOfSegments() && std::isfinite(elapsed)) {
    Quat q = closed_form_->orientationAt(elapsed);
    restoreEnergy(q);
    return q;
  }
  const Segment& s = segmentAt(elapsed);
  return orientationIn(s, elapsed - s.start);
}

}  // namespace carom::adjoint_detail
