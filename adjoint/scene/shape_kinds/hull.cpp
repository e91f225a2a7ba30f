// SPDX-License-Identifier: MIT
#include "adjoint/scene/shapes/kinds.hpp"
#include "adjoint/scene/shapes/scaled_surface.hpp"

namespace carom::shapes {
namespace {

}  // namespace

ShapeKind hullKind() {
  return {"hull",
          [](const Shape&) { return std::vector<std::string>{"scale"}; },
          [](const Shape& s) { return dimensionsOf({as<Hull>(s).scale}); },
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 1);
            std::get<Hull>(s).scale = d[0];
          },
          [](const Shape& s) { return as<Hull>(s).surface && as<Hull>(s).surface->closed; },
          [](const Shape& s) { return scaledProperties(as<Hull>(s).surface.get(), as<Hull>(s).scale, "hull"); },
          [](const Shape& s, const Eigen::VectorXd& rates) {
            requireDimensions(rates, 1);
            return scaledPropertiesRate(as<Hull>(s).surface.get(), as<Hull>(s).scale, rates[0], "hull");
          },
          [](const Shape& s) { return scaledRadius(as<Hull>(s).surface.get(), as<Hull>(s).scale); }};
}

}  // namespace carom::shapes
