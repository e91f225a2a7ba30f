// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/solid.hpp"

namespace carom::ode_bridge_detail {

// By dimension c the point moves with the part, axes * (stretch o local), and all of it against the centre of mass.
FeatureRates ratesOf(const Solid& solid, const Feature& feature) {
  FeatureRates rates;
  rates.point = -solid.center_rates;
  rates.radius.setZero(solid.center_rates.cols());
  rates.rim.setZero(solid.center_rates.cols());
  if (feature.apex > 0) rates.apex.setZero(solid.center_rates.cols());
  const Part& part = solid.parts[static_cast<std::size_t>(feature.part)];
  const Vec3 local = part.axes.transpose() * (feature.point - part.origin);
  for (std::size_t k = 0; k < part.stretches.size(); ++k) {
    const Part::Stretch& s = part.stretches[k];
    const auto c = static_cast<Eigen::Index>(part.first_dimension) + static_cast<Eigen::Index>(k);
    rates.point.col(c) += part.axes * s.stretch.cwiseProduct(local);
    if (feature.radius > 0) rates.radius[c] = s.swept;
    if (feature.rim > 0) rates.rim[c] = s.rim;
    if (feature.apex > 0) rates.apex[c] = s.apex;
  }
  return rates;
}

Eigen::Matrix3Xd pointRatesRate(const Solid& solid, const Eigen::VectorXd& dimension_rates) {
  Eigen::Matrix3Xd rates(3, 0);
  if (!solid.uneven || dimension_rates.size() == 0 || dimension_rates.isZero(0)) return rates;
  const SolidProperties change = kindOf(*solid.uneven).propertiesRate(*solid.uneven, dimension_rates);
  rates.resize(3, solid.center_rates.cols());
  for (std::size_t d = 0; d < change.rates.size(); ++d)
    rates.col(static_cast<Eigen::Index>(d)) = -change.rates[d].center;
  return rates;
}

}  // namespace carom::ode_bridge_detail
