#pragma once

#include <vector>

#include "adjoint/motion.h"

namespace carom {

/// Rotation keys are so dense that the shortest turn from key to key stays this near to the motion, in radians.
inline constexpr double kRotationTolerance = 1e-3;

/// Keys of one body, times strictly increasing as floats (glTF stores floats, and equal times are not allowed).
struct TranslationKeys {
  std::vector<float> times;
  std::vector<Vec3> values;
  std::vector<Vec3> in_tangents, out_tangents;  ///< m/s, before and after each key
};
struct RotationKeys {
  std::vector<float> times;
  std::vector<Quat> values;  ///< neighbours in one hemisphere
};

/// One key at the start, at each impact and at the end. With glTF's cubic
///   p(t) = h00 p_k + d h10 out_k + h01 p_k+1 + d h11 in_k+1,  d = t_k+1 - t_k
/// the tangents are the velocities themselves, and a parabola comes back exactly.
TranslationKeys splineKeys(const Motion& motion, int body);

/// One key a frame (k / fps) and one at the start, at each impact and at the end, to be joined by straight lines.
TranslationKeys frameKeys(const Motion& motion, int body, double fps);

/// Keys at the start, at each impact, at the end, at each frame when fps > 0, and as many between as kRotationTolerance
/// asks for. Throws InputError when the body spins so fast that these would be more than kMaxRotationKeys.
inline constexpr double kMaxRotationKeys = 2e6;
RotationKeys rotationKeys(const Motion& motion, int body, double fps = 0);

}  // namespace carom
