// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "adjoint/simulate/simulator.hpp"

// Pairs that overlap from the start do not meet until they have parted.

namespace carom::adjoint_detail {

void Simulator::startOverlaps() {
  motion_.overlaps = contacts_.overlaps();
  if (refuse_overlaps_ && !motion_.overlaps.empty()) refuseOverlap(scene_, motion_.overlaps.front());
  overlaps_until_.assign(motion_.overlaps.size(), 0);
}

StartOverlap* Simulator::overlapOf(int a, int b) {
  if (motion_.overlaps.empty()) return nullptr;
  const auto at = std::ranges::lower_bound(motion_.overlaps, std::pair(a, b), {},
                                           [](const StartOverlap& o) { return std::pair(o.a, o.b); });
  return at != motion_.overlaps.end() && at->a == a && at->b == b ? &*at : nullptr;
}

// Along the arcs that are part of the motion, up to a time before which nothing will change.
void Simulator::followOverlap(StartOverlap& overlap, double until) {
  double& known = overlaps_until_[static_cast<std::size_t>(&overlap - motion_.overlaps.data())];
  while (!overlap.parted && known < until) {
    double next = until;
    const auto arcAt = [&](int body) -> Arc& {
      auto& arcs = motion_.world_lines[index(body)].arcs;
      const auto k = index(motion_.arcAt(body, known));
      if (k + 1 < arcs.size()) next = std::min(next, arcs[k + 1].start());
      return arcs[k];
    };
    Arc &a = arcAt(overlap.a), &b = arcAt(overlap.b);
    overlap.parted = contacts_.parting(overlap.a, overlap.b, a, b, known, next);
    known = next;
  }
}

// When the pair parts or has parted, if it does before `until` on the paths that it has now from `from` on.
std::optional<double> Simulator::partingOf(StartOverlap& overlap, double from, double until) {
  followOverlap(overlap, from);
  if (overlap.parted) return overlap.parted;
  return contacts_.parting(overlap.a, overlap.b, pathOf(overlap.a), pathOf(overlap.b), from, until);
}

void Simulator::endOverlaps(double end) {
  for (StartOverlap& overlap : motion_.overlaps) {
    try {
      followOverlap(overlap, end);
    } catch (const NotComputable&) {
      continue;  // not known to have parted
    } catch (const WorkEnded&) {
      if (!work_ended_) throw;
      continue;
    }
    if (overlap.parted && *overlap.parted > end) overlap.parted.reset();
  }
}

}  // namespace carom::adjoint_detail
