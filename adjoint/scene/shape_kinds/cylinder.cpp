// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

struct CylinderRow {
  using Kind = Cylinder;
  static constexpr const char* name = "cylinder";
  static constexpr std::array words{"radius", "height"};
  static auto numbers(auto& s) { return std::tie(s.radius, s.height); }

  // V = pi r^2 h, I_x = I_y = r^2/4 + h^2/12, I_z = r^2/2
  template <class S>
  static SolidPropertiesOf<S> solid(const Cylinder&, const std::array<S, 2>& numbers) {
    constexpr double pi = std::numbers::pi;
    const auto& [r, h] = numbers;
    const S x = r * r / 4 + h * h / 12;
    SolidPropertiesOf<S> p;
    p.volume = pi * r * r * h;
    p.unit_inertia = diagonal<S>(x, x, r * r / 2);
    p.rates = {{2 * pi * r * h, V3<S>::Zero(), diagonal<S>(r / 2, r / 2, r)},
               {pi * r * r, V3<S>::Zero(), diagonal<S>(h / 6, h / 6, 0)}};
    return p;
  }
  static double outer(const Cylinder& s) { return elementary::hypot(s.radius, s.height / 2); }
  static double inner(const Cylinder& s) { return std::min(s.radius, 0.5 * s.height); }
  static FarthestPoint farthest(const Cylinder& s, const Vec3& n) {
    const double end = n.z() < 0 ? -0.5 : 0.5;
    FarthestPoint p = FarthestPoint::at({0, 0, end * s.height}, 2);
    p.rim = s.radius, p.rim_rates[0] = 1;
    p.corner_rates(2, 1) = end;
    p.margin = std::min(std::abs(n.z()) * s.height, 2 * s.radius * p.across(n).norm());
    return p;
  }
};

}  // namespace

ShapeKind kindRow(KindOf<Cylinder>) { return sizedRow<CylinderRow>(); }

}  // namespace carom::shapes
