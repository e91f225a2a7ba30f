// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::formats_detail {

inline constexpr double kMaxKeys = 2e6;       ///< of a body
inline constexpr double kMaxKeysOfAll = 5e6;  ///< of all moving bodies, if each needs as many

/// A part of an arc.
struct KeyPiece {
  const Arc* arc;
  double from, to;

  /// The time that a file has for t, which is a float's: values are of that time, so that long motions lose nothing to
  /// it.
  double storedTime(double t) const;
};

/// The arcs of a body, whole.
std::vector<KeyPiece> arcsOf(const Motion& motion, int body);
/// The arcs, each in equal parts: at least as many a second as `rate` says. Throws InputError as `requireFew`.
std::vector<KeyPiece> evenPieces(const Motion& motion, int body, const std::function<double(const Arc&)>& rate);
/// Throws InputError when a body would need more than kMaxKeys, or all together more than kMaxKeysOfAll.
void requireFew(double keys, const Motion& motion, int body);

/// Keys of a rotation, times strictly increasing as floats (glTF stores floats, and equal times are not allowed).
struct RotationKeys {
  std::vector<float> times;
  std::vector<Quat> values;  ///< shape to world, neighbours in one hemisphere
};
/// At the start of every piece and at the end of the last.
RotationKeys turnKeys(const std::vector<KeyPiece>& pieces);

/// How close keys of a rotation must be.
struct TurnSpacing {
  double tolerance;  ///< rad: the shortest turn from key to key leaves the motion by no more than this
  double most;       ///< rad: the body turns by no more than this from key to key
};
/// How many keys a second that takes: between keys h apart shortest turns leave the motion by at most
/// h^2/8 |d omega/dt| as long as the turns are small.
double rateOfTurns(const Arc& arc, const TurnSpacing& spacing);

}  // namespace carom::formats_detail
