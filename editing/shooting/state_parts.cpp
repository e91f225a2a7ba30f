// SPDX-License-Identifier: MIT
#include "editing/shooting/state_parts.h"

#include <algorithm>

#include "editing/controls/control_families.h"

namespace carom {

std::vector<StateParts> stateParts(const EditProblem& problem, const Motion& motion) {
  const std::vector<BoundControl>& controls = problem.controls.controls();
  const bool friction = std::any_of(controls.begin(), controls.end(), [](const BoundControl& c) {
    return c.kind == &kFrictionControl || c.kind == &kTangentialElasticityControl;
  });
  const std::vector<bool> asks = problem.constraints.asksOrientation();
  std::vector<StateParts> parts(motion.plan.bodies.size());
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const BodyPlan& plan = motion.plan.bodies[b];
    const Body& body = problem.controls.startScene().bodies[b];
    const bool centred = !body.center_of_mass || body.center_of_mass->isZero(0);
    // A ball looks the same from all sides.
    const bool round = std::holds_alternative<Sphere>(body.shape) && centred && plan.derivative_tier <= Tier::spherical;
    parts[b].orientation = asks[b] || !round;
    parts[b].spin = parts[b].orientation || plan.tier != Tier::none || friction;
  }
  return parts;
}

}  // namespace carom
