// SPDX-License-Identifier: MIT
#include "editing/problem/rows/nearest_instants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/numeric/illinois.hpp"

namespace carom::editing_detail {
namespace {

/// Looks at a whole span, and at least at each part of it between two events.
constexpr double kLooksOfSpan = 64;
constexpr int kLeastLooks = 4;
/// Valleys that are followed to their bottoms, the deepest looks first.
constexpr std::size_t kValleys = 4;
/// Halvings of a time between two looks: more than doubles tell apart.
constexpr int kMostRounds = 100;

/// An end of a part of a span: an event, or an end of the span itself.
struct PartEnd {
  double time;
  int first_event = -1, last_event = -1;  ///< of those at this time
};

/// A look at which the miss is no larger than at those beside it, which are the same one at an end of a part.
struct Valley {
  Instant instant;
  ValueInTime look;
  double before, after;  ///< s
};

std::vector<PartEnd> partEnds(const ConstraintSet& constraints, const Motion& motion, const FreeTime& span) {
  std::vector<int> events;
  for (const int body : constraints.bodiesRead(span.constraint)) {
    const std::vector<int>& of_body = motion.world_lines[static_cast<std::size_t>(body)].events;
    events.insert(events.end(), of_body.begin(), of_body.end());
  }
  std::sort(events.begin(), events.end());
  std::vector<PartEnd> ends{{span.from}};
  const double last = std::min(span.to, motion.end);
  for (const int event : events) {
    const double time = motion.events[static_cast<std::size_t>(event)].time;
    if (!(time > span.from && time < last)) continue;
    if (ends.back().time == time)
      ends.back().last_event = event;
    else
      ends.push_back({time, event, event});
  }
  ends.push_back({last});
  return ends;
}

/// Between two times the miss is smooth; at an event it is what it tends to from within.
void addValleys(const ConstraintSet& constraints, const Motion& motion, const FreeTime& span, const PartEnd& a,
                const PartEnd& b, std::vector<Valley>& valleys) {
  const double from = a.first_event >= 0 ? std::nextafter(a.time, b.time) : a.time;
  const double to = b.first_event >= 0 ? std::nextafter(b.time, a.time) : b.time;
  const int looks = std::max(kLeastLooks, static_cast<int>(std::ceil(kLooksOfSpan * (to - from) / (span.to - span.from))));
  std::vector<ValueInTime> seen;
  for (int k = 0; k <= looks; ++k) {
    const double t = k == looks ? to : from + (to - from) * k / looks;
    if (!seen.empty() && !(t > seen.back().time)) continue;
    seen.push_back(constraints.missInTime(motion, span.constraint, t));
  }
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::size_t before = k > 0 ? k - 1 : k, after = k + 1 < seen.size() ? k + 1 : k;
    if (!(seen[k].value <= seen[before].value && seen[k].value <= seen[after].value)) continue;
    Instant instant = Instant::at(seen[k].time);
    if (k == 0 && a.first_event >= 0) instant = Instant::after(a.last_event);
    if (k + 1 == seen.size() && b.first_event >= 0) instant = Instant::before(b.first_event);
    valleys.push_back({instant, seen[k], seen[before].time, seen[after].time});
  }
}

/// To where the rate is 0; a look at an end of a part from
/// which the miss rises stays as it is.
Valley bottomOf(const ConstraintSet& constraints, const Motion& motion, int constraint, const Valley& valley) {
  const double beside = valley.look.rate > 0 ? valley.before : valley.after;
  if (valley.look.rate == 0 || beside == valley.look.time) return valley;
  ValueInTime a = valley.look, b = constraints.missInTime(motion, constraint, beside);
  if (!(a.rate * b.rate < 0)) return valley;
  adjoint_detail::IllinoisEnds f{a.rate, b.rate};
  ValueInTime best = a;
  for (int round = 0; round < kMostRounds; ++round) {
    double t = a.time - f.a * (b.time - a.time) / (f.b - f.a);
    if (round % 4 == 3 || !(std::min(a.time, b.time) < t && t < std::max(a.time, b.time))) t = a.time + 0.5 * (b.time - a.time);
    if (!(std::min(a.time, b.time) < t && t < std::max(a.time, b.time))) break;
    const ValueInTime here = constraints.missInTime(motion, constraint, t);
    if (std::abs(here.rate) < std::abs(best.rate)) best = here;
    if (here.rate == 0) break;
    if ((here.rate > 0) == (a.rate > 0)) {
      a = here, f.moveA(here.rate);
    } else {
      b = here, f.moveB(here.rate);
    }
  }
  return {Instant::at(best.time), best, best.time, best.time};
}

Instant nearestInstant(const ConstraintSet& constraints, const Motion& motion, const FreeTime& span) {
  if (!(motion.end >= span.from)) return Instant::at(span.from);
  const std::vector<PartEnd> ends = partEnds(constraints, motion, span);
  std::vector<Valley> valleys;
  for (std::size_t k = 1; k < ends.size(); ++k) addValleys(constraints, motion, span, ends[k - 1], ends[k], valleys);
  if (valleys.empty()) return Instant::at(span.from);
  std::stable_sort(valleys.begin(), valleys.end(), [](const Valley& a, const Valley& b) { return a.look.value < b.look.value; });
  valleys.resize(std::min(valleys.size(), kValleys));
  double least = std::numeric_limits<double>::infinity();
  Instant nearest = valleys.front().instant;
  for (const Valley& valley : valleys) {
    const Valley bottom = bottomOf(constraints, motion, span.constraint, valley);
    if (bottom.look.value < least) least = bottom.look.value, nearest = bottom.instant;
  }
  return nearest;
}

}  // namespace

std::vector<Instant> nearestInstants(const ConstraintSet& constraints, const Motion& motion) {
  std::vector<Instant> instants;
  for (const FreeTime& span : constraints.freeTimes()) instants.push_back(nearestInstant(constraints, motion, span));
  return instants;
}

bool movesInSpan(const FreeTime& span, const Motion& motion, const Instant& instant) {
  return instant.event < 0 && instant.time > span.from && instant.time < std::min(span.to, motion.end);
}

}  // namespace carom::editing_detail
