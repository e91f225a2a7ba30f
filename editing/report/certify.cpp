// SPDX-License-Identifier: MIT
#include "editing/report/certify.hpp"

#include "editing/detail/messages.hpp"
#include "editing/problem/edit_problem.hpp"
#include "editing/problem/margins/sequence_boundaries.hpp"
#include "editing/report/motion_checks.hpp"

namespace carom::editing_detail {
namespace {

void predictSignature(const EditProblem& problem, const Eigen::VectorXd& unknowns, DerivativeTape& tape,
                      const RowValues& rows, Certificate& certificate) {
  const std::vector<EventMargin> margins = sequenceBoundaries(problem, unknowns, tape, rows, kMarginEvents);
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
  certificate.deepest_penetration = deepestPenetration(motion, kOverlapSamples, [&] { problem.leaveIfAbandoned(); });
  if (motion.world_lines.size() > kMarginBodies) {
    certificate.signature_radius = std::numeric_limits<double>::quiet_NaN();
    certificate.signature_event = "Not predicted: there are more than " + std::to_string(kMarginBodies) + " bodies.";
    return certificate;
  }
  DerivativeTape tape(motion, problem.leaver());
  predictSignature(problem, unknowns, tape, rows, certificate);
  return certificate;
}

}  // namespace carom::editing_detail
