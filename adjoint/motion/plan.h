// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/flight/arc.h"
#include "adjoint/scene/scene.h"

namespace carom {

/// What is required of one body of a motion: the less, the cheaper the model that is exact for it.
struct Asked {
  bool orientation = true;  ///< its orientation, or a point fixed to it
  bool inertia = true;      ///< derivatives with respect to individual moments (or sizes)
};

/// Impact law of a pair (docs/equations.md section 4).
enum class Law { frictionless, friction };

/// Coefficients in force between two bodies, after combination of their materials.
template <class S>
struct PairCoefficientsOf {
  S elasticity = 0;             ///< coefficient of restitution e, 0 to 1
  S friction = 0;               ///< Coulomb coefficient mu, >= 0
  S tangential_elasticity = 0;  ///< coefficient of tangential restitution e_t, -1 to 1

  /// Field by field.
  PairCoefficientsOf& operator+=(const PairCoefficientsOf& o) {
    elasticity += o.elasticity, friction += o.friction, tangential_elasticity += o.tangential_elasticity;
    return *this;
  }
};
using PairCoefficients = PairCoefficientsOf<double>;  ///< of a motion
/// The coefficients of two materials in contact, combined by their rules.
PairCoefficients combine(const Material& a, const Material& b);

/// Flight models of one body, and the reasons.
struct BodyPlan {
  Tier tier = Tier::triaxial;             ///< of the motion
  Tier derivative_tier = Tier::triaxial;  ///< of the tangent and adjoint passes
  bool derivative_products = false;       ///< these need products of inertia: principal axes rotate in the shape
  const char* why = "";                   ///< reason for the tier of the motion
  const char* derivative_why = "";        ///< reason for the tier of the derivatives
};

/// Flight models of all bodies. For the law of a pair see lawOf.
struct Plan {
  std::vector<BodyPlan> bodies;  ///< one per body
};

/// Chooses the cheapest tiers that are exact for what is required. An empty `asked` requires everything of every
/// body.
Plan makePlan(const Scene& scene, const std::vector<Asked>& asked = {});

/// Friction unless its coefficient is 0.
Law lawOf(const PairCoefficients& pair);

}  // namespace carom
