// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/drawing/turn_keys.hpp"

namespace carom::formats_detail {

/// Rotation keys are so dense that the shortest turn from key to key stays this near to the motion, in radians. That
/// holds for turns at an even rate (glTF) and for blended and normalized quaternions (Blender).
inline constexpr double kRotationTolerance = 1e-3;
/// Cubic translation keys of a body whose centre of mass is not its origin, and of one that slides round a bend, keep the
/// origin this near to its path, in metres.
inline constexpr double kCubicTolerance = 1e-6;
/// Straight lines stay within this share of the radius of the body, if that is less than the tolerance asked for.
inline constexpr double kShareOfRadius = 0.005;

/// Keys of one body, times strictly increasing as floats (glTF stores floats, and equal times are not allowed).
struct TranslationKeys {
  std::vector<float> times;
  std::vector<Vec3> values;
  std::vector<Vec3> in_tangents, out_tangents;  ///< m/s, before and after each key
};

/// One key at the start, at each event and at the end. With glTF's cubic
///   p(t) = h00 p_k + d h10 out_k + h01 p_k+1 + d h11 in_k+1,  d = t_k+1 - t_k
/// the tangents are the velocities themselves, and a parabola comes back exactly, as does what rests, rolls or slides
/// along a line. A body that turns about a centre of mass beside its origin, or slides round a bend, gets as many keys
/// between as kCubicTolerance asks for. The functions of this file throw
/// InputError when the body would need more than kMaxKeys.
TranslationKeys cubicKeys(const Motion& motion, int body);
/// Keys at the start, at each event, at the end and as many between as kRotationTolerance asks for.
RotationKeys turnKeys(const Motion& motion, int body);

/// Keys of position and rotation at the same times, to be joined by straight lines and shortest turns: at the start, at
/// each event and at the end, and in every arc at the multiples of 1 / (n fps) with the least whole n for which both
/// stay as near to the motion as asked: kRotationTolerance and min(tolerance, kShareOfRadius * radius). So whole frames
/// have keys of their own. An arc that is straight and does not turn has none between, nor has a rest.
struct FrameKeys {
  TranslationKeys moves;
  RotationKeys turns;
};
FrameKeys frameKeys(const Motion& motion, int body, double fps, double tolerance);

}  // namespace carom::formats_detail
