// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/multiprecision/mpfr.hpp>

#include "adjoint/base/types.h"

namespace carom::reference {

/// 50 decimal digits (168 bits), rounded to nearest. Expression templates are off: `auto` and ?: mean what they seem to
/// mean.
using Real =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

/// sum += a b, each rounded; `product` is scratch. The operators copy their numbers, which costs as much again.
inline void addProduct(Real& sum, Real& product, const Real& a, const Real& b) {
  mpfr_mul(product.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN);
  mpfr_add(sum.backend().data(), sum.backend().data(), product.backend().data(), MPFR_RNDN);
}

/// A vector of three numbers.
struct RVec {
  std::array<Real, 3> at{};

  RVec() = default;
  RVec(const Real& x, const Real& y, const Real& z) : at{x, y, z} {}
  explicit RVec(const Vec3& v) : at{Real(v.x()), Real(v.y()), Real(v.z())} {}
  Real& operator[](int i) { return at[i]; }
  const Real& operator[](int i) const { return at[i]; }
  Vec3 rounded() const { return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])}; }
};

inline RVec operator+(const RVec& a, const RVec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline RVec operator-(const RVec& a, const RVec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline RVec operator-(const RVec& a) { return {-a[0], -a[1], -a[2]}; }
inline RVec operator*(const Real& s, const RVec& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Real dot(const RVec& a, const RVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline RVec cross(const RVec& a, const RVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline RVec times(const RVec& a, const RVec& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
inline Real norm(const RVec& a) { return sqrt(dot(a, a)); }
inline RVec unit(const RVec& a) { return (1 / norm(a)) * a; }
inline RVec axisVector(int k, const Real& length = 1) {
  RVec e;
  e[k] = length;
  return e;
}

/// A 3x3 matrix, kept as columns.
struct RMat {
  std::array<RVec, 3> column{};

  static RMat identity() { return {{axisVector(0), axisVector(1), axisVector(2)}}; }
};

inline RVec operator*(const RMat& m, const RVec& v) {
  return v[0] * m.column[0] + v[1] * m.column[1] + v[2] * m.column[2];
}
inline RMat operator*(const RMat& a, const RMat& b) { return {{a * b.column[0], a * b.column[1], a * b.column[2]}}; }
inline RMat operator+(const RMat& a, const RMat& b) {
  return {{a.column[0] + b.column[0], a.column[1] + b.column[1], a.column[2] + b.column[2]}};
}
/// a^T v
inline RVec transposeTimes(const RMat& a, const RVec& v) {
  return {dot(a.column[0], v), dot(a.column[1], v), dot(a.column[2], v)};
}
inline RMat transpose(const RMat& a) {
  RMat t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.column[i][j] = a.column[j][i];
  }
  return t;
}
/// The solution x of a x = b, by Cramer's rule.
inline RVec solve(const RMat& a, const RVec& b) {
  const RVec c12 = cross(a.column[1], a.column[2]);
  const Real determinant = dot(a.column[0], c12);
  return (1 / determinant) *
         RVec{dot(b, c12), dot(a.column[0], cross(b, a.column[2])), dot(a.column[0], cross(a.column[1], b))};
}

/// Rotation by `angle` about a unit axis (Rodrigues' formula).
inline RMat rotationAbout(const RVec& axis, const Real& angle) {
  const Real c = cos(angle), s = sin(angle);
  RMat m;
  for (int j = 0; j < 3; ++j) {
    const RVec e = axisVector(j);
    m.column[j] = c * e + s * cross(axis, e) + ((1 - c) * axis[j]) * axis;
  }
  return m;
}

/// exp([r]x).
inline RMat rotationBy(const RVec& r) {
  const Real angle = norm(r);
  return angle == 0 ? RMat::identity() : rotationAbout((1 / angle) * r, angle);
}

/// The rotation that takes unit vector `from` to unit vector `to` on the shortest way; `to` must not be -from.
inline RMat swing(const RVec& from, const RVec& to) {
  const RVec w = cross(from, to);
  const Real c = dot(from, to), f = 1 / (1 + c);
  RMat m;
  for (int j = 0; j < 3; ++j) {
    const RVec e = axisVector(j);
    m.column[j] = c * e + cross(w, e) + (f * w[j]) * w;
  }
  return m;
}

/// Rotation matrix of a quaternion, which is normalised first.
inline RMat rotationOf(const Quat& q) {
  const Real w = q.w();
  const RVec v{Real(q.x()), Real(q.y()), Real(q.z())};
  const Real f = 2 / (w * w + dot(v, v));
  RMat m;
  for (int j = 0; j < 3; ++j) {
    const RVec e = axisVector(j), t = cross(v, e);
    m.column[j] = e + (f * w) * t + f * cross(v, t);
  }
  return m;
}

inline Mat3 rounded(const RMat& a) {
  Mat3 m;
  for (int j = 0; j < 3; ++j) m.col(j) = a.column[j].rounded();
  return m;
}

}  // namespace carom::reference
