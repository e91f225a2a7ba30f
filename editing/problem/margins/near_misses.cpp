// SPDX-License-Identifier: MIT
#include "editing/problem/margins/near_misses.hpp"

#include <algorithm>
#include <utility>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "editing/problem/rows/closest_approach.hpp"

namespace carom::editing_detail {
namespace {

/// In lengths of the smaller body: what passes farther away is no near miss.
constexpr double kFarthestPassing = 10;

struct Passing {
  double share = 0;   ///< distance / length
  double length = 0;  ///< of the smaller body, m
  DistanceReading at;
};

/// Where two bodies come nearest between events of theirs, unless they touch there.
void addPassings(const Motion& motion, int a, int b, double until, std::vector<Passing>& passings) {
  const BodyDistance& distances = distancesOf(motion);
  const double length = lengthOfSmaller(*motion.scene, a, b);
  const std::vector<int> events = eventsWithin(motion, a, b, 0, until);
  const auto eventOf = [&](std::size_t k) -> const Event& { return motion.events[static_cast<std::size_t>(events[k])]; };
  double start = 0;
  for (std::size_t k = 0; k <= events.size(); ++k) {
    const bool last = k == events.size();
    const double from = std::exchange(start, last ? until : eventOf(k).time);
    const bool touch = (k > 0 && eventOf(k - 1).touches(a, b)) || (!last && eventOf(k).touches(a, b));
    if (touch || !(start > from)) continue;
    const auto found = distances.nearestInTime(a, b, arcFrom(motion, a, from), arcFrom(motion, b, from), from, start,
                                               kFarthestPassing * length);
    if (!found || !found->nearest.apart() || (k > 0 && found->time == from)) continue;  // from: the end of the last stretch
    const bool at_event = !last && found->time == start;
    passings.push_back({found->nearest.gap / length, length,
                        readDistance(motion, a, b, at_event ? Instant::before(events[k]) : Instant::at(found->time))});
  }
}

/// The nearest first. None where distances are not known or cannot be computed.
std::vector<Passing> passingsOf(const Motion& motion, double until) {
  const std::vector<Body>& bodies = motion.scene->bodies;
  std::vector<Passing> passings;
  try {
    for (std::size_t a = 0; a < bodies.size(); ++a)
      for (std::size_t b = a + 1; b < bodies.size(); ++b)
        if (mayCollide(bodies[a], bodies[b]))
          addPassings(motion, static_cast<int>(a), static_cast<int>(b), until, passings);
  } catch (const InputError&) {
    return {};
  } catch (const NotComputable&) {
    return {};
  }
  std::stable_sort(passings.begin(), passings.end(), [](const Passing& p, const Passing& q) { return p.share < q.share; });
  return passings;
}

}  // namespace

std::vector<NearMiss> nearMisses(const EditProblem& problem, const Eigen::VectorXd& unknowns, DerivativeTape& tape,
                                 const RowValues& rows, std::size_t most) {
  if (most == 0) return {};
  const Motion& motion = tape.motion();
  const double until = std::min(motion.end, problem.constraints.extentIn(motion, rows.times).time);
  std::vector<NearMiss> misses;
  for (const Passing& passing : passingsOf(motion, until)) {
    if (misses.size() == most) break;
    const std::vector<StateSeed> seeds = passing.at.seeds();
    Eigen::VectorXd gradient = problem.byChanges(adjoint(tape, seeds), unknowns);
    if (!(gradient.squaredNorm() > 0) || !gradient.allFinite()) continue;
    misses.push_back({passing.at.value(), passing.length, std::move(gradient)});
  }
  return misses;
}

}  // namespace carom::editing_detail
