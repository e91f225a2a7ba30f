#include "ode_bridge/solids/solid.h"

namespace carom {

// By dimension c the point moves with the part, axes * (stretch o local), and all of it against the centre of mass.
FeatureRates ratesOf(const Solid& solid, const Feature& feature) {
  FeatureRates rates;
  rates.point = -solid.center_rates;
  rates.radius.setZero(solid.center_rates.cols());
  rates.rim.setZero(solid.center_rates.cols());
  const Part& part = solid.parts[static_cast<std::size_t>(feature.part)];
  const Vec3 local = part.axes.transpose() * (feature.point - part.origin);
  for (std::size_t k = 0; k < part.stretches.size(); ++k) {
    const Part::Stretch& s = part.stretches[k];
    const auto c = static_cast<Eigen::Index>(part.first_dimension) + static_cast<Eigen::Index>(k);
    rates.point.col(c) += part.axes * s.stretch.cwiseProduct(local);
    if (feature.radius > 0) rates.radius[c] = s.swept;
    if (feature.rim > 0) rates.rim[c] = s.rim;
  }
  return rates;
}

}  // namespace carom
