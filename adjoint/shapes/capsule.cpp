#include <numbers>

#include "adjoint/shapes/kinds.h"

namespace carom::shapes {
namespace {

const Capsule& get(const Shape& s) { return std::get<Capsule>(s); }

// A cylinder and two half balls. With w = h + 4r/3:
//   V   = pi r^2 w
//   I_z = (h r^2/2 + 8 r^3/15) / w
//   I_x = I_y = (h^3/12 + h^2 r/3 + 3 h r^2/4 + 8 r^3/15) / w
SolidProperties properties(const Shape& s) {
  constexpr double pi = std::numbers::pi;
  const double r = get(s).radius, h = get(s).height, w = h + 4 * r / 3;
  const double z = r * r * (h / 2 + 8 * r / 15) / w;
  const double x = (h * h * (h / 12 + r / 3) + r * r * (3 * h / 4 + 8 * r / 15)) / w;
  SolidProperties p;
  p.volume = pi * r * r * w;
  p.unit_inertia = diagonal(x, x, z);

  // (numerator / w)' = (numerator' - quotient w') / w
  const double z_r = (r * (h + 8 * r / 5) - z * 4 / 3) / w, z_h = (r * r / 2 - z) / w;
  const double x_r = (h * h / 3 + r * (3 * h / 2 + 8 * r / 5) - x * 4 / 3) / w;
  const double x_h = (h * h / 4 + 2 * h * r / 3 + 3 * r * r / 4 - x) / w;
  p.rates = {{2 * pi * r * (h + 2 * r), Vec3::Zero(), diagonal(x_r, x_r, z_r)},
             {pi * r * r, Vec3::Zero(), diagonal(x_h, x_h, z_h)}};
  return p;
}

}  // namespace

ShapeKind capsuleKind() {
  return {"capsule",
          [](const Shape&) {
            return std::vector<std::string>{"radius", "height"};
          },
          [](const Shape& s) {
            return dimensionsOf({get(s).radius, get(s).height});
          },
          [](Shape& s, const Eigen::VectorXd& d) {
            std::get<Capsule>(s).radius = d[0];
            std::get<Capsule>(s).height = d[1];
          },
          alwaysSolid,
          properties,
          [](const Shape& s) { return get(s).radius + get(s).height / 2; }};
}

}  // namespace carom::shapes
