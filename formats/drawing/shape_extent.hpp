// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/shape.h"
#include "formats/base/extent.hpp"

namespace carom::formats_detail {

/// Smallest axis-aligned box around a shape at a pose (origin x, shape axes to world q); empty for a plane.
Extent shapeExtent(const Shape& shape, const Vec3& x, const Quat& q);

/// Radius of the smallest ball about a point of the shape's axes that holds the shape; infinite for a plane.
double radiusAbout(const Shape& shape, const Vec3& point);

}  // namespace carom::formats_detail
