// SPDX-License-Identifier: MIT
#include <numbers>

#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

struct SphereRow {
  using Kind = Sphere;
  static constexpr const char* name = "sphere";
  static constexpr std::array words{"radius"};
  static auto numbers(auto& s) { return std::tie(s.radius); }

  // V = 4/3 pi r^3, I = 2/5 r^2 about every axis
  template <class S>
  static SolidPropertiesOf<S> solid(const Sphere&, const std::array<S, 1>& numbers) {
    constexpr double pi = std::numbers::pi;
    const auto& [r] = numbers;
    const S I = 0.4 * r * r, I_r = 0.8 * r;
    SolidPropertiesOf<S> p;
    p.volume = 4.0 / 3.0 * pi * r * r * r;
    p.unit_inertia = diagonal<S>(I, I, I);
    p.rates = {{4 * pi * r * r, V3<S>::Zero(), diagonal<S>(I_r, I_r, I_r)}};
    return p;
  }
  static double outer(const Sphere& s) { return s.radius; }
  static double inner(const Sphere& s) { return s.radius; }
  static FarthestPoint farthest(const Sphere& s, const Vec3&) {
    FarthestPoint p = FarthestPoint::at(Vec3::Zero(), 1);
    p.ball = s.radius, p.ball_rates[0] = 1;
    return p;
  }
};

}  // namespace

ShapeKind kindRow(KindOf<Sphere>) { return sizedRow<SphereRow>(); }

}  // namespace carom::shapes
