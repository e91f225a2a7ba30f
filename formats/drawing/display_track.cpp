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

// Of the 1e-9 m that are promised round bends half is for rounding.
constexpr double kBendTolerance = 5e-10;  // m
// Shortest turns stay this much of the tolerance away from the motion. They leave it by h^2/8 |d omega/dt| and, since
// axes turn with the body, by at most as much again where it turns by 1 rad from key to key.
constexpr double kTurnShare = 0.5;
constexpr double kMostBetweenKeys = 1;  // rad

Vec3 pathAcceleration(const Arc& arc, double t) { return arc.rateAt(t, {}).v; }

// Hermite's polynomial of degree 5: place, velocity and acceleration of the path at t and h seconds later.
DisplayTrack::ArcKey keyOver(const Arc& arc, double t, double h) {
  DisplayTrack::ArcKey key{t, arc.positionAt(t), arc.velocityAt(t), pathAcceleration(arc, t)};
  const Vec3 a = h * h * (pathAcceleration(arc, t + h) - key.acceleration);
  const Vec3 v = h * (arc.velocityAt(t + h) - key.velocityAt(t + h));
  const Vec3 x = arc.positionAt(t + h) - key.positionAt(t + h);
  key.third = (10 * x - 4 * v + 0.5 * a) / (h * h * h);
  key.fourth = (-15 * x + 7 * v - a) / (h * h * h * h);
  key.fifth = (6 * x - 3 * v + 0.5 * a) / (h * h * h * h * h);
  return key;
}

// How far it is from the path between its ends.
double distanceFrom(const Arc& arc, const DisplayTrack::ArcKey& key, double h) {
  double worst = 0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const double t = key.time + share * h;
    worst = std::max(worst, (key.positionAt(t) - arc.positionAt(t)).norm());
  }
  return worst;
}

// Steps as long as the last one and its error let expect: the error goes with the sixth power of the length.
class BendKeys {
 public:
  BendKeys(const Motion& motion, int body, DisplayTrack& track) : motion_(motion), body_(body), track_(track) {}

  void add(const Arc& arc, double from, double to) {
    const double variation = arc.accelerationVariation();
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * arc.positionAt(from).norm();
    const double tolerance = kBendTolerance + rounding;
    // In this time an acceleration that varies by no more than that does no harm: a parabola will do.
    const double harmless = std::sqrt(tolerance / variation);
    double t = from, h = to - from;
    while (t < to) {
      const bool last = t + h * (1 + 1e-9) >= to;
      if (last) h = to - t;
      const bool is_short = !(h > harmless);
      const DisplayTrack::ArcKey key =
          is_short ? DisplayTrack::ArcKey{t, arc.positionAt(t), arc.velocityAt(t), pathAcceleration(arc, t)}
                   : keyOver(arc, t, h);
      const double error = is_short ? 0 : distanceFrom(arc, key, h);
      const double next = error > 0 ? 0.9 * std::pow(tolerance / error, 1.0 / 6) : 4;
      if (error > tolerance) {
        h = std::max(harmless, h * std::max(next, 0.1));
        continue;
      }
      requireFew(static_cast<double>(track_.arcs.size()) + 1, motion_, body_);
      track_.arcs.push_back(key);
      if (last || !(t + h > t)) return;
      t += h;
      h *= std::clamp(next, 0.5, 4.0);
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
  const TurnSpacing spacing{kTurnShare * tolerance, kMostBetweenKeys};
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

bool DisplayTrack::ArcKey::isParabola() const { return third.isZero(0) && fourth.isZero(0) && fifth.isZero(0); }

Vec3 DisplayTrack::ArcKey::positionAt(double t) const {
  const double s = t - time;
  const Vec3 parabola = position + s * (velocity + 0.5 * s * acceleration);
  return isParabola() ? parabola : Vec3(parabola + s * s * s * (third + s * (fourth + s * fifth)));
}

Vec3 DisplayTrack::ArcKey::velocityAt(double t) const {
  const double s = t - time;
  return velocity + s * (acceleration + s * (3 * third + s * (4 * fourth + 5 * s * fifth)));
}

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
