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

struct KeyPiece {
  const Arc* arc;
  double from, to;
};

// The flights of a body, whole.
std::vector<KeyPiece> flightsOf(const Motion& motion, int body) {
  const auto& arcs = motion.world_lines[body].arcs;
  std::vector<KeyPiece> pieces;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k)
    pieces.push_back({&arcs[k], arcs[k].start(), arcEnd(motion, body, k)});
  return pieces;
}

// How many keys a second keep shortest turns near enough: between keys h apart they leave the motion by at most
// h^2/8 |d omega/dt|.
double rateOfTurns(const Arc& arc) {
  if (arc.tier() == Tier::none) return 0;  // keeps its orientation
  return std::max(std::sqrt(arc.spinRateBound() / (8 * kShare * kRotationTolerance)), arc.spinBound() / kMaxTurn);
}

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
double rateOfSwings(const Arc& arc) {
  const double c = arc.model().center.norm();
  const double bend = std::sqrt(arc.accelerationVariation() / (16 * kShare * kCubicTolerance));  // of a slide
  if (c == 0 || arc.tier() == Tier::none) return bend;
  const double spin = arc.spinBound() + std::sqrt(arc.spinRateBound());
  return bend + spin / std::pow(384 * kShare * kCubicTolerance / c, 0.25);
}

void requireFew(double keys, const Motion& motion, int body) {
  const auto& bodies = motion.scene->bodies;
  const std::size_t moving = movingCount(*motion.scene);
  const bool few_alone = keys <= kMaxKeys;
  if (few_alone && keys * static_cast<double>(moving) <= kMaxKeysOfAll) return;
  const double most = few_alone ? std::floor(kMaxKeysOfAll / static_cast<double>(moving)) : kMaxKeys;
  throw InputError("body '" + bodies[body].name + "'",
                   "would need " + numberText(std::ceil(keys)) + " keys, at most " + numberText(most) + " are written" +
                       (few_alone ? " of each of " + std::to_string(moving) + " moving bodies" : "") +
                       "; a shorter motion, fewer frames a second, a larger tolerance or cubic keys need less");
}

// The flights, each in equal parts.
template <class Rate>
std::vector<KeyPiece> evenPieces(const Motion& motion, int body, const Rate& rate) {
  std::vector<KeyPiece> cut;
  double total = 1;
  for (const auto& [arc, from, to] : flightsOf(motion, body)) {
    const double count = std::max(1.0, std::ceil((to - from) * rate(*arc))), step = (to - from) / count;
    requireFew(total += count, motion, body);
    for (double i = 0; i < count; ++i) cut.push_back({arc, from + i * step, i + 1 < count ? from + (i + 1) * step : to});
  }
  return cut;
}

// The flights, each cut at its multiples of a frame's part.
std::vector<KeyPiece> framePieces(const Motion& motion, int body, double fps, double tolerance) {
  std::vector<KeyPiece> cut;
  double total = 1;
  for (const auto& [arc, start, to] : flightsOf(motion, body)) {
    const double need = std::max(rateOfTurns(*arc), rateOfLines(*arc, tolerance));
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

// The time that a file has for t, which is a float's: values are of that time, so that long motions lose nothing to it.
double storedTime(double t, const KeyPiece& piece) {
  return std::clamp<double>(static_cast<float>(t), piece.arc->start(), piece.to);
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

void add(RotationKeys& keys, double t, const KeyPiece& piece) {
  const auto time = static_cast<float>(t);
  if (!keys.times.empty() && !(time > keys.times.back())) return;
  Quat q = toBodyState(piece.arc->model(), piece.arc->stateAt(storedTime(t, piece))).orientation;
  if (!keys.values.empty() && keys.values.back().dot(q) < 0) q.coeffs() *= -1;
  keys.times.push_back(time);
  keys.values.push_back(q);
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
    const Origin origin = originAt(*arc, storedTime(from, pieces[k]));
    add(keys, from, origin.x, k > 0 ? originAt(*pieces[k - 1].arc, from).v : origin.v, origin.v);
  }
  if (pieces.empty()) return keys;
  const Origin end = originAt(*pieces.back().arc, storedTime(pieces.back().to, pieces.back()));
  add(keys, pieces.back().to, end.x, end.v, end.v);
  return keys;
}

RotationKeys turnKeys(const std::vector<KeyPiece>& pieces) {
  RotationKeys keys;
  for (const KeyPiece& piece : pieces) add(keys, piece.from, piece);
  if (!pieces.empty()) add(keys, pieces.back().to, pieces.back());
  return keys;
}

}  // namespace

TranslationKeys cubicKeys(const Motion& motion, int body) { return moveKeys(evenPieces(motion, body, rateOfSwings)); }

RotationKeys turnKeys(const Motion& motion, int body) { return turnKeys(evenPieces(motion, body, rateOfTurns)); }

FrameKeys frameKeys(const Motion& motion, int body, double fps, double tolerance) {
  const Body& b = motion.scene->bodies[body];
  const double radius = radiusAbout(b.shape, Vec3::Zero());
  const std::vector<KeyPiece> pieces = framePieces(motion, body, fps, std::min(tolerance, kShareOfRadius * radius));
  return {moveKeys(pieces), turnKeys(pieces)};
}

}  // namespace carom::formats_detail
