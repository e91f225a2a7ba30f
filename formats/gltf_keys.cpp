#include "formats/detail/gltf_keys.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/errors.h"

namespace carom {
namespace {

// The largest turn between keys: well below the half turn at which the shortest way round would be the wrong one.
constexpr double kMaxTurn = 1.5;
// Share of the tolerance that is used up; the rest is for the curvature of the rotations and for floats.
constexpr double kShare = 0.5;

struct Piece {
  const Arc* arc;
  double from, to;
};

// The arcs of a body, cut at the frames when fps > 0.
std::vector<Piece> piecesOf(const Motion& motion, int body, double fps) {
  const auto& arcs = motion.world_lines[body].arcs;
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const double end = k + 1 < arcs.size() ? arcs[k + 1].start() : motion.end;
    double from = arcs[k].start();
    if (fps > 0)
      for (double frame = std::floor(from * fps) + 1; frame / fps < end; ++frame) {
        if (!(frame / fps > from)) continue;
        pieces.push_back({&arcs[k], from, frame / fps});
        from = frame / fps;
      }
    pieces.push_back({&arcs[k], from, end});
  }
  return pieces;
}

// Between keys h apart the shortest turn leaves the motion by at most h^2/8 |d omega/dt|.
double countOfTurns(const Piece& piece) {
  if (piece.arc->tier() == Tier::none) return 1;  // keeps its orientation
  const double h = piece.to - piece.from;
  const double by_rate = h * std::sqrt(piece.arc->spinRateBound() / (8 * kShare * kRotationTolerance));
  return std::max({1.0, std::ceil(by_rate), std::ceil(h * piece.arc->spinBound() / kMaxTurn)});
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

void add(RotationKeys& keys, double t, const Arc& arc) {
  const auto time = static_cast<float>(t);
  if (!keys.times.empty() && !(time > keys.times.back())) return;
  Quat q = toBodyState(arc.model(), arc.stateAt(t)).orientation;
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

// Cubics between keys h apart leave the circle of radius c that the origin turns on by c (omega h)^4 / 384. The rate of
// change of omega counts as spin of its own.
double countOfSwings(const Piece& piece) {
  const double c = piece.arc->model().center.norm();
  if (c == 0 || piece.arc->tier() == Tier::none) return 1;
  const double spin = piece.arc->spinBound() + std::sqrt(piece.arc->spinRateBound());
  const double turn = std::pow(384 * kShare * kTranslationTolerance / c, 0.25);
  return std::max(1.0, std::ceil(spin * (piece.to - piece.from) / turn));
}

TranslationKeys translationKeys(const std::vector<Piece>& pieces) {
  TranslationKeys keys;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto [arc, from, to] = pieces[k];
    const Origin origin = originAt(*arc, from);
    add(keys, from, origin.x, k > 0 ? originAt(*pieces[k - 1].arc, from).v : origin.v, origin.v);
  }
  if (pieces.empty()) return keys;
  const Origin end = originAt(*pieces.back().arc, pieces.back().to);
  add(keys, pieces.back().to, end.x, end.v, end.v);
  return keys;
}

void requireFew(double keys, const Motion& motion, int body) {
  if (!(keys <= kMaxKeys))
    throw InputError("body '" + motion.scene->bodies[body].name + "'", "spins too fast to be exported: it would need " +
                                                                           std::to_string(keys) + " keys, at most " +
                                                                           std::to_string(kMaxKeys) + " are written");
}

}  // namespace

TranslationKeys splineKeys(const Motion& motion, int body) {
  std::vector<Piece> cut;
  double total = 1;
  for (const Piece& piece : piecesOf(motion, body, 0)) {
    const double count = countOfSwings(piece), step = (piece.to - piece.from) / count;
    requireFew(total += count, motion, body);
    for (double i = 0; i < count; ++i)
      cut.push_back({piece.arc, piece.from + i * step, i + 1 < count ? piece.from + (i + 1) * step : piece.to});
  }
  return translationKeys(cut);
}

TranslationKeys frameKeys(const Motion& motion, int body, double fps) {
  return translationKeys(piecesOf(motion, body, fps));
}

RotationKeys rotationKeys(const Motion& motion, int body, double fps) {
  RotationKeys keys;
  const std::vector<Piece> pieces = piecesOf(motion, body, fps);
  double total = 1;
  for (const Piece& piece : pieces) total += countOfTurns(piece);
  requireFew(total, motion, body);
  for (const Piece& piece : pieces) {
    const double count = countOfTurns(piece);
    for (double i = 0; i < count; ++i) add(keys, piece.from + (piece.to - piece.from) * (i / count), *piece.arc);
  }
  if (!pieces.empty()) add(keys, pieces.back().to, *pieces.back().arc);
  return keys;
}

}  // namespace carom
