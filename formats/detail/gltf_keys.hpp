#pragma once

#include <vector>

#include "adjoint/motion.h"

namespace carom {

/// Rotation keys are so dense that the shortest turn from key to key stays this near to the motion, in radians.
inline constexpr double kRotationTolerance = 1e-3;
/// Translation keys of a body whose centre of mass is not its origin keep the origin this near to its path, in metres.
inline constexpr double kTranslationTolerance = 1e-5;

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
/// the tangents are the velocities themselves, and a parabola comes back exactly. A body that turns about a centre of
/// mass beside its origin gets as many keys between as kTranslationTolerance asks for.
TranslationKeys splineKeys(const Motion& motion, int body);

/// One key a frame (k / fps) and one at the start, at each impact and at the end, to be joined by straight lines.
TranslationKeys frameKeys(const Motion& motion, int body, double fps);

/// Keys at the start, at each impact, at the end, at each frame when fps > 0, and as many between as kRotationTolerance
/// asks for. These functions throw InputError when the body spins so fast that it would need more than
/// kMaxKeys.
inline constexpr double kMaxKeys = 2e6;
RotationKeys rotationKeys(const Motion& motion, int body, double fps = 0);

}  // namespace carom
