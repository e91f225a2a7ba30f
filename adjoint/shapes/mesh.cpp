#include "adjoint/shapes/kinds.h"
#include "adjoint/shapes/scaled_surface.h"

namespace carom::shapes {
namespace {

const Mesh& get(const Shape& s) { return std::get<Mesh>(s); }

}  // namespace

ShapeKind meshKind() {
  return {"mesh",
          [](const Shape&) { return std::vector<std::string>{"scale"}; },
          [](const Shape& s) { return dimensionsOf({get(s).scale}); },
          [](Shape& s, const Eigen::VectorXd& d) { std::get<Mesh>(s).scale = d[0]; },
          [](const Shape& s) { return get(s).surface && get(s).surface->closed; },
          [](const Shape& s) { return scaledProperties(get(s).surface.get(), get(s).scale, "mesh"); },
          [](const Shape& s, const Eigen::VectorXd& rates) {
            return scaledPropertiesRate(get(s).surface.get(), get(s).scale, rates[0], "mesh");
          },
          [](const Shape& s) { return scaledRadius(get(s).surface.get(), get(s).scale); }};
}

}  // namespace carom::shapes
