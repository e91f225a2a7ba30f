// SPDX-License-Identifier: MIT
// Private to formats/*.cpp. What the rows of several shapes are made of.
#pragma once

#include "adjoint/scene/shape.h"
#include "formats/base/extent.hpp"
#include "formats/json/json.hpp"

namespace carom::formats_detail {

struct ColliderAdder;
class JsonWriter;

}  // namespace carom::formats_detail

namespace carom::shapes {

using namespace formats_detail;

struct ShapePose;

inline Extent extentAround(const Vec3& middle, const Vec3& half) { return Extent(middle - half, middle + half); }
/// A disc with the unit normal a reaches r sqrt(1 - a_i^2) along axis i.
inline Vec3 reachOfDisc(double radius, const Vec3& normal) {
  return radius * (1 - normal.array().square()).max(0).sqrt().matrix();
}

// Of the vertices of a surface at a scale.
Extent surfaceExtent(const Surface& surface, double scale, const ShapePose& at);
double surfaceRadius(const Surface& surface, double scale, const Vec3& point);

// The members "radius" and "height", and "scale", which is left out where it is 1.
double numberOf(const Json& value, const char* member);
void writeRound(JsonWriter& out, double radius, double height);
double scaleOf(const Json& value);
void writeScale(JsonWriter& out, double scale);

}  // namespace carom::shapes
