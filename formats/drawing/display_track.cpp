// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/arguments.hpp"
#include "formats/drawing/display.h"
#include "formats/drawing/turn_keys.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace formats_detail;

namespace {

// Of what is asked of a path that is no parabola, half is for rounding.
constexpr double kBendTolerance = 5e-10;  // m
// Shortest turns stay this much of the tolerance away from the motion. They leave it by h^2/8 |d omega/dt| and, since
// axes turn with the body, by at most as much again where it turns by 1 rad from key to key.
constexpr double kTurnShare = 0.5;
constexpr double kMostTurn = 1;  // rad

// From the state at t over h seconds to where the path then is.
DisplayTrack::ArcKey parabolaOver(const Arc& arc, double t, double h) {
  const Vec3 x = arc.positionAt(t), v = arc.velocityAt(t);
  return {t, x, v, (arc.positionAt(t + h) - x - h * v) * (2 / (h * h))};
}

// How far it is from the path where a cubic is farthest from such a parabola, and before that.
double distanceFrom(const Arc& arc, const DisplayTrack::ArcKey& key, double h) {
  double worst = 0;
  for (const double share : {1.0 / 3, 2.0 / 3}) {
    const double s = share * h;
    const Vec3 x = key.position + s * (key.velocity + 0.5 * s * key.acceleration);
    worst = std::max(worst, (x - arc.positionAt(key.time + s)).norm());
  }
  return worst;
}

// Steps as long as the last one and its error let expect: the error goes with the cube of the length.
class BendKeys {
 public:
  BendKeys(const Motion& motion, int body, DisplayTrack& track) : motion_(motion), body_(body), track_(track) {}

  void add(const Arc& arc, double from, double to) {
    const double variation = arc.accelerationVariation();
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * arc.positionAt(from).norm();
    const double tolerance = kBendTolerance + rounding;
    // Within this time no acceleration that varies by no more than that can do harm.
    const double harmless = std::sqrt(tolerance / variation);
    double t = from, h = to - from;
    while (t < to) {
      const bool last = t + h * (1 + 1e-9) >= to;
      if (last) h = to - t;
      const DisplayTrack::ArcKey key = parabolaOver(arc, t, h);
      const double error = h > harmless ? distanceFrom(arc, key, h) : 0;
      if (error > tolerance) {
        h = std::max(harmless, h * std::clamp(0.9 * std::cbrt(tolerance / error), 0.1, 0.9));
        continue;
      }
      requireFew(static_cast<double>(track_.arcs.size()) + 1, motion_, body_);
      track_.arcs.push_back(key);
      if (last || !(t + h > t)) return;
      t += h;
      h *= error > 0 ? std::clamp(0.9 * std::cbrt(tolerance / error), 0.5, 4.0) : 4;
    }
  }

 private:
  const Motion& motion_;
  int body_;
  DisplayTrack& track_;
};

void addArcs(const Motion& motion, int body, DisplayTrack& track) {
  BendKeys bends(motion, body, track);
  const std::vector<KeyPiece> pieces = arcsOf(motion, body);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [arc, from, to] = pieces[k];
    if (!(to > from) && k + 1 < pieces.size()) continue;  // two events of one time: what follows begins there
    if (arc->accelerationVariation() > 0 && to > from)
      bends.add(*arc, from, to);
    else
      track.arcs.push_back({from, arc->positionAt(from), arc->velocityAt(from), arc->acceleration()});
  }
}

void addTurns(const Motion& motion, int body, double tolerance, DisplayTrack& track) {
  const TurnSpacing spacing{kTurnShare * tolerance, kMostTurn};
  const RotationKeys keys =
      turnKeys(evenPieces(motion, body, [&](const Arc& arc) { return rateOfTurns(arc, spacing); }));
  for (std::size_t k = 0; k < keys.times.size(); ++k) {
    const Eigen::Quaternionf q = keys.values[k].cast<float>();
    track.turns.push_back({keys.times[k], q.w(), q.x(), q.y(), q.z()});
  }
  const auto sameTurn = [](const DisplayTrack::TurnKey& a, const DisplayTrack::TurnKey& b) {
    return a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z;
  };
  while (track.turns.size() > 1 && sameTurn(track.turns.back(), track.turns[track.turns.size() - 2]))
    track.turns.pop_back();
}

}  // namespace

DisplayTrack displayTrack(const Motion& motion, int body, double turn_tolerance) {
  const std::size_t b = checkedIndex("displayTrack", "body", body, motion.world_lines.size());
  if (!(checkedNumber("displayTrack", "the tolerance of turns", turn_tolerance) > 0))
    refuseNumber("displayTrack", "the tolerance of turns", turn_tolerance, "a number above 0");
  DisplayTrack track;
  track.center = (*motion.models)[b].center;
  addArcs(motion, body, track);
  addTurns(motion, body, turn_tolerance, track);
  return track;
}

}  // namespace carom
