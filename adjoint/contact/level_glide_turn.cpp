// SPDX-License-Identifier: MIT
#include "adjoint/contact/level_glide_turn.hpp"

#include <algorithm>
#include <array>

#include "adjoint/contact/turn_series.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr std::size_t kTerms = LevelGlideTurn::kTerms;
using Weights = LevelGlideTurn::Weights;

constexpr std::size_t kMore = 54;  // terms of a series in 1/2
constexpr auto kReciprocals = [] {
  std::array<double, kTerms + kMore + 2> all{};
  for (std::size_t n = 1; n < all.size(); ++n) all[n] = 1.0 / static_cast<double>(n);
  return all;
}();

// x + y log y is the sum over k > 1 of x^k/(k (k - 1)).
constexpr double kSmallShare = 0.05;
constexpr int kSmallTerms = 14;

// Integrals of v^j (x + y log y) over v in [0, 1], x = x0 + h v, y = y0 - h v; h is y0, or half of it at most.
Weights bentMoments(double x0, double y0, double h) {
  Weights weights;
  if (x0 == 0 && h < kSmallShare) {
    for (std::size_t j = 0; j < kTerms; ++j) {
      double sum = 0;
      for (int k = kSmallTerms; k >= 2; --k) sum = sum * h + 1.0 / (k * (k - 1.0) * (static_cast<double>(j) + k + 1));
      weights[j] = sum * h * h;
    }
    return weights;
  }
  // F_n, the integral of v^n (1 - v)/(r - v), comes from F_(n + 1) + 1/((n + 1)(n + 2)) = r F_n, downwards, where its
  // errors shrink; with sums D of them the integral of v^n log(r - v) is (log r - D_(n + 1))/(n + 1).
  const double r = y0 / h;
  std::array<double, kTerms + 1> F;
  if (h == y0) {
    for (std::size_t n = 0; n <= kTerms; ++n) F[n] = kReciprocals[n + 1];
  } else {
    const double inverse = h / y0;  // 1/2 at most
    double next = 0;
    for (std::size_t n = kTerms + kMore; n-- > 0;) {
      next = (next + kReciprocals[n + 1] * kReciprocals[n + 2]) * inverse;
      if (n <= kTerms) F[n] = next;
    }
  }
  const double log_r = elementary::log(r), log_h = elementary::log(h);
  double sum = F[0], logs = log_r - sum;  // of v^0
  for (std::size_t j = 0; j < kTerms; ++j) {
    const double once = kReciprocals[j + 1], twice = kReciprocals[j + 2];
    sum += F[j + 1];
    const double next = (log_r - sum) * twice;
    weights[j] = x0 * once + h * twice + h * (log_h * (r * once - twice) + r * logs - next);
    logs = next;
  }
  return weights;
}

}  // namespace

double bentSlip(double x) {
  if (x < kSmallShare) {
    double sum = 0;
    for (int k = kSmallTerms; k >= 2; --k) sum = sum * x + 1.0 / (k * (k - 1.0));
    return sum * x * x;
  }
  return x < 1 ? x + (1 - x) * elementary::log(1 - x) : 1;
}

double bentSlipIntegral(double x) {
  if (x < kSmallShare) {
    double sum = 0;
    for (int k = kSmallTerms; k >= 2; --k) sum = sum * x + 1.0 / (k * (k - 1.0) * (k + 1.0));
    return sum * x * x * x;
  }
  const double y = 1 - x;
  return 0.5 * x * x - 0.25 * x * (1 + y) - (y > 0 ? 0.5 * y * y * elementary::log(y) : 0);
}

LevelGlideTurn::LevelGlideTurn(const Vec3& a, const Vec3& b, const Vec3& d, double t, double T) {
  const double root = std::sqrt(b.norm());
  const bool planar = carom::isZero(Vec3(a.cross(b)));  // the axis stays
  double now = 0;
  for (bool last = false; !last;) {
    const Vec3 spin = a + b * now;
    double h = 1 / (spin.norm() / 2.2 + root / 1.2);  // 30 terms of either part leave less than 1e-14
    last = !(h < t - now);
    if (!last || t < T) {  // y log y has no series at the end of the slip
      h = std::min(h, 0.5 * (T - now));
      last = !(h < t - now);
    }
    if (last) h = t - now;
    const Weights weights = bentMoments(now / T, (T - now) / T, h / T);
    const Vec3 wh = spin * h, bh2 = b * (h * h);
    add(planar ? planarSegment(wh, bh2, d, weights) : segment(wh, bh2, d, weights), h, now);
    now += h;
  }
}

// Columns of the terms turn at w h and at b h^2.
LevelGlideTurn::Segment LevelGlideTurn::segment(const Vec3& wh, const Vec3& bh2, const Vec3& d, const Weights& weights) {
  Mat3 before = Mat3::Zero(), term = Mat3::Identity();
  Segment s{term, term, 0.5 * term, weights[0] * d};
  int small = 0;
  for (std::size_t j = 0; j < kTurnTerms && small < 2; ++j) {
    Mat3 next;
    for (int c = 0; c < 3; ++c)
      next.col(c) = (wh.cross(term.col(c)) + bh2.cross(before.col(c))) * kReciprocals[j + 1];
    before = term;
    term = next;
    s.turn += term;
    s.K0 += term * kReciprocals[j + 2];
    s.K1 += term * kReciprocals[j + 3];
    s.bent += weights[j + 1] * (term.transpose() * d);
    small = term.squaredNorm() < 1e-36 ? small + 1 : 0;
  }
  return s;
}

// About one axis, which is normal to d: terms of cos and sin of the angle.
LevelGlideTurn::Segment LevelGlideTurn::planarSegment(const Vec3& wh, const Vec3& bh2, const Vec3& d,
                                                      const Weights& weights) {
  const Vec3 axis = bh2.normalized();
  const double first = wh.dot(axis), second = bh2.dot(axis);
  Vec2 before(0, 0), term(1, 0), sum = term, K0 = term, K1 = 0.5 * term, bent = weights[0] * term;
  int small = 0;
  for (std::size_t j = 0; j < kTurnTerms && small < 2; ++j) {
    const Vec2 driven = (first * term + second * before) * kReciprocals[j + 1];
    before = term;
    term = {-driven[1], driven[0]};
    sum += term;
    K0 += term * kReciprocals[j + 2];
    K1 += term * kReciprocals[j + 3];
    bent += weights[j + 1] * term;
    small = term.squaredNorm() < 1e-36 ? small + 1 : 0;
  }
  const Mat3 along = axis * axis.transpose(), across = Mat3::Identity() - along, turning = skew(axis);
  const auto matrix = [&](const Vec2& of, double share) -> Mat3 {
    return share * along + of[0] * across + of[1] * turning;
  };
  return {matrix(sum, 1), matrix(K0, 1), matrix(K1, 0.5), bent[0] * d - bent[1] * axis.cross(d)};
}

void LevelGlideTurn::add(const Segment& s, double h, double now) {
  const Mat3 back = E.transpose() * h;
  M0 += back * s.K0.transpose();
  M1 += back * (s.K1.transpose() * h + s.K0.transpose() * now);
  bend += back * s.bent;
  E = s.turn * E;
}

}  // namespace carom::adjoint_detail
