// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/illinois.hpp"

namespace carom::editing_detail {

/// A value at a time, with its rate there.
struct ValueInTime {
  double time = 0, value = std::numeric_limits<double>::infinity(), rate = 0;
};

/// The least value over [from, to] of a function that is the least of many, none of which bends up by more than `bend`,
/// such as the clearance of the points of a body that accelerate by no more than that. Between two times that are h
/// apart it lies no lower than the lower of the two values less bend h^2/8. Spans that cannot hold a value lower by
/// `slack` are passed over, the others halved; after thousands of halvings the slack is doubled, again and again.
/// `read(t)` gives a ValueInTime.
template <class Read>
class LeastInTime {
 public:
  LeastInTime(Read read, double bend, double slack, double from, double to)
      : read_(std::move(read)), bend_(bend), slack_(slack), same_(kSame * slack), from_(from), to_(to) {}

  ValueInTime find() {
    ValueInTime first = read_(from_), last = first;
    keep(first);
    if (to_ > from_) {
      last = read_(to_);
      keep(last);
      if (first.rate < 0) keep(wayDown(first));
      if (last.rate > 0) keep(wayDown(last));
      search(first, last);
    }
    return best_;
  }
  /// Nowhere is the function lower by more than this.
  double slack() const { return slack_; }

 private:
  struct Span {
    ValueInTime a, b;
  };
  static constexpr int kHalvingsOfSlack = 5'000, kMostHalvings = 500'000, kMostRounds = 200;
  /// What of the slack is rounding.
  static constexpr double kSame = 1e-4;

  void keep(const ValueInTime& here) {
    if (here.value < best_.value - same_) best_ = here;
  }

  void search(const ValueInTime& first, const ValueInTime& last) {
    std::vector<Span> spans{{first, last}};
    for (int halvings = 1; !spans.empty(); ++halvings) {
      const Span span = spans.back();
      spans.pop_back();
      const double h = span.b.time - span.a.time, middle = span.a.time + 0.5 * h;
      const double lowest = std::min(span.a.value, span.b.value) - bend_ * h * h / 8;
      if (lowest >= best_.value - slack_ || !(middle > span.a.time && middle < span.b.time)) continue;
      if (halvings > kMostHalvings)
        throw NotComputable("it takes more than " + std::to_string(kMostHalvings) +
                            " steps to find the clearance of a body from the boundary of a region: it rotates too fast");
      if (halvings % kHalvingsOfSlack == 0) slack_ *= 2;
      const ValueInTime between = read_(middle);
      if (between.value < best_.value - same_) keep(wayDown(between));
      spans.push_back({span.a, between});
      spans.push_back({between, span.b});
      if (span.a.value < span.b.value) std::swap(spans[spans.size() - 1], spans[spans.size() - 2]);
    }
  }

  // From a place to the bottom of the valley that it is on a side of.
  ValueInTime wayDown(ValueInTime here) const {
    if (here.rate == 0) return here;
    const double way = here.rate < 0 ? 1 : -1, end = here.rate < 0 ? to_ : from_;
    double h = std::abs(end - here.time) / 64;
    for (int round = 0; round < kMostRounds && here.time != end; ++round) {
      const double t = way * (here.time + way * h - end) >= 0 ? end : here.time + way * h;
      if (t == here.time) break;
      const ValueInTime next = read_(t);
      if (way * next.rate >= 0) return bottom(here, next);
      if (next.value < here.value) {
        here = next;
        h *= 2;
      } else {
        h /= 4;  // beyond a hill
      }
    }
    return here;
  }

  // Where values are the same but for rounding, the rate says which place is nearer to the bottom.
  bool isLower(const ValueInTime& p, const ValueInTime& q) const {
    const double difference = p.value - q.value;
    if (std::abs(difference) > same_) return difference < 0;
    return std::abs(p.rate) < std::abs(q.rate);
  }

  // Between a place from which it falls towards the other and one from which it does not: where the rate is 0.
  ValueInTime bottom(ValueInTime a, ValueInTime b) const {
    ValueInTime best = isLower(a, b) ? a : b;
    adjoint_detail::IllinoisEnds f{a.rate, b.rate};
    for (int round = 0; round < kMostRounds && f.b != 0; ++round) {
      double t = a.time - f.a * (b.time - a.time) / (f.b - f.a);
      if (round % 8 == 7 || !std::isfinite(t) || f.a * f.b > 0) t = a.time + 0.5 * (b.time - a.time);
      if (!((t > a.time && t < b.time) || (t < a.time && t > b.time))) break;
      const ValueInTime here = read_(t);
      if (isLower(here, best)) best = here;
      // beyond a hill that is as high there is a valley before it
      if ((here.rate < 0) == (a.rate < 0) && here.rate != 0 && here.value <= a.value + same_) {
        a = here, f.moveA(here.rate);
      } else {
        b = here, f.moveB(here.rate);
      }
    }
    return best;
  }

  Read read_;
  double bend_, slack_, same_, from_, to_;
  ValueInTime best_;
};

}  // namespace carom::editing_detail
