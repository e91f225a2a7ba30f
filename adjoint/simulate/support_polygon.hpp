// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// The convex hull of the contacts that carry a body on a face, seen along its normal.
class SupportPolygon {
 public:
  struct Side {
    int from, to;  // contacts at its ends
    Vec3 inward;   // unit, along the face
  };

  SupportPolygon(const std::vector<const Contact*>& contacts, const Vec3& normal);

  /// In order round the polygon; none where the contacts lie on a line.
  const std::vector<Side>& sides() const { return sides_; }
  const Vec3& pointOf(int contact) const { return points_[static_cast<std::size_t>(contact)]; }
  /// Distance of what is above `point` from the nearest side, m; below 0 outside.
  double roomAround(const Vec3& point) const;

 private:
  std::vector<Vec3> points_;
  std::vector<Side> sides_;
};

}  // namespace carom::adjoint_detail
