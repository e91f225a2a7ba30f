// SPDX-License-Identifier: MIT
#include "adjoint/motion/plan.h"

#include <algorithm>
#include <cmath>

#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/motion/inertia_change.hpp"
#include "adjoint/motion/pair_rules.hpp"

namespace carom {

using namespace adjoint_detail;

PairCoefficients combine(const Material& a, const Material& b) { return rulesOf(a, b).values(); }

InertiaChange adjoint_detail::inertiaChange(const std::vector<SolidRate>& rates, const BodyModel& model) {
  InertiaChange change;
  const int axis = symmetryAxis(model.inertia);
  for (const SolidRate& rate : rates) {
    const Mat3 dJ = model.R_BG * rate.unit_inertia * model.R_BG.transpose();
    const double rounding = 1e-12 * dJ.cwiseAbs().maxCoeff();
    const auto differ = [&](int i, int j) { return std::abs(dJ(i, i) - dJ(j, j)) > rounding; };
    if (std::max({std::abs(dJ(1, 2)), std::abs(dJ(0, 2)), std::abs(dJ(0, 1))}) > rounding)
      change.keeps_symmetry = change.keeps_axes = false;
    if (axis == -1 && (differ(0, 1) || differ(1, 2))) change.keeps_symmetry = false;
    if (axis >= 0 && axis < 3 && differ((axis + 1) % 3, (axis + 2) % 3)) change.keeps_symmetry = false;
  }
  return change;
}

Law lawOf(const PairCoefficients& pair) { return pair.friction > 0 ? Law::friction : Law::frictionless; }

namespace {

// Written moments vary one by one. Derived ones follow mass and dimensions: a mass changes them in proportion, a
// dimension as the rates of the shape say.
InertiaChange inertiaChange(const Body& body, const BodyModel& model) {
  if (body.inertia.source != Inertia::Source::derived) return {false, true};
  return adjoint_detail::inertiaChange(kindOf(body.shape).properties(body.shape).rates, model);
}

BodyPlan planBody(const Body& body, const Asked& asked) {
  if (body.fixed) return {Tier::none, Tier::none, false, "fixed: it does not move", "fixed: it does not move"};
  if (body.kinematic) {
    constexpr const char* kWhy = "kinematic: its angular velocity is constant";
    return {Tier::spherical, Tier::spherical, false, kWhy, kWhy};
  }
  const BodyModel model = modelOf(body);
  const int axis = symmetryAxis(model.inertia);
  const InertiaChange change = asked.inertia ? inertiaChange(body, model) : InertiaChange{};
  const bool uniform_ball = std::holds_alternative<Sphere>(body.shape) && axis == -1 && model.center.isZero(0);
  if (uniform_ball && change.keeps_symmetry && !asked.orientation)
    return {Tier::none, Tier::none, false, "a uniform ball whose orientation affects no requested result",
            "a uniform ball whose orientation affects no requested result"};
  BodyPlan plan;
  plan.derivative_products = !change.keeps_axes;
  if (axis == -1) plan.tier = Tier::spherical, plan.why = "three equal moments: it spins about a fixed axis";
  if (axis >= 0 && axis < 3) plan.tier = Tier::symmetric, plan.why = "two equal moments: it precesses steadily";
  if (axis == 3) plan.tier = Tier::triaxial, plan.why = "three different moments";
  plan.derivative_tier = change.keeps_symmetry ? plan.tier : Tier::triaxial;
  if (!change.keeps_axes) {
    plan.derivative_why = "its sizes rotate its principal axes";
  } else if (axis == 3) {
    plan.derivative_why = plan.why;
  } else if (change.keeps_symmetry) {
    plan.derivative_why = "no requested derivative breaks the symmetry of its moments";
  } else {
    plan.derivative_why = "its moments vary individually, which breaks their symmetry";
  }
  return plan;
}

}  // namespace

Plan makePlan(const Scene& scene, const std::vector<Asked>& asked) {
  Plan plan;
  plan.bodies.reserve(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    plan.bodies.push_back(planBody(scene.bodies[i], i < asked.size() ? asked[i] : Asked{}));
  return plan;
}

}  // namespace carom
