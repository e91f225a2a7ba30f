// SPDX-License-Identifier: MIT
#include "editing/strategy/samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "adjoint/numeric/elementary.hpp"
#include "editing/solve/dependence.hpp"

namespace carom::editing_detail {
namespace {

/// Half widths of boxes and lengths along free directions, as shares of the reach; used in turn. Of changes that have to be
/// smaller than a known one most are nearly as large.
constexpr double kRadii[] = {0.1 / 3, 0.1, 1.0 / 3, 0.01, 0.5 / 3, 0.2 / 3, 1};
constexpr double kSmallerRadii[] = {0.95, 0.7, 0.85, 0.5, 1, 0.35, 0.6};
/// Shares of a Gauss-Newton step; used in turn.
constexpr double kShares[] = {1, 0.5, 1.5, 0.75, 0.25, 2};
/// Numbers beyond a bound come to lie so far on the way to it.
constexpr double kBefore = 0.95;
/// Points whose numbers differ by less are one.
constexpr double kRoundedTo = 1e-9;
/// All numbers vary in every so many points.
constexpr std::size_t kAllVary = 4;
/// Sines of the angle between a change and the span of the gradients; used in turn.
constexpr double kSines[] = {0, 0.25, 0.5, 0.125, 0.375};

template <std::size_t N>
double inTurn(const double (&list)[N], int k) {
  return list[static_cast<std::size_t>(k) % N];
}

double radius(int k, const SampleReach& reach) {
  return reach.length * (reach.of_known ? inTurn(kSmallerRadii, k) : inTurn(kRadii, k));
}

/// Numbers beyond a bound come to lie just before it: many a bound is a special case, such as friction 0.
Eigen::VectorXd within(Eigen::VectorXd x, const Eigen::VectorXd& centre, const Eigen::VectorXd& lower,
                       const Eigen::VectorXd& upper) {
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

/// Of a box: points of one have a length of sqrt(n / 3) half widths, in the mean of squares.
double halfWidth(int k, Eigen::Index n, const SampleReach& reach) {
  return radius(k, reach) * (reach.of_known ? std::sqrt(3.0 / static_cast<double>(n)) : 1);
}

/// As far as the bounds let it. The list of radii would come again and again, at the same places.
Eigen::VectorXd alone(int k, const EvenPoints& shares, const Eigen::VectorXd& centre, const Eigen::VectorXd& lower,
                      const Eigen::VectorXd& upper, const SampleReach& reach) {
  Eigen::VectorXd x = centre;
  const int n = static_cast<int>(x.size()), turn = k / (2 * n), listed = static_cast<int>(std::size(kRadii));
  const Eigen::Index j = (k / 2) % n;
  const double room = kBefore * (k % 2 ? centre[j] - lower[j] : upper[j] - centre[j]);
  const double share = turn < listed ? radius(turn, {1, reach.of_known}) : shares.inCube(turn)[0];
  x[j] += (k % 2 ? -1 : 1) * share * std::min(reach.length, room);
  return x;
}

Eigen::VectorXd along(int k, const Surroundings& s, const EvenPoints& directions, const SampleReach& reach) {
  Eigen::VectorXd x = s.at + inTurn(kShares, k) * s.step;
  const double length = radius(k / 2, reach) * (k < 2 ? 0 : 1);  // the step itself first
  if (s.free.cols() > 0) x += length * (s.free * directions.onSphere(k));
  return x;
}

/// What the gradients of the rows span at one of the points around.
struct Span {
  std::size_t around;
  Eigen::MatrixXd basis;
  EvenPoints even;  ///< of a dimension more, for lengths
};

/// Where the rows are met by the smallest change, it is a sum of their gradients (z = J^T m). What these span is decided by the
/// first impacts, so that it is much the same in many sequences.
Eigen::VectorXd nearlySpanned(int k, const Span& span, const Eigen::MatrixXd& free, const EvenPoints& aside,
                              const Eigen::VectorXd& centre, const SampleReach& reach) {
  const Eigen::Index r = span.basis.cols();
  const double length = reach.length * elementary::pow(span.even.inCube(k)[0], 1.0 / static_cast<double>(r));
  Eigen::VectorXd direction = span.basis * span.even.onSphere(k).tail(r).normalized();
  if (free.cols() > 0) {
    const double sine = inTurn(kSines, k);
    direction = std::sqrt(1 - sine * sine) * direction + sine * (free * aside.onSphere(k));
  }
  return centre + length * direction;
}

}  // namespace

RoundedPoint::RoundedPoint(const Eigen::VectorXd& numbers) : rounded_(numbers.begin(), numbers.end()) {
  for (double& number : rounded_) number = std::round(number / kRoundedTo);
}

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
                                     const SampleReach& reach) {
  const EvenPoints points(centre.size()), shares(1);
  std::vector<EvenPoints> directions;
  std::vector<Span> spans;
  for (std::size_t j = 0; j < around.size(); ++j) {
    directions.emplace_back(around[j].free.cols());
    if (!reach.of_known) continue;
    Eigen::MatrixXd basis = nullSpace(around[j].free.transpose());
    const Eigen::Index r = basis.cols();
    if (r > 0) spans.push_back({j, std::move(basis), EvenPoints(1 + r)});
  }
  const int before_spans = 2 + 2 * static_cast<int>(around.size());
  const int kinds = before_spans + static_cast<int>(spans.size());
  std::vector<Eigen::VectorXd> list;
  for (int i = first; i < first + count; ++i) {
    const int kind = i % kinds, k = i / kinds;
    Eigen::VectorXd x;
    if (kind == 0) {
      x = inBox(points, k, centre, halfWidth(k, centre.size(), reach), lower, upper);
    } else if (kind == 1) {
      x = alone(k, shares, centre, lower, upper, reach);
    } else if (kind < before_spans) {
      const std::size_t j = static_cast<std::size_t>(kind - 2) / 2;
      x = along(2 * k + kind % 2, around[j], directions[j], reach);
    } else {
      const Span& span = spans[static_cast<std::size_t>(kind - before_spans)];
      x = nearlySpanned(k, span, around[span.around].free, directions[span.around], centre, reach);
    }
    list.push_back(within(x, centre, lower, upper));
  }
  return list;
}

void keepInMost(std::vector<Eigen::VectorXd>& places, const Eigen::VectorXd& start, const std::vector<char>& has_influence) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i % kAllVary == i / (2 * kAllVary) % kAllVary) continue;  // in turn, as the kinds of samples take turns, too
    for (std::size_t j = 0; j < has_influence.size(); ++j) {
      const auto number = static_cast<Eigen::Index>(j);
      if (!has_influence[j]) places[i][number] = start[number];
    }
  }
}

}  // namespace carom::editing_detail
