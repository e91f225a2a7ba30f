// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/shape_kinds/scaled_surface.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

std::string borderOf(const Surface& s) {
  for (const Surface::Edge& e : s.edges)
    if (e.right < 0)
      return "the edge from " + validation::text(s.vertices[static_cast<std::size_t>(e.from)]) + " to " +
             validation::text(s.vertices[static_cast<std::size_t>(e.to)]) + " has one triangle";
  return "its surface does not close";
}

void checkMesh(const Shape& shape, const validation::ShapeCheck& at) {
  const Mesh& s = as<Mesh>(shape);
  if (!s.surface) validation::fail(at.where, "no surface", "one made by meshSurface");
  if (s.surface->faces.empty()) validation::fail(at.where, "no triangles", "a triangle or more");
  requireScale(at, s.scale, *s.surface);
  if (at.derived && !s.surface->closed)
    validation::fail(at.where, "an open mesh (" + borderOf(*s.surface) + ") on a moving body, whose " + at.derived,
                     "a closed mesh, or \"mass\" and \"inertia\" both written, or \"fixed\": true");
}

}  // namespace

ShapeKind kindRow(KindOf<Mesh>) {
  return {
      .name = "mesh",
      .check = checkMesh,
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"scale"}; },
      .dimensions = [](const Shape& s) { return dimensionsOf({as<Mesh>(s).scale}); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 1);
            std::get<Mesh>(s).scale = d[0];
          },
      .solid = [](const Shape& s) { return as<Mesh>(s).surface && as<Mesh>(s).surface->closed; },
      .properties =
          [](const Shape& s) { return scaledProperties(as<Mesh>(s).surface.get(), as<Mesh>(s).scale, "mesh"); },
      .propertiesRate =
          [](const Shape& s, const Eigen::VectorXd& rates) {
            requireDimensions(rates, 1);
            return scaledPropertiesRate(as<Mesh>(s).surface.get(), as<Mesh>(s).scale, rates[0], "mesh");
          },
      .boundingRadius = [](const Shape& s) { return scaledRadius(as<Mesh>(s).surface.get(), as<Mesh>(s).scale); },
      .innerRadius = [](const Shape&) { return 0.0; },
  };
}

}  // namespace carom::shapes
