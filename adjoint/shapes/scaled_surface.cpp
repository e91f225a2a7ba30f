#include "adjoint/shapes/scaled_surface.h"

#include <algorithm>
#include <cmath>

#include "adjoint/errors.h"

namespace carom::shapes {

SolidProperties scaledProperties(const Surface* surface, double scale, const char* kind) {
  if (!surface || !surface->closed)
    throw InputError(std::string("found the mass properties of a ") + kind +
                     (surface ? " that is open" : " without surface") + " asked for, expected a closed one");
  SolidProperties p;
  p.volume = scale * scale * scale * surface->volume;
  p.center = scale * surface->center;
  p.unit_inertia = scale * scale * surface->unit_inertia;
  p.rates = {{3 * scale * scale * surface->volume, surface->center, 2 * scale * surface->unit_inertia}};
  return p;
}

double scaledRadius(const Surface* surface, double scale) {
  double largest = 0;
  if (surface)
    for (const Vec3& v : surface->vertices) largest = std::max(largest, v.squaredNorm());
  return scale * std::sqrt(largest);
}

}  // namespace carom::shapes
