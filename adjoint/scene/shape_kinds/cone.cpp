// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

struct ConeRow {
  using Kind = Cone;
  static constexpr const char* name = "cone";
  static constexpr std::array words{"radius", "height"};
  static auto numbers(auto& s) { return std::tie(s.radius, s.height); }

  // V = pi r^2 h/3, c = -h/4 along z, and about c: I_x = I_y = 3 (4 r^2 + h^2)/80, I_z = 3 r^2/10
  template <class S>
  static SolidPropertiesOf<S> solid(const Cone&, const std::array<S, 2>& numbers) {
    constexpr double pi = std::numbers::pi;
    const auto& [r, h] = numbers;
    const S x = 3 * (4 * r * r + h * h) / 80;
    SolidPropertiesOf<S> p;
    p.volume = pi * r * r * h / 3;
    p.center = V3<S>(0, 0, -h / 4);
    p.unit_inertia = diagonal<S>(x, x, 3 * r * r / 10);
    p.rates = {{2 * pi * r * h / 3, V3<S>::Zero(), diagonal<S>(3 * r / 10, 3 * r / 10, 3 * r / 5)},
               {pi * r * r / 3, V3<S>(0, 0, -0.25), diagonal<S>(3 * h / 40, 3 * h / 40, 0)}};
    return p;
  }
  static double outer(const Cone& s) { return elementary::hypot(s.radius, s.height / 2); }
  // the side is the nearer: (h/2) r/sqrt(r^2 + h^2)
  static double inner(const Cone& s) { return 0.5 * s.height * (s.radius / elementary::hypot(s.radius, s.height)); }
  static FarthestPoint farthest(const Cone& s, const Vec3& n) {
    FarthestPoint apex = FarthestPoint::at({0, 0, 0.5 * s.height}, 2);
    FarthestPoint base = FarthestPoint::at({0, 0, -0.5 * s.height}, 2);
    base.rim = s.radius, base.rim_rates[0] = 1;
    apex.corner_rates(2, 1) = 0.5, base.corner_rates(2, 1) = -0.5;
    const double further = apex.reach(n) - base.reach(n);
    apex.margin = further;
    base.margin = std::min(-further, 2 * s.radius * base.across(n).norm());
    return further > 0 ? apex : base;
  }
};

}  // namespace

ShapeKind kindRow(KindOf<Cone>) { return sizedRow<ConeRow>(); }

}  // namespace carom::shapes
