// SPDX-License-Identifier: MIT
#include <numbers>

#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

// A cylinder and two half balls. With w = h + 4r/3:
//   V   = pi r^2 w
//   I_z = (h r^2/2 + 8 r^3/15) / w
//   I_x = I_y = (h^3/12 + h^2 r/3 + 3 h r^2/4 + 8 r^3/15) / w
template <class S>
struct Numbers {
  S volume, x, z;
  S volume_r, x_r, z_r, volume_h, x_h, z_h;  // rates by radius and height

  Numbers(const S& r, const S& h) {
    constexpr double pi = std::numbers::pi;
    const S w = h + 4 * r / 3;
    z = r * r * (h / 2 + 8 * r / 15) / w;
    x = (h * h * (h / 12 + r / 3) + r * r * (3 * h / 4 + 8 * r / 15)) / w;
    volume = pi * r * r * w;
    // (numerator / w)' = (numerator' - quotient w') / w
    z_r = (r * (h + 8 * r / 5) - z * 4 / 3) / w, z_h = (r * r / 2 - z) / w;
    x_r = (h * h / 3 + r * (3 * h / 2 + 8 * r / 5) - x * 4 / 3) / w;
    x_h = (h * h / 4 + 2 * h * r / 3 + 3 * r * r / 4 - x) / w;
    volume_r = 2 * pi * r * (h + 2 * r), volume_h = pi * r * r;
  }
};

// `number` picks what is wanted of each.
template <class S, class Pick>
SolidProperties solidOf(const Numbers<S>& n, const Pick& number) {
  SolidProperties p;
  p.volume = number(n.volume);
  p.unit_inertia = diagonal(number(n.x), number(n.x), number(n.z));
  p.rates = {{number(n.volume_r), Vec3::Zero(), diagonal(number(n.x_r), number(n.x_r), number(n.z_r))},
             {number(n.volume_h), Vec3::Zero(), diagonal(number(n.x_h), number(n.x_h), number(n.z_h))}};
  return p;
}

SolidProperties capsuleProperties(const Shape& s) {
  return solidOf(Numbers<double>(as<Capsule>(s).radius, as<Capsule>(s).height), [](double x) { return x; });
}

SolidProperties capsulePropertiesRate(const Shape& s, const Eigen::VectorXd& d) {
  requireDimensions(d, 2);
  using Number = Dual<1>;
  Number r = as<Capsule>(s).radius, h = as<Capsule>(s).height;
  r.rate[0] = d[0], h.rate[0] = d[1];
  return solidOf(Numbers<Number>(r, h), [](const Number& x) { return x.rate[0]; });
}

}  // namespace

ShapeKind kindRow(KindOf<Capsule>) {
  return {
      .name = "capsule",
      .check =
          [](const Shape& s, const validation::ShapeCheck& at) {
            validation::requireLength(at.where / "radius", as<Capsule>(s).radius);
            validation::requireLength(at.where / "height", as<Capsule>(s).height);
          },
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"radius", "height"}; },
      .dimensions = [](const Shape& s) { return dimensionsOf({as<Capsule>(s).radius, as<Capsule>(s).height}); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 2);
            std::get<Capsule>(s) = {.radius = d[0], .height = d[1]};
          },
      .solid = alwaysSolid,
      .properties = capsuleProperties,
      .propertiesRate = capsulePropertiesRate,
      .boundingRadius = [](const Shape& s) { return as<Capsule>(s).radius + as<Capsule>(s).height / 2; },
      .innerRadius = [](const Shape& s) { return as<Capsule>(s).radius; },
  };
}

}  // namespace carom::shapes
