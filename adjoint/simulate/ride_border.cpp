// SPDX-License-Identifier: MIT
#include "adjoint/simulate/ride_border.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// A turn that brings a place nearer to a border by less than this share of its radius does not reach it.
constexpr double kStaysInside = 1e-14;

// When room + rate t is 0 and falls.
double fallsStraight(double room, double rate) { return rate < 0 ? std::max(0.0, -room / rate) : kNever; }

// When middle + cosine cos(a) + sine sin(a), a = speed t from 0 on, is 0 and falls.
double fallsRound(double middle, double cosine, double sine, double speed) {
  const double size = std::sqrt(cosine * cosine + sine * sine);
  if (!(size > 0) || !(middle - size < -kStaysInside * (std::abs(middle) + size))) return kNever;
  if (!(middle + cosine > 0)) return sine < 0 ? 0 : kNever;
  // size cos(a - from) falls to -middle
  const double from = elementary::atan2(sine, cosine), width = elementary::atan2(std::sqrt(std::max(0.0, (size - middle) * (size + middle))), -middle);
  double angle = from + width;
  if (angle < 0) angle += 2 * std::numbers::pi;
  return angle / speed;
}

}  // namespace

double timeAtBorder(const Carrier& carrier, const Carrier::Part& part, const FeatureLimit& limit, const Vec3& place) {
  const Mat3& R = part.support.pose.R;
  const Vec3 u = part.surfaceVelocity(), w = part.surfaceSpin();
  const bool straight = w.isZero(0);
  const double speed = w.norm();
  // it turns about a centre, from there by `arm`
  const Vec3 center = straight ? place : Vec3(part.origin() + w.cross(u) / (speed * speed));
  const Vec3 arm = place - center, across = straight ? u : Vec3(w.cross(arm) / speed);
  double after = kNever;
  if (limit.radius > 0) {  // of a circle: half of what the square of the distance from its centre lacks
    const Vec3 axis = R * limit.axis, middle = part.support.pose.x + R * (limit.border + limit.radius * limit.point_weight);
    const auto level = [&](const Vec3& d) { return Vec3(d - axis * axis.dot(d)); };
    const Vec3 to = level(center - middle), a = level(arm), b = level(across);
    if (!straight) {
      after = fallsRound(0.5 * (limit.radius * limit.radius - to.squaredNorm() - a.squaredNorm()), -to.dot(a), -to.dot(b), speed);
    } else if (const double v2 = b.squaredNorm(); v2 > 0) {
      const double along = to.dot(b), room = limit.radius * limit.radius - to.squaredNorm();
      const double root = std::sqrt(std::max(0.0, along * along + v2 * room));
      after = std::max(0.0, along > 0 ? room / (along + root) : (root - along) / v2);
    }
  } else {
    const Vec3 weight = R * limit.point_weight;
    const double room = weight.dot(center - part.support.pose.x - R * limit.border);
    after = straight ? fallsStraight(room, weight.dot(u)) : fallsRound(room, weight.dot(arm), weight.dot(across), speed);
  }
  return carrier.start + after;
}

}  // namespace carom::adjoint_detail
