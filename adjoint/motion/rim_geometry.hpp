// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/motion/contact_source.h"

namespace carom::adjoint_detail {

/// The rim of a flat round cap that touches a flat face.
struct RimOnFace {
  bool of_first = true;    ///< the rim is of the first body of the pair, the face of the other
  Vec3 center, axis;       ///< m, unit, out of the cap: in the axes of its body
  double radius = 0;       ///< m
  Vec3 normal;             ///< unit, out of the face, in the axes of its body
  FeaturePair features;    ///< of the rim and the face

  /// x = d x N, d the axis and N the normal: as long as the sine of the tilt, along the axis about which it tilts.
  static Vec3 tilt(const Vec3& d, const Vec3& N) { return d.cross(N); }
};

/// What a ContactGeometry may know of rims before faces. Optional, as BodyGeometry. Immutable.
class RimGeometry {
 public:
  virtual ~RimGeometry() = default;
  /// Of a rim on a face, or of a mark, which stands for a rim that lies flat; none for other features.
  virtual std::optional<RimOnFace> rimOnFace(int a, int b, const FeaturePair& f) const = 0;
  /// The number of the rim, or of the rim of the mark, that the first body of the pair, or the second, has in these features.
  virtual std::optional<int> rimOfBody(int a, int b, const FeaturePair& f, bool of_first) const = 0;
};

}  // namespace carom::adjoint_detail
