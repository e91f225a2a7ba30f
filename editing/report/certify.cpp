// SPDX-License-Identifier: MIT
#include "editing/report/certify.hpp"

#include <algorithm>

#include "editing/detail/messages.hpp"
#include "editing/problem/jacobian.hpp"
#include "editing/report/event_margins.hpp"
#include "editing/report/motion_checks.hpp"

namespace carom::editing_detail {
namespace {

/// The instants at which targets are read, and the last one of all, up to which every impact counts. What a region
/// keeps clear of is read where it is nearest, and does not jump. Impacts that are held must not come after the end.
std::vector<ReadInstant> instantsOf(const EditProblem& problem, const RowValues& rows, double last) {
  std::vector<ReadInstant> instants;
  bool at_impact = false;
  const auto add = [&](int body, double time) {
    const auto known = std::find_if(instants.begin(), instants.end(),
                                    [&](const ReadInstant& i) { return i.body == body && i.time == time; });
    if (known == instants.end()) instants.push_back({body, time, false});
  };
  for (int i = 0; i < problem.constraints.size(); ++i) {
    if (problem.constraints.rows()[static_cast<std::size_t>(i)].overSpan()) continue;
    for (const StateSeed& seed : rows.seeds[static_cast<std::size_t>(i)]) {
      if (seed.at.event >= 0) {
        at_impact = true;
        continue;
      }
      add(seed.at.time == last ? -1 : seed.body, seed.at.time);
    }
  }
  if (at_impact) instants.push_back({-1, problem.duration, true});
  return instants;
}

void predictSignature(const EditProblem& problem, const Eigen::VectorXd& unknowns, DerivativeTape& tape,
                      const RowValues& rows, Certificate& certificate) {
  const Eigen::VectorXd changes = unknowns.head(problem.controls.size());
  const Eigen::VectorXd values = problem.controls.valuesOf(changes), rates = problem.controls.valueRates(changes);
  const auto byChanges = [&](const SceneGradient& gradient) {
    return Eigen::VectorXd(problem.controls.gather(gradient, values).cwiseProduct(rates));
  };
  const ConstraintSet::Extent extent = problem.constraints.extentIn(tape.motion(), rows.times);
  const std::vector<EventMargin> margins =
      eventMargins(tape, std::min(extent.events, kMarginEvents), instantsOf(problem, rows, extent.time), byChanges);
  const EventMargin* nearest = nullptr;
  for (const EventMargin& margin : margins) {
    if (!(margin.distance() < certificate.signature_radius)) continue;
    certificate.signature_radius = margin.distance();
    nearest = &margin;
  }
  if (!nearest) return;
  certificate.signature_step = -nearest->value / nearest->gradient.squaredNorm() * nearest->gradient;
  std::string text = nearest->what;
  text[0] = 'T';
  certificate.signature_event = text + " at a change of " + brief(certificate.signature_radius) + ".";
}

}  // namespace

Certificate certify(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                    const RowValues& rows) {
  Certificate certificate;
  certificate.taken = true;
  certificate.energy_drift = energyDrift(motion, kEnergySamples);
  certificate.energy_gain = energyGain(motion);
  certificate.deepest_penetration = deepestPenetration(motion, kOverlapSamples);
  if (motion.world_lines.size() > kMarginBodies) {
    certificate.signature_radius = std::numeric_limits<double>::quiet_NaN();
    certificate.signature_event = "Not predicted: there are more than " + std::to_string(kMarginBodies) + " bodies.";
    return certificate;
  }
  DerivativeTape tape(motion);
  predictSignature(problem, unknowns, tape, rows, certificate);
  return certificate;
}

}  // namespace carom::editing_detail
