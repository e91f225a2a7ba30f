// SPDX-License-Identifier: MIT
#include "editing/problem/rows/refined_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::editing_detail {
namespace {

/// Each is 0.618 of the one before: together they take a span to below its rounding.
constexpr int kSections = 75;
/// Share of a span on either side of a time that is looked at, no less than the distance of the times compared before.
constexpr double kShareOfSpan = 1.0 / 64;

/// Sum of the squares of the residuals of the rows of one constraint; infinite where they do not exist.
double missOf(const ConstraintSet& constraints, const RowValues& rows, int constraint) {
  double sum = 0;
  for (int i = 0; i < constraints.size(); ++i) {
    const Row& row = constraints.rows()[static_cast<std::size_t>(i)];
    if (row.constraint == constraint && !row.overSpan()) sum += rows.scaled[i] * rows.scaled[i];
  }
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

}  // namespace

Eigen::VectorXd refinedTimes(const ConstraintSet& constraints, const Motion& motion) {
  Eigen::VectorXd times = constraints.nearestTimes(motion);
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const FreeTime& free = constraints.freeTimes()[static_cast<std::size_t>(k)];
    double best = times[k], least = std::numeric_limits<double>::infinity();
    const auto missAt = [&](double t) {
      times[k] = t;
      const double miss = missOf(constraints, constraints.evaluate(motion, times), free.constraint);
      if (miss < least) least = miss, best = t;
      return miss;
    };
    missAt(best);
    const double half_width = kShareOfSpan * (free.to - free.from);
    double lo = std::max(free.from, best - half_width), hi = std::min({free.to, motion.end, best + half_width});
    double a = hi - golden * (hi - lo), b = lo + golden * (hi - lo);
    double miss_a = hi > lo ? missAt(a) : 0, miss_b = hi > lo ? missAt(b) : 0;
    for (int step = 0; step < kSections && a < b; ++step) {
      if (miss_a < miss_b) {
        hi = b, b = a, miss_b = miss_a;
        miss_a = missAt(a = hi - golden * (hi - lo));
      } else {
        lo = a, a = b, miss_a = miss_b;
        miss_b = missAt(b = lo + golden * (hi - lo));
      }
    }
    times[k] = best;
  }
  return times;
}

}  // namespace carom::editing_detail
