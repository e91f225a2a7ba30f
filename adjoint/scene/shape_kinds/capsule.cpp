// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

struct CapsuleRow {
  using Kind = Capsule;
  static constexpr const char* name = "capsule";
  static constexpr std::array words{"radius", "height"};
  static auto numbers(auto& s) { return std::tie(s.radius, s.height); }

  // A cylinder and two half balls. With w = h + 4r/3:
  //   V   = pi r^2 w
  //   I_z = (h r^2/2 + 8 r^3/15) / w
  //   I_x = I_y = (h^3/12 + h^2 r/3 + 3 h r^2/4 + 8 r^3/15) / w
  template <class S>
  static SolidPropertiesOf<S> solid(const Capsule&, const std::array<S, 2>& numbers) {
    constexpr double pi = std::numbers::pi;
    const auto& [r, h] = numbers;
    const S w = h + 4 * r / 3;
    const S z = r * r * (h / 2 + 8 * r / 15) / w;
    const S x = (h * h * (h / 12 + r / 3) + r * r * (3 * h / 4 + 8 * r / 15)) / w;
    // (numerator / w)' = (numerator' - quotient w') / w
    const S z_r = (r * (h + 8 * r / 5) - z * 4 / 3) / w, z_h = (r * r / 2 - z) / w;
    const S x_r = (h * h / 3 + r * (3 * h / 2 + 8 * r / 5) - x * 4 / 3) / w;
    const S x_h = (h * h / 4 + 2 * h * r / 3 + 3 * r * r / 4 - x) / w;
    SolidPropertiesOf<S> p;
    p.volume = pi * r * r * w;
    p.unit_inertia = diagonal<S>(x, x, z);
    p.rates = {{2 * pi * r * (h + 2 * r), V3<S>::Zero(), diagonal<S>(x_r, x_r, z_r)},
               {pi * r * r, V3<S>::Zero(), diagonal<S>(x_h, x_h, z_h)}};
    return p;
  }
  static double outer(const Capsule& s) { return s.radius + s.height / 2; }
  static double inner(const Capsule& s) { return s.radius; }
  static FarthestPoint farthest(const Capsule& s, const Vec3& n) {
    const double end = n.z() < 0 ? -0.5 : 0.5;
    FarthestPoint p = FarthestPoint::at({0, 0, end * s.height}, 2);
    p.ball = s.radius, p.ball_rates[0] = 1;
    p.corner_rates(2, 1) = end;
    p.margin = std::abs(n.z()) * s.height;
    return p;
  }
};

}  // namespace

ShapeKind kindRow(KindOf<Capsule>) { return sizedRow<CapsuleRow>(); }

}  // namespace carom::shapes
