// SPDX-License-Identifier: MIT
#include "adjoint/constrained/border_rate.hpp"

namespace carom::adjoint_detail {

ConstrainedLanes::Number borderRateOf(const FeatureLimit& limit, const V3<ConstrainedLanes::Number>& x, const M3<ConstrainedLanes::Number>& R,
                                      SizeLanes sizes, const V3<ConstrainedLanes::Number>& p, const V3<ConstrainedLanes::Number>& n) {
  using Number = ConstrainedLanes::Number;
  V3<Number> border = limit.border.cast<Number>(), normal_weight = limit.normal_weight.cast<Number>();
  for (int i = 0; i < sizes.count; ++i) {
    const int lane = sizes.first + i;
    if (lane < 0 || lane >= ConstrainedLanes::kColumns) continue;
    const auto at = static_cast<std::size_t>(lane);
    if (limit.border_rates.cols() > 0) setRates(border, Vec3(limit.border_rates.col(i)), at);
    if (limit.normal_rates.cols() > 0) setRates(normal_weight, Vec3(limit.normal_rates.col(i)), at);
  }
  const V3<Number> at = R.transpose() * V3<Number>(p - x);
  Number value = 0;
  if (limit.radius > 0) {  // the border is where the weight pointed at the start; the circle's centre stays
    const Vec3 center = limit.border + limit.radius * limit.point_weight;
    const V3<Number> to = at - center.cast<Number>(), axis = limit.axis.cast<Number>();
    const V3<Number> across = to - axis * axis.dot(to);
    value = -sqrt(across.squaredNorm());
    const V3<Number> outward = V3<Number>(border - limit.border.cast<Number>());  // how border and centre move
    value += outward.dot(V3<Number>(-limit.point_weight.cast<Number>()));
  } else if (!limit.point_weight.isZero(0)) {
    value = limit.point_weight.cast<Number>().dot(V3<Number>(at - border));
  }
  return value + normal_weight.dot(V3<Number>(R.transpose() * n));
}

}  // namespace carom::adjoint_detail
