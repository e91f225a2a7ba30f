// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "adjoint/base/types.h"

namespace carom::exact {

/// Vectors and matrices of three, in any arithmetic: long double and 50 decimal digits are in use. The geometry written
/// with them is that of the tests alone; nothing of the program under test takes part.
template <class T>
struct Vec {
  std::array<T, 3> at{};

  Vec() = default;
  Vec(const T& x, const T& y, const T& z) : at{x, y, z} {}
  explicit Vec(const Vec3& v) : at{T(v.x()), T(v.y()), T(v.z())} {}
  T& operator[](int i) { return at[i]; }
  const T& operator[](int i) const { return at[i]; }
  Vec3 rounded() const { return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])}; }
};

/// A number of the arithmetic T, for parameters that shall not take part in deducing it.
template <class T>
using Number = std::type_identity_t<T>;

template <class T>
Vec<T> operator+(const Vec<T>& a, const Vec<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Vec<T> operator-(const Vec<T>& a, const Vec<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Vec<T> operator-(const Vec<T>& a) {
  return {-a[0], -a[1], -a[2]};
}
template <class T>
Vec<T> operator*(const Number<T>& s, const Vec<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T>
T dot(const Vec<T>& a, const Vec<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
Vec<T> times(const Vec<T>& a, const Vec<T>& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
template <class T>
T norm(const Vec<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
Vec<T> unit(const Vec<T>& a) {
  return (1 / norm(a)) * a;
}
/// The part of v that is at right angles to the unit vector n.
template <class T>
Vec<T> across(const Vec<T>& v, const Vec<T>& n) {
  return v - dot(v, n) * n;
}
template <class T>
Vec<T> unitVector(int k, const Number<T>& length = 1) {
  Vec<T> e;
  e[k] = length;
  return e;
}

/// A 3x3 matrix, kept as columns.
template <class T>
struct Mat {
  std::array<Vec<T>, 3> column{};

  static Mat identity() { return {{unitVector<T>(0), unitVector<T>(1), unitVector<T>(2)}}; }
};

template <class T>
Vec<T> operator*(const Mat<T>& m, const Vec<T>& v) {
  return v[0] * m.column[0] + v[1] * m.column[1] + v[2] * m.column[2];
}
template <class T>
Mat<T> operator*(const Mat<T>& a, const Mat<T>& b) {
  return {{a * b.column[0], a * b.column[1], a * b.column[2]}};
}
template <class T>
Mat<T> operator*(const Number<T>& s, const Mat<T>& a) {
  return {{s * a.column[0], s * a.column[1], s * a.column[2]}};
}
template <class T>
Mat<T> operator+(const Mat<T>& a, const Mat<T>& b) {
  return {{a.column[0] + b.column[0], a.column[1] + b.column[1], a.column[2] + b.column[2]}};
}
template <class T>
Mat<T> operator-(const Mat<T>& a, const Mat<T>& b) {
  return {{a.column[0] - b.column[0], a.column[1] - b.column[1], a.column[2] - b.column[2]}};
}
/// a^T v
template <class T>
Vec<T> transposeTimes(const Mat<T>& a, const Vec<T>& v) {
  return {dot(a.column[0], v), dot(a.column[1], v), dot(a.column[2], v)};
}
template <class T>
Mat<T> transpose(const Mat<T>& a) {
  Mat<T> t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.column[i][j] = a.column[j][i];
  }
  return t;
}
template <class T>
Mat<T> outer(const Vec<T>& a, const Vec<T>& b) {
  return {{b[0] * a, b[1] * a, b[2] * a}};
}
template <class T>
T trace(const Mat<T>& a) {
  return a.column[0][0] + a.column[1][1] + a.column[2][2];
}
/// The solution x of a x = b, by Cramer's rule.
template <class T>
Vec<T> solve(const Mat<T>& a, const Vec<T>& b) {
  const Vec<T> c12 = cross(a.column[1], a.column[2]);
  const T determinant = dot(a.column[0], c12);
  return (1 / determinant) *
         Vec<T>{dot(b, c12), dot(a.column[0], cross(b, a.column[2])), dot(a.column[0], cross(a.column[1], b))};
}
template <class T>
Mat3 rounded(const Mat<T>& a) {
  Mat3 m;
  for (int j = 0; j < 3; ++j) m.col(j) = a.column[j].rounded();
  return m;
}

/// Rotation by `angle` about a unit axis (Rodrigues' formula).
template <class T>
Mat<T> rotationAbout(const Vec<T>& axis, const Number<T>& angle) {
  using std::cos, std::sin;
  const T c = cos(angle), s = sin(angle);
  Mat<T> m;
  for (int j = 0; j < 3; ++j) {
    const Vec<T> e = unitVector<T>(j);
    m.column[j] = c * e + s * cross(axis, e) + ((1 - c) * axis[j]) * axis;
  }
  return m;
}

/// exp([r]x).
template <class T>
Mat<T> rotationBy(const Vec<T>& r) {
  const T angle = norm(r);
  return angle == 0 ? Mat<T>::identity() : rotationAbout((1 / angle) * r, angle);
}

/// The rotation that takes unit vector `from` to unit vector `to` on the shortest way; `to` must not be -from.
template <class T>
Mat<T> swing(const Vec<T>& from, const Vec<T>& to) {
  const Vec<T> w = cross(from, to);
  const T c = dot(from, to), f = 1 / (1 + c);
  Mat<T> m;
  for (int j = 0; j < 3; ++j) {
    const Vec<T> e = unitVector<T>(j);
    m.column[j] = c * e + cross(w, e) + (f * w[j]) * w;
  }
  return m;
}

/// Rotation matrix of a quaternion, which is normalised first.
template <class T>
Mat<T> rotationOf(const Quat& q) {
  const T w = q.w();
  const Vec<T> v{T(q.x()), T(q.y()), T(q.z())};
  const T f = 2 / (w * w + dot(v, v));
  Mat<T> m;
  for (int j = 0; j < 3; ++j) {
    const Vec<T> e = unitVector<T>(j), t = cross(v, e);
    m.column[j] = e + (f * w) * t + f * cross(v, t);
  }
  return m;
}

/// Principal moments and axes (columns, right-handed) of a symmetric matrix, by Jacobi's rotations. A diagonal matrix
/// keeps its order.
template <class T>
struct Principal {
  Vec<T> moments;
  Mat<T> axes;
};
template <class T>
Principal<T> principal(Mat<T> a, const Number<T>& epsilon) {
  using std::abs, std::sqrt;
  Mat<T> axes = Mat<T>::identity();
  for (int sweep = 0; sweep < 60; ++sweep) {
    bool changed = false;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        const T off = a.column[q][p];
        if (!(abs(off) > epsilon * (abs(a.column[p][p]) + abs(a.column[q][q])))) continue;
        changed = true;
        const T theta = (a.column[q][q] - a.column[p][p]) / (2 * off);
        const T t = (theta < 0 ? T(-1) : T(1)) / (abs(theta) + sqrt(theta * theta + 1));
        const T c = 1 / sqrt(t * t + 1), s = t * c;
        Mat<T> turn = Mat<T>::identity();
        turn.column[p][p] = turn.column[q][q] = c;
        turn.column[q][p] = s, turn.column[p][q] = -s;
        a = transpose(turn) * (a * turn);
        axes = axes * turn;
      }
    }
    if (!changed) break;
  }
  return {{a.column[0][0], a.column[1][1], a.column[2][2]}, axes};
}

}  // namespace carom::exact
