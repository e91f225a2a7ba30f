// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"
#include "editing/why_not.h"

/// Constraints that no motion meets. Internal to editing/.
namespace carom::editing_detail {

/// A proof that no motion meets the constraints.
struct Impossible {
  std::string why;            ///< a sentence; empty: there is none
  bool tells_all = false;     ///< it names what would have to be otherwise: trying other controls tells no more
  std::vector<WhyNot::Inside> inside = {};  ///< nails in fixed bodies, where that is why
};

/// Why the constraints cannot be met whatever impacts come, as far as that is proven:
/// - nothing varies;
/// - an impact is required of bodies that never collide, or a rest in the air (proven_bounds.hpp); a height, a speed or a way that
///   takes more energy than there is (energy_bounds.hpp); a place to the side of all that a speed, which nothing changes, leads to, or
///   out of reach of a throw that meets nothing before (kept_coordinates.hpp); a nail inside a fixed body (nail_in_solid.hpp);
/// - one number is held at two values, or in ranges that have nothing in common;
/// - only what acts in impacts varies (materials, tilts), and a number is read before the first impact that it acts in.
Impossible whyImpossible(const EditEvaluator& evaluator, const EditPoint& start);

}  // namespace carom::editing_detail
