// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/plan.h"
#include "adjoint/motion/start_overlap.h"
#include "formats/base/document.h"

namespace carom::formats_detail {

/// How a scene is computed, and why.
struct ScenePlan {
  /// A pair of bodies that can touch (see mayCollide).
  struct Pair {
    int a = -1;                     ///< body
    int b = -1;                     ///< body
    PairCoefficients coefficients;  ///< in force
    Law law = Law::frictionless;    ///< of their impacts
    std::string why;                ///< the law, in words
    std::string elasticity_why;     ///< how the materials' elasticities were combined
    std::string friction_why;       ///< how their frictions were combined
  };
  /// What a moving body can do in lasting contact.
  struct Lasting {
    std::vector<ArcKind> kinds;  ///< empty of bodies that impacts do not move
    std::string ends;            ///< the motion ends where it does this, in words
  };
  /// Bodies that the scene starts on each other.
  struct Component {
    std::vector<int> bodies;  ///< that contacts press together
    bool rests = true;
    bool ends = false;        ///< the motion does, there
    std::string why;          ///< in words
  };
  std::string asked;                   ///< what the tiers are chosen for: "edit" or "simulate"
  Plan plan;                           ///< of the bodies
  std::vector<Lasting> lasting;        ///< one a body
  std::vector<Pair> pairs;             ///< that can touch
  std::vector<Component> components;   ///< at the start
  std::vector<StartOverlap> overlaps;  ///< at the start, without when they part
  int controls = 0;                    ///< numbers that may vary
  int rows = 0;                        ///< numbers that are held
};

/// The answer of `carom info S.json --json`: name and notes (null where the document has none), duration, asked, bodies
/// {name, notes where it has some, shape, dimensions by name, of moving ones mass, center_of_mass (m, shape axes) and
/// principal moments (kg m^2), of those that differ kinematic, gravity_factor, surface_velocity, surface_angular_velocity and
/// collision_filter, tier, why,
/// derivative_tier, derivative_why, of those that impacts move lasting_contact (kinds, as of LastingContact) and
/// lasting_contact_ends (where it ends the motion)}, components {bodies, rests, why} of bodies that the scene starts on each other, overlaps {bodies, depth}, repairs {file, what}, pairs {bodies, law, why, elasticity,
/// friction, tangential_elasticity}, controls, rows.
std::string infoJson(const Document& document, const ScenePlan& plan);

}  // namespace carom::formats_detail
