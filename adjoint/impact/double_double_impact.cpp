// SPDX-License-Identifier: MIT
#include "adjoint/impact/double_double_impact.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/impact/double_double_pass.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr double kDoublesSpan = 1e3;

}  // namespace

bool needsDoubleDouble(const Event& event, const std::vector<BodyModel>& models) {
  const bool single = event.contacts.size() == 1;
  if (single && lawOf(event.contacts[0].pair) == Law::frictionless) return false;
  double least = kInfinity, most = 0, lightest = 0;
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    if (model.kinematic || p.stays) continue;
    if (!std::isfinite(model.inverse_mass)) return false;  // no number of digits helps
    double reach = 0;
    for (const Contact& c : event.contacts)
      if (c.a == p.body || c.b == p.body) reach = std::max(reach, (c.at.point - p.before.x).squaredNorm());
    least = std::min({least, model.inverse_mass, reach * model.inverse_inertia.minCoeff()});
    most = std::max({most, model.inverse_mass, reach * model.inverse_inertia.maxCoeff()});
    lightest = std::max(lightest, model.inverse_mass);
  }
  // one contact has at least the mobility of the lighter body in every direction
  return most > kDoublesSpan * (single ? lightest : least);
}

template adjoint_detail::ImpactOutcome<double> adjoint_detail::doubleDoubleImpact(const ImpactInputs<double>&);
template adjoint_detail::ImpactBars<double> adjoint_detail::doubleDoubleImpactPullback(const ImpactInputs<double>&,
                                                                               const std::vector<StateDerivative>&);

}  // namespace carom::adjoint_detail
