// SPDX-License-Identifier: MIT
#include "formats/gltf/write/keys.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "formats/drawing/motion_extent.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

// The largest turn between keys. Blended quaternions run ahead of an even turn by at most 0.004 turn^3.
constexpr double kMaxTurn = 0.45;
// Share of the tolerance that is used up; the rest is for blended quaternions and for floats.
constexpr double kShare = 0.5;

double rateOfShortTurns(const Arc& arc) { return rateOfTurns(arc, {kShare * kRotationTolerance, kMaxTurn}); }

// How many keep straight lines near enough: h^2/8 |acceleration of the origin|, which is that of the centre of mass and
// c (omega^2 + |d omega/dt|) at a distance c from it.
double rateOfLines(const Arc& arc, double tolerance) {
  double acceleration = arc.acceleration().norm() + arc.accelerationVariation();
  if (arc.tier() != Tier::none)
    acceleration += arc.model().center.norm() * (arc.spinBound() * arc.spinBound() + arc.spinRateBound());
  return std::sqrt(acceleration / (8 * tolerance));
}

// Cubics between keys h apart leave the circle of radius c that the origin turns on by c (omega h)^4 / 384. The rate of
// change of omega counts as spin of its own.
//
// A path whose acceleration stays within V of a constant is h^2/16 V from them at most; such bodies turn about their
// origin, or not at all.
double rateOfSwings(const Arc& arc) {
  if (arc.accelerationVariation() > 0) return std::sqrt(arc.accelerationVariation() / (16 * kShare * kCubicTolerance));
  const double c = arc.model().center.norm();
  if (c == 0 || arc.tier() == Tier::none) return 0;
  const double spin = arc.spinBound() + std::sqrt(arc.spinRateBound());
  return spin / std::pow(384 * kShare * kCubicTolerance / c, 0.25);
}

// The arcs, each cut at its multiples of a frame's part.
std::vector<KeyPiece> framePieces(const Motion& motion, int body, double fps, double tolerance) {
  std::vector<KeyPiece> cut;
  double total = 1;
  for (const auto& [arc, start, to] : arcsOf(motion, body)) {
    const double need = std::max(rateOfShortTurns(*arc), rateOfLines(*arc, tolerance));
    const double parts = std::ceil(need / fps), rate = parts * fps;
    requireFew(total += (to - start) * rate + 1, motion, body);
    double from = start;
    if (rate > 0)
      for (double k = std::floor(start * rate) + 1; k / rate < to; ++k) {
        if (!(k / rate > from)) continue;
        cut.push_back({arc, from, k / rate});
        from = k / rate;
      }
    cut.push_back({arc, from, to});
  }
  return cut;
}

void add(TranslationKeys& keys, double t, const Vec3& x, const Vec3& v_in, const Vec3& v_out) {
  const auto time = static_cast<float>(t);
  if (!keys.times.empty() && !(time > keys.times.back())) {
    keys.out_tangents.back() = v_out;  // impacts that a float cannot tell apart: one key with the last velocity
    return;
  }
  keys.times.push_back(time);
  keys.values.push_back(x);
  keys.in_tangents.push_back(v_in);
  keys.out_tangents.push_back(v_out);
}

// Position and velocity of the shape's origin.
struct Origin {
  Vec3 x, v;
};

Origin originAt(const Arc& arc, double t) {
  if (arc.model().center.isZero(0)) return {arc.positionAt(t), arc.velocityAt(t)};
  const BodyState s = toBodyState(arc.model(), arc.stateAt(t));
  const Vec3 from_centre = s.position - arc.positionAt(t);
  return {s.position, s.velocity + s.angular_velocity.cross(from_centre)};
}

TranslationKeys moveKeys(const std::vector<KeyPiece>& pieces) {
  TranslationKeys keys;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto [arc, from, to] = pieces[k];
    const Origin origin = originAt(*arc, pieces[k].storedTime(from));
    add(keys, from, origin.x, k > 0 ? originAt(*pieces[k - 1].arc, from).v : origin.v, origin.v);
  }
  if (pieces.empty()) return keys;
  const Origin end = originAt(*pieces.back().arc, pieces.back().storedTime(pieces.back().to));
  add(keys, pieces.back().to, end.x, end.v, end.v);
  return keys;
}

}  // namespace

TranslationKeys cubicKeys(const Motion& motion, int body) { return moveKeys(evenPieces(motion, body, rateOfSwings)); }

RotationKeys turnKeys(const Motion& motion, int body) {
  return turnKeys(evenPieces(motion, body, rateOfShortTurns));
}

FrameKeys frameKeys(const Motion& motion, int body, double fps, double tolerance) {
  const Body& b = motion.scene->bodies[body];
  const double radius = radiusAbout(b.shape, Vec3::Zero());
  const std::vector<KeyPiece> pieces = framePieces(motion, body, fps, std::min(tolerance, kShareOfRadius * radius));
  return {moveKeys(pieces), turnKeys(pieces)};
}

}  // namespace carom::formats_detail
