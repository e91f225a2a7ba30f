// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/edits/dice.h"
#include "bench/edits/wanted.h"
#include "editing/constraint.h"
#include "editing/control.h"

namespace carom::bench {

/// A motion that meets what is asked of it.
struct HiddenMotion {
  Scene scene;
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
  std::vector<std::string> sequence;  ///< with which it begins, see beginsWith; empty: not asked for
  double duration = 0;
  bool planar = false;           ///< everything happens in a plane z = const
  bool missed_at_start = false;  ///< the start is to lack what is held
};

/// For the families that start anywhere; none where the draw did not come to what is wanted.
std::optional<HiddenMotion> drawHiddenMotion(const Wanted& wanted, Dice& dice);

}  // namespace carom::bench
