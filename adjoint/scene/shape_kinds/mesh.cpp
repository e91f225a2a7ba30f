// SPDX-License-Identifier: MIT
#include "adjoint/scene/shapes/kinds.hpp"
#include "adjoint/scene/shapes/scaled_surface.hpp"

namespace carom::shapes {
namespace {

}  // namespace

ShapeKind meshKind() {
  return {"mesh",
          [](const Shape&) { return std::vector<std::string>{"scale"}; },
          [](const Shape& s) { return dimensionsOf({as<Mesh>(s).scale}); },
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 1);
            std::get<Mesh>(s).scale = d[0];
          },
          [](const Shape& s) { return as<Mesh>(s).surface && as<Mesh>(s).surface->closed; },
          [](const Shape& s) { return scaledProperties(as<Mesh>(s).surface.get(), as<Mesh>(s).scale, "mesh"); },
          [](const Shape& s, const Eigen::VectorXd& rates) {
            requireDimensions(rates, 1);
            return scaledPropertiesRate(as<Mesh>(s).surface.get(), as<Mesh>(s).scale, rates[0], "mesh");
          },
          [](const Shape& s) { return scaledRadius(as<Mesh>(s).surface.get(), as<Mesh>(s).scale); }};
}

}  // namespace carom::shapes
