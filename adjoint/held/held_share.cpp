// SPDX-License-Identifier: MIT
#include "adjoint/held/held_share.hpp"

#include <algorithm>
#include <cmath>

namespace carom::adjoint_detail {
namespace {

// No push is looked for beyond so many times the forces: two contacts between which a body is wedged bear any.
constexpr double kMostPush = 1e6;
constexpr double kSamePush = 1e-16;
// Rooms that differ by a smaller share of the forces are the same.
constexpr double kSameRoom = 1e-12;

}  // namespace

double ShareSide::room(double push) const {
  const Vec3 f = force + push * along;
  const double pressing = n.dot(f);
  return friction * pressing - (f - pressing * n).norm();
}

double ShareSide::slope(double push) const {
  const Vec3 f = force + push * along, f_t = f - n.dot(f) * n, by = along - n.dot(along) * n;
  const double length = f_t.norm();
  return friction * n.dot(along) - (length > 0 ? f_t.dot(by) / length : 0);
}

// The smaller of two concave functions is concave: its maximum is where its slope changes sign.
HeldShare bestShare(const ShareSide& a, const ShareSide& b) {
  const double size = std::max(a.force.norm(), b.force.norm());
  HeldShare share;
  const auto slopeAt = [&](double push) { return a.room(push) < b.room(push) ? a.slope(push) : b.slope(push); };
  double low = -kMostPush * size, high = kMostPush * size;
  while (high - low > kSamePush * size) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    (slopeAt(middle) > 0 ? low : high) = middle;
  }
  share.push = low;
  share.room = {a.room(low), b.room(low)};
  const double slope_a = a.slope(low), slope_b = b.slope(low), turn = slope_a - slope_b;
  if (std::abs(share.room[0] - share.room[1]) <= kSameRoom * size && slope_a * slope_b < 0) {
    share.weight = {-slope_b / turn, slope_a / turn};
  } else {
    share.weight = share.room[0] < share.room[1] ? std::array<double, 2>{1, 0} : std::array<double, 2>{0, 1};
  }
  return share;
}

}  // namespace carom::adjoint_detail
