// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "bench/edits/dice.h"

namespace carom::bench {

/// One part of the way of a shot: a ball touches as many rails, and then, unless it is the last part, another ball.
struct Leg {
  bool cue = false;  ///< the cue ball goes on; otherwise the ball that was struck last
  int rails = 0;
  bool strikes = true;  ///< a ball that is laid there for it
};

/// Balls on a table with four rails, and what the cue ball does to them.
struct Shot {
  Scene scene;
  std::vector<std::string> sequence;  ///< "cue red", "red rail*", in order
  std::string striker, struck;        ///< of the last ball that is struck
  double struck_at = 0;               ///< s
  std::string mover;                  ///< of the last leg
  double from = 0, to = 0;            ///< s, the flight of the mover after the last rail or ball, up to what comes next
};

/// A shot that does what the legs say; none where the draw did not allow it. Some tables lie in a plane without
/// gravity, on others the balls slide or roll over a floor. Up to two balls more lie about.
std::optional<Shot> drawShot(const std::vector<Leg>& legs, Dice& dice);

/// A triangle of as many layers of balls, loosely laid, and the cue ball on its way to it. The last ball is "corner".
Scene drawRack(int layers, Dice& dice);

/// Whether the impacts of the body that is named first in the first pair, with bodies that move or are named, begin
/// with these, in order. A pair is two names, of which a * at the end stands for anything.
bool beginsWith(const Motion& motion, const std::vector<std::string>& sequence);

}  // namespace carom::bench
