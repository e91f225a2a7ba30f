// SPDX-License-Identifier: MIT
#include "editing/strategy/samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"

namespace carom::editing_detail {
namespace {

/// Half widths of boxes and lengths along free directions, as shares of the reach; used in turn.
constexpr double kSampleRadii[] = {0.1 / 3, 0.1, 1.0 / 3, 0.01, 0.5 / 3, 0.2 / 3, 1};
/// Shares of a Gauss-Newton step; used in turn.
constexpr double kShares[] = {1, 0.5, 1.5, 0.75, 0.25, 2};

template <std::size_t N>
double inTurn(const double (&list)[N], int k) {
  return list[static_cast<std::size_t>(k) % N];
}

/// Numbers beyond a bound come to lie just before it: many a bound is a special case, such as friction 0.
Eigen::VectorXd within(Eigen::VectorXd x, const Eigen::VectorXd& centre, const Eigen::VectorXd& lower,
                       const Eigen::VectorXd& upper) {
  constexpr double kBefore = 0.95;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    if (x[j] < lower[j]) x[j] = centre[j] + kBefore * (lower[j] - centre[j]);
    if (x[j] > upper[j]) x[j] = centre[j] + kBefore * (upper[j] - centre[j]);
  }
  return x;
}

/// In the box of half width `half_width` around the centre, as far as the bounds let it; within bounds that leave no
/// more room than that, the box of the bounds.
Eigen::VectorXd inBox(const EvenPoints& points, int k, const Eigen::VectorXd& centre, double half_width,
                      const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::VectorXd from = (centre.array() - half_width).matrix().cwiseMax(lower);
  const Eigen::VectorXd to = (centre.array() + half_width).matrix().cwiseMin(upper);
  return from + points.inCube(k).cwiseProduct(to - from);
}

Eigen::VectorXd alone(int k, const Eigen::VectorXd& centre, double reach) {
  Eigen::VectorXd x = centre;
  const int n = static_cast<int>(x.size()), turn = k / (2 * n);
  x[(k / 2) % n] += (k % 2 ? -1 : 1) * reach * inTurn(kSampleRadii, turn);
  return x;
}

Eigen::VectorXd along(int k, const Surroundings& s, double reach) {
  Eigen::VectorXd x = s.at + inTurn(kShares, k) * s.step;
  const double length = reach * inTurn(kSampleRadii, k / 2) * (k < 2 ? 0 : 1);  // the step itself first
  if (s.free.cols() > 0) x += length * (s.free * EvenPoints(s.free.cols()).onSphere(k));
  return x;
}

}  // namespace

EvenPoints::EvenPoints(Eigen::Index dimensions) : steps_(2 * dimensions), dimensions_(dimensions) {
  double g = 1.5;
  for (int i = 0; i < 60; ++i) g = elementary::pow(1 + g, 1.0 / (static_cast<double>(steps_.size()) + 1));
  for (Eigen::Index j = 0; j < steps_.size(); ++j) steps_[j] = elementary::pow(g, -static_cast<double>(j + 1));
}

Eigen::VectorXd EvenPoints::inCube(int k) const {
  Eigen::VectorXd x(dimensions_);
  for (Eigen::Index j = 0; j < dimensions_; ++j) {
    const double phase = 0.5 + (k + 1) * steps_[j];
    x[j] = phase - std::floor(phase);
  }
  return x;
}

Eigen::VectorXd EvenPoints::onSphere(int k) const {
  Eigen::VectorXd x(dimensions_);
  for (Eigen::Index j = 0; j < dimensions_; ++j) {
    const auto even = [&](Eigen::Index i) {
      const double phase = 0.5 + (k + 1) * steps_[i];
      return phase - std::floor(phase);
    };
    x[j] = std::sqrt(-2 * elementary::log(1 - even(2 * j))) * elementary::cos(2 * std::numbers::pi * even(2 * j + 1));
  }
  const double length = x.norm();
  return length > 0 ? Eigen::VectorXd(x / length) : x;
}

std::vector<Eigen::VectorXd> samples(const Eigen::VectorXd& centre, const std::vector<Surroundings>& around,
                                     const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int first, int count,
                                     double reach) {
  const EvenPoints points(centre.size());
  const int kinds = 2 + 2 * static_cast<int>(around.size());
  std::vector<Eigen::VectorXd> list;
  for (int i = first; i < first + count; ++i) {
    const int kind = i % kinds, k = i / kinds;
    Eigen::VectorXd x;
    if (kind == 0) {
      x = inBox(points, k, centre, reach * inTurn(kSampleRadii, k), lower, upper);
    } else if (kind == 1) {
      x = alone(k, centre, reach);
    } else {
      const auto& from = around[static_cast<std::size_t>(kind - 2) / 2];
      x = along(2 * k + kind % 2, from, reach);
    }
    list.push_back(within(x, centre, lower, upper));
  }
  return list;
}

}  // namespace carom::editing_detail
