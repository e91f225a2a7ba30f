#pragma once

#include <string>

#include "formats/detail/svg_view.hpp"

namespace carom {

/// SVG path data of a shape in a view; empty where there is nothing to draw.
struct Silhouette {
  std::string area;     ///< closed; filled by the non-zero rule it is what the shape covers
  std::string outline;  ///< the border of the area; empty when it is `area` itself
  std::string edges;    ///< lines within it that the viewer sees
};

/// Of any shape but a plane, at the pose x, q.
Silhouette silhouetteOf(const Shape& shape, const Vec3& x, const Quat& q, const View& view);

}  // namespace carom
