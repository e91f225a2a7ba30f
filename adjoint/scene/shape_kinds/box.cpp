// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

const Vec3& size(const Shape& s) { return std::get<Box>(s).size; }

// V = x y z, I_x = (y^2 + z^2)/12 and so on
SolidProperties boxProperties(const Shape& s) {
  const double x = size(s).x(), y = size(s).y(), z = size(s).z();
  SolidProperties p;
  p.volume = x * y * z;
  p.unit_inertia = diagonal((y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12);
  p.rates = {{y * z, Vec3::Zero(), diagonal(0, x / 6, x / 6)},
             {x * z, Vec3::Zero(), diagonal(y / 6, 0, y / 6)},
             {x * y, Vec3::Zero(), diagonal(z / 6, z / 6, 0)}};
  return p;
}

SolidProperties boxPropertiesRate(const Shape& s, const Eigen::VectorXd& d) {
  requireDimensions(d, 3);
  const double x = size(s).x(), y = size(s).y(), z = size(s).z(), dx = d[0], dy = d[1], dz = d[2];
  SolidProperties p;
  p.volume = dx * y * z + x * dy * z + x * y * dz;
  p.unit_inertia = diagonal((y * dy + z * dz) / 6, (x * dx + z * dz) / 6, (x * dx + y * dy) / 6);
  p.rates = {{dy * z + y * dz, Vec3::Zero(), diagonal(0, dx / 6, dx / 6)},
             {dx * z + x * dz, Vec3::Zero(), diagonal(dy / 6, 0, dy / 6)},
             {dx * y + x * dy, Vec3::Zero(), diagonal(dz / 6, dz / 6, 0)}};
  return p;
}

}  // namespace

ShapeKind kindRow(KindOf<Box>) {
  return {
      .name = "box",
      .check =
          [](const Shape& s, const validation::ShapeCheck& at) {
            for (int i = 0; i < 3; ++i) validation::requireLength(at.where / "size" / i, size(s)[i]);
          },
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"x", "y", "z"}; },
      .dimensions = [](const Shape& s) { return Eigen::VectorXd(size(s)); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 3);
            std::get<Box>(s).size = d.head<3>();
          },
      .solid = alwaysSolid,
      .properties = boxProperties,
      .propertiesRate = boxPropertiesRate,
      .boundingRadius = [](const Shape& s) { return 0.5 * size(s).norm(); },
      .innerRadius = [](const Shape& s) { return 0.5 * size(s).minCoeff(); },
  };
}

}  // namespace carom::shapes
