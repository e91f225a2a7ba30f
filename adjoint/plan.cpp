#include "adjoint/plan.h"

#include <algorithm>

#include "adjoint/flight_symmetric.h"

namespace carom {
namespace {

struct Rule {
  double value, by_a, by_b;
};

// The pair's coefficient and its derivatives by the two materials'. On a tie of minimum or maximum both materials hold
// the value; the first one, by the order of the bodies, is taken to carry it half and half.
Rule combined(Combine rule, double a, double b) {
  switch (rule) {
    case Combine::average:
      return {0.5 * (a + b), 0.5, 0.5};
    case Combine::multiply:
      return {a * b, b, a};
    case Combine::minimum:
    case Combine::maximum:
      break;
  }
  if (a == b) return {a, 0.5, 0.5};
  const bool takes_a = (a < b) == (rule == Combine::minimum);
  return takes_a ? Rule{a, 1, 0} : Rule{b, 0, 1};
}

struct PairRules {
  Rule elasticity, friction, tangential;
};

PairRules rulesOf(const Material& a, const Material& b) {
  // the enumerators stand in the order of precedence
  return {combined(std::min(a.combine_elasticity, b.combine_elasticity), a.elasticity, b.elasticity),
          combined(std::min(a.combine_friction, b.combine_friction), a.friction, b.friction),
          combined(Combine::average, a.tangential_elasticity, b.tangential_elasticity)};
}

}  // namespace

PairCoefficients combine(const Material& a, const Material& b) {
  const PairRules r = rulesOf(a, b);
  return {r.elasticity.value, r.friction.value, r.tangential.value};
}

PairCoefficients combineTangent(const Material& a, const Material& b, const MaterialDerivative& da,
                                const MaterialDerivative& db) {
  const PairRules r = rulesOf(a, b);
  return {r.elasticity.by_a * da.elasticity + r.elasticity.by_b * db.elasticity,
          r.friction.by_a * da.friction + r.friction.by_b * db.friction,
          r.tangential.by_a * da.tangential_elasticity + r.tangential.by_b * db.tangential_elasticity};
}

void combinePullback(const Material& a, const Material& b, const PairCoefficients& pair_bar, MaterialDerivative& a_bar,
                     MaterialDerivative& b_bar) {
  const PairRules r = rulesOf(a, b);
  a_bar.elasticity += r.elasticity.by_a * pair_bar.elasticity;
  b_bar.elasticity += r.elasticity.by_b * pair_bar.elasticity;
  a_bar.friction += r.friction.by_a * pair_bar.friction;
  b_bar.friction += r.friction.by_b * pair_bar.friction;
  a_bar.tangential_elasticity += r.tangential.by_a * pair_bar.tangential_elasticity;
  b_bar.tangential_elasticity += r.tangential.by_b * pair_bar.tangential_elasticity;
}

Law lawOf(const PairCoefficients& pair) { return pair.friction > 0 ? Law::friction : Law::frictionless; }

namespace {

BodyPlan planBody(const Body& body, const Asked& asked) {
  BodyPlan plan;
  if (body.fixed) return {Tier::none, Tier::none, "fixed: it does not move", "fixed: it does not move"};
  const int axis = symmetryAxis(modelOf(body).inertia);
  const bool ball = std::holds_alternative<Sphere>(body.shape);
  // the size and mass of a ball change its derived moments together
  const bool stays_spherical =
      axis == -1 && (!asked.inertia || (ball && body.inertia.source == Inertia::Source::derived));
  if (ball && stays_spherical && !asked.orientation)
    return {Tier::none, Tier::none, "a uniform ball whose orientation is not asked for: nothing depends on it",
            "a uniform ball whose orientation is not asked for: nothing depends on it"};
  if (axis == -1) plan = {Tier::spherical, Tier::spherical, "three equal moments: it spins about a fixed axis", ""};
  if (axis >= 0 && axis < 3) plan = {Tier::symmetric, Tier::symmetric, "two equal moments: it precesses steadily", ""};
  if (axis == 3) return {Tier::triaxial, Tier::triaxial, "three different moments", "three different moments"};
  if (asked.inertia && !stays_spherical) {
    plan.derivative_tier = Tier::triaxial;
    plan.derivative_why = "its moments vary one by one, which breaks their symmetry";
  } else {
    plan.derivative_why = "nothing asked for breaks the symmetry of its moments";
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
