// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/svg/view.hpp"

namespace carom::formats_detail {

/// SVG path data of a shape in a view; empty where there is nothing to draw.
struct Silhouette {
  std::string area;     ///< closed; filled by the non-zero rule it is what the shape covers
  std::string outline;  ///< the border of the area; empty when it is `area` itself
  std::string edges;    ///< lines within it that the viewer sees
};

/// Of any shape but a plane, at the pose x, q.
Silhouette silhouetteOf(const Shape& shape, const Vec3& x, const Quat& q, const View& view);
/// The area alone, its border off by at most `tolerance` pixels; holes and parts smaller than that are left out.
std::string silhouetteArea(const Shape& shape, const Vec3& x, const Quat& q, const View& view, double tolerance);
/// The convex hull of the area, which takes few characters whatever the shape.
std::string silhouetteHull(const Shape& shape, const Vec3& x, const Quat& q, const View& view, double tolerance);

}  // namespace carom::formats_detail
