// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "formats/drawing/display.h"

namespace carom::test {

/// A body as a page shows it.
struct PagePose {
  Vec3 center, velocity;  ///< of mass, m and m/s, world
  Quat orientation;       ///< shape to world
  Vec3 origin;            ///< of the shape, m, world
};

/// What a page makes of a track, in its own arithmetic: doubles, of the numbers as they are sent.
inline PagePose pagePoseAt(const DisplayTrack& track, double t) {
  const auto lastNotAfter = [&](const auto& keys) {
    const auto next =
        std::upper_bound(keys.begin(), keys.end(), t, [](double x, const auto& key) { return x < key.time; });
    return next == keys.begin() ? next : next - 1;
  };
  const DisplayTrack::ArcKey& arc = *lastNotAfter(track.arcs);
  const double s = t - arc.time;
  const auto of = [](const DisplayTrack::TurnKey& key) { return Quat(key.w, key.x, key.y, key.z).normalized(); };
  const auto key = lastNotAfter(track.turns);
  Quat q = of(*key);
  if (key + 1 != track.turns.end() && t > key->time) {
    const DisplayTrack::TurnKey &a = *key, &b = *(key + 1);
    const double share = (t - a.time) / (static_cast<double>(b.time) - a.time);
    const Quat qa = of(a), qb = of(b);
    const double angle = std::acos(std::min(1.0, qa.dot(qb))), sine = std::sin(angle);
    const double wa = sine > 1e-6 ? std::sin((1 - share) * angle) / sine : 1 - share;
    const double wb = sine > 1e-6 ? std::sin(share * angle) / sine : share;
    q.coeffs() = wa * qa.coeffs() + wb * qb.coeffs();
    q.normalize();
  }
  PagePose pose;
  const auto powers = [s](const Vec3& c0, const Vec3& c1, const Vec3& c2) -> Vec3 { return c0 + s * (c1 + s * c2); };
  const Vec3 beyond = powers(0.5 * arc.acceleration, arc.third, arc.fourth + s * arc.fifth);
  pose.center = arc.position + s * (arc.velocity + s * beyond);
  pose.velocity = arc.velocity + s * powers(arc.acceleration, 3 * arc.third, 4 * arc.fourth + 5 * s * arc.fifth);
  pose.orientation = q;
  pose.origin = pose.center - q * track.center;
  return pose;
}

}  // namespace carom::test
