// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/errors.h"
#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

/// Largest distance of a vertex from the origin, times s.
double scaledRadius(const Surface* surface, double scale);

/// The vertex that is farthest along n, at a scale.
FarthestPoint farthestVertex(const Surface* surface, double scale, const Vec3& n);

/// Throws InputError unless the scale is positive and keeps the surface within the sizes that can be computed with.
void requireScale(const validation::ShapeCheck& at, double scale, const Surface& surface);

/// What the rows of hull and mesh say alike: of a surface at a scale.
template <class T>
struct ScaledRow {
  using Kind = T;
  static constexpr std::array words{"scale"};
  static auto numbers(auto& s) { return std::tie(s.scale); }

  // V = s^3 V_1, c = s c_1, I = s^2 I_1
  template <class S>
  static SolidPropertiesOf<S> solid(const T& shape, const std::array<S, 1>& numbers) {
    if (!hasVolume(shape))
      throw InputError(std::string("found a ") + kindOf(shape).name +
                       (shape.surface ? " that is open" : " without surface") + ", which has no mass properties, expected a closed one");
    const Surface& surface = *shape.surface;
    const auto& [s] = numbers;
    SolidPropertiesOf<S> p;
    p.volume = s * s * s * surface.volume;
    p.center = s * surface.center;
    p.unit_inertia = s * s * surface.unit_inertia;
    p.rates = {{3 * s * s * surface.volume, surface.center.template cast<S>(), 2 * s * surface.unit_inertia}};
    return p;
  }
  static bool hasVolume(const T& s) { return s.surface && s.surface->closed; }
  static double outer(const T& s) { return scaledRadius(s.surface.get(), s.scale); }
  static double inner(const T&) { return 0; }
  static FarthestPoint farthest(const T& s, const Vec3& n) { return farthestVertex(s.surface.get(), s.scale, n); }
};

template <class Row>
ShapeKind scaledRow(void (*check)(const Shape&, const validation::ShapeCheck&)) {
  ShapeKind row = sizedRow<Row>();
  row.check = check;
  row.solid = [](const Shape& s) { return Row::hasVolume(as<typename Row::Kind>(s)); };
  return row;
}

}  // namespace carom::shapes
