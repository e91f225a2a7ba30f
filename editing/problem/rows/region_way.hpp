// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "editing/problem/rows/polynomial.hpp"
#include "editing/problem/rows/region_rows.hpp"

/// Where a body comes nearest to a region on one arc of its way.
namespace carom::editing_detail {

/// A stretch of an arc, s seconds after `start`, seen from the region: y(s) by components.
struct Stretch {
  std::array<Polynomial<2>, 3> y{};
  Mat3 R;            ///< region to world
  double start = 0, lo = 0, hi = 0;

  Vec3 placeAt(double s) const { return {valueAt<2>(y[0], s), valueAt<2>(y[1], s), valueAt<2>(y[2], s)}; }
  Vec3 velocityAt(double s) const {
    Vec3 v;
    for (std::size_t k = 0; k < 3; ++k) v[static_cast<Eigen::Index>(k)] = valueAt<1>(derivativeOf<2>(y[k]), s);
    return v;
  }
  Polynomial<4> squaredDistance() const {
    Polynomial<4> sum{};
    for (const Polynomial<2>& p : y)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) sum[i + j] += p[i] * p[j];
    return sum;
  }
};

/// A clearance on the way, and its gradient with respect to the place in the axes of the region.
struct PlaceOnWay {
  double value = std::numeric_limits<double>::infinity();
  double s = 0;  ///< after the start of the stretch
  Vec3 gradient = Vec3::Zero();
  double bend = 0;              ///< second derivative across the gradient, the same in both directions
  Vec3 between = Vec3::Zero();  ///< of two faces: difference of their normals
  double time = 0;
  bool first = false, last = false;  ///< at an end of the span
};

/// The parabola that an arc follows at a time, over [from, to].
Stretch stretchAround(const Arc& arc, const Region& region, double at, double from, double to);
/// The least clearance of a stretch.
PlaceOnWay least(const Stretch& stretch, const BoundRegion& bound, int component);
/// The least clearance on an arc over [from, to]: of a flight, and of a path along a line, in closed form; of a slide
/// round a bend to rounding, with no lower one elsewhere by more than 1e-13 of the distances.
PlaceOnWay leastOnArc(const Arc& arc, const BoundRegion& bound, int component, double from, double to);
/// Of the centre of mass.
Vec3 accelerationAt(const Arc& arc, double t);

}  // namespace carom::editing_detail
