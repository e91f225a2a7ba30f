// SPDX-License-Identifier: MIT
#include "adjoint/scene/shapes/scaled_surface.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"

namespace carom::shapes {

namespace {

void requireClosed(const Surface* surface, const char* kind) {
  if (!surface || !surface->closed)
    throw InputError(std::string("found the mass properties of a ") + kind +
                     (surface ? " that is open" : " without surface") + " asked for, expected a closed one");
}

}  // namespace

SolidProperties scaledProperties(const Surface* surface, double scale, const char* kind) {
  requireClosed(surface, kind);
  SolidProperties p;
  p.volume = scale * scale * scale * surface->volume;
  p.center = scale * surface->center;
  p.unit_inertia = scale * scale * surface->unit_inertia;
  p.rates = {{3 * scale * scale * surface->volume, surface->center, 2 * scale * surface->unit_inertia}};
  return p;
}

SolidProperties scaledPropertiesRate(const Surface* surface, double scale, double rate, const char* kind) {
  requireClosed(surface, kind);
  SolidProperties p;
  p.volume = 3 * scale * scale * rate * surface->volume;
  p.center = rate * surface->center;
  p.unit_inertia = 2 * scale * rate * surface->unit_inertia;
  p.rates = {{6 * scale * rate * surface->volume, Vec3::Zero(), 2 * rate * surface->unit_inertia}};
  return p;
}

double scaledRadius(const Surface* surface, double scale) {
  double largest = 0;
  if (surface)
    for (const Vec3& v : surface->vertices) largest = std::max(largest, v.squaredNorm());
  return scale * std::sqrt(largest);
}

}  // namespace carom::shapes
