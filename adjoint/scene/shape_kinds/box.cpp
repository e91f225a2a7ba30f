// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

struct BoxRow {
  using Kind = Box;
  static constexpr const char* name = "box";
  static constexpr std::array words{"x", "y", "z"};
  static auto numbers(auto& s) { return std::tie(s.size[0], s.size[1], s.size[2]); }

  // V = x y z, I_x = (y^2 + z^2)/12 and so on
  template <class S>
  static SolidPropertiesOf<S> solid(const Box&, const std::array<S, 3>& size) {
    const auto& [x, y, z] = size;
    SolidPropertiesOf<S> p;
    p.volume = x * y * z;
    p.unit_inertia = diagonal<S>((y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12);
    p.rates = {{y * z, V3<S>::Zero(), diagonal<S>(0, x / 6, x / 6)},
               {x * z, V3<S>::Zero(), diagonal<S>(y / 6, 0, y / 6)},
               {x * y, V3<S>::Zero(), diagonal<S>(z / 6, z / 6, 0)}};
    return p;
  }
  static double outer(const Box& s) { return 0.5 * s.size.norm(); }
  static double inner(const Box& s) { return 0.5 * s.size.minCoeff(); }
  static FarthestPoint farthest(const Box& s, const Vec3& n) {
    FarthestPoint p = FarthestPoint::at(Vec3::Zero(), 3);
    for (int i = 0; i < 3; ++i) {
      p.corner_rates(i, i) = n[i] < 0 ? -0.5 : 0.5;
      p.corner[i] = p.corner_rates(i, i) * s.size[i];
    }
    p.margin = n.cwiseAbs().cwiseProduct(s.size).minCoeff();
    return p;
  }
};

}  // namespace

ShapeKind kindRow(KindOf<Box>) {
  ShapeKind row = sizedRow<BoxRow>();
  row.check = [](const Shape& s, const validation::ShapeCheck& at) {
    for (int i = 0; i < 3; ++i) validation::requireLength(at.where / "size" / i, as<Box>(s).size[i]);
  };
  return row;
}

}  // namespace carom::shapes
