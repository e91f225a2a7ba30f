// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "adjoint/scene/scene.h"
#include "formats/svg/canvas.hpp"
#include "formats/svg/view.hpp"

namespace carom::formats_detail {

struct ShapeLook {
  std::string fill, stroke;
  double stroke_width = 1.2;
  double fill_opacity = 1;
};

/// How much of a shape is drawn.
enum class ShapeDetail { edges, area, hull };

/// Draws a body at a pose; whether there is anything to draw (a plane has no outline unless it is seen from its edge).
bool drawShape(SvgCanvas& canvas, const View& view, const Body& body, const Vec3& x, const Quat& q,
               const ShapeLook& look, ShapeDetail detail = ShapeDetail::edges);

}  // namespace carom::formats_detail
