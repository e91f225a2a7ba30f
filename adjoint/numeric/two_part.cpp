// SPDX-License-Identifier: MIT
#include "adjoint/numeric/two_part.hpp"

#include <array>
#include <cmath>

namespace carom::adjoint_detail {
namespace {

using Parts = std::array<TwoPart, 3>;

Parts differences(const Vec3& a, const Vec3& o) {
  return {TwoPart::difference(a[0], o[0]), TwoPart::difference(a[1], o[1]), TwoPart::difference(a[2], o[2])};
}

Parts cross(const Parts& u, const Parts& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

}  // namespace

TwoPart TwoPart::difference(double a, double b) {
  const double high = a - b, back = a - high;
  return {high, (a - (high + back)) + (back - b)};
}

TwoPart TwoPart::product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

TwoPart TwoPart::operator+(const TwoPart& other) const {
  const TwoPart sum = difference(high, -other.high);
  const double rest = sum.low + (low + other.low), total = sum.high + rest;
  return {total, rest - (total - sum.high)};
}

TwoPart TwoPart::operator*(const TwoPart& other) const {
  const TwoPart main = product(high, other.high);
  return main + TwoPart{high * other.low + low * other.high, 0};
}

Vec3 crossProduct(const Vec3& o, const Vec3& a, const Vec3& b) {
  const Parts w = cross(differences(a, o), differences(b, o));
  return {w[0].value(), w[1].value(), w[2].value()};
}

double tripleProduct(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Parts u = differences(a, o), w = cross(differences(b, o), differences(c, o));
  return (u[0] * w[0] + u[1] * w[1] + u[2] * w[2]).value();
}

}  // namespace carom::adjoint_detail
