// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/flight/arc.h"
#include "adjoint/scene/scene.h"

namespace carom {

/// What will be asked of one body of a motion: the less, the cheaper the model that is exact for it.
struct Asked {
  bool orientation = true;  ///< its orientation, or a point fixed to it
  bool inertia = true;      ///< derivatives by moments (or sizes) that vary one by one
};

/// Impact law of a pair (docs/equations.md section 4).
enum class Law { frictionless, friction };

/// Coefficients in force between two bodies, after combination of their materials.
struct PairCoefficients {
  double elasticity = 0, friction = 0, tangential_elasticity = 0;
};
PairCoefficients combine(const Material& a, const Material& b);
PairCoefficients combineTangent(const Material& a, const Material& b, const MaterialDerivative& da,
                                const MaterialDerivative& db);
void combinePullback(const Material& a, const Material& b, const PairCoefficients& pair_bar, MaterialDerivative& a_bar,
                     MaterialDerivative& b_bar);

struct BodyPlan {
  Tier tier = Tier::triaxial;             ///< of the motion
  Tier derivative_tier = Tier::triaxial;  ///< of the tangent and adjoint passes
  bool derivative_products = false;       ///< these need products of inertia: principal axes turn in the shape
  const char* why = "";
  const char* derivative_why = "";
};

/// What each body and pair got. Pairs are not listed one by one: law(a, b) answers.
struct Plan {
  std::vector<BodyPlan> bodies;
};

/// Chooses the cheapest tiers that are exact for what is asked. An empty `asked` asks for everything of every body.
Plan makePlan(const Scene& scene, const std::vector<Asked>& asked = {});

Law lawOf(const PairCoefficients& pair);

}  // namespace carom
