// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/gauss.hpp"

namespace carom::adjoint_detail {

/// Steps of work that a step along a path in contact without a closed form counts for.
inline constexpr std::size_t kConstrainedStep = 100;

/// How steps of paths in contact are made, of one body and of groups.
struct StepLimits {
  /// Rounds of one step, and what the slopes may change by in the last, as a share of the scales.
  static constexpr int kRounds = 40;
  static constexpr double kSettled = 2e-15, kStalled = 1e-12;
  /// Slopes of places are speeds, which those of speeds settle: of them so many times less is asked.
  static constexpr double kOfPlaces = 10;
  /// What polynomials may leave out.
  static constexpr double kLeftOut = 3e-14;
  /// Directions that turn by no more than this, rad, in the last round.
  static constexpr double kTurned = 1e-6;
  /// How much further than it is long another step is good for a guess.
  static constexpr double kGuessed = 1.5;
};

/// How such paths go from step to step, and end.
struct PathLimits {
  /// A slip that ends goes straight from this share of the unit of speed on, if what is left of it across is rounding, or from
  /// the lesser one.
  static constexpr double kStraight = 1e-8, kStraightAnyway = 1e-11;
  /// What a slip that ends may have across its direction, as a share of the unit of speed: one that goes straight, and one
  /// that still turns.
  static constexpr double kStraightLeft = 1e-6, kNothingLeft = 1e-11;
  /// A slip goes straight where it changes across its direction by no more than this share.
  static constexpr double kTurns = 1e-4;
  /// The first step turns the bodies by about so much, rad.
  static constexpr double kFirstTurn = 0.3;
  /// See lengthBeforeEnd.
  static constexpr double kLeftOutOfSlip = 3e-13;
  /// An end that is nearer than this share of a step to its start, and cannot be come to by a step, is there at once.
  static constexpr double kAtOnceOfStep = 1e-6;
  /// Guards that fall to 0 nearer to one another than this share of the time do so at once.
  static constexpr double kAtOnce = 1e-13;
  static constexpr int kTries = 200;
  static constexpr std::size_t kMostSteps = 20'000;
  /// Rounds of a step to its end, and by which share of it the end may still move.
  static constexpr int kEndings = 6;
  static constexpr double kSameEnd = 1e-15;
  /// How far beyond its end a path is followed, as shares of the unit of time, and what its guard is to fall below there, as a
  /// share of its unit: far above the rounding of modes.
  static constexpr double kFurther[] = {1e-6, 1e-5, 1e-4, 1e-3};
  static constexpr double kClearlyBeyond = 1e-7;

  /// By which a step may be longer, or has to be shorter.
  static double factorFor(double error) { return std::clamp(0.9 * elementary::pow(std::max(error, 1e-12), -1.0 / 11), 0.2, 2.0); }
  /// How far before its end a slip can be followed in one step, as a share of the time that is left of it: polynomials
  /// through the nodes converge like 1/R^12 on the ellipse of axes R + 1/R that reaches to the end, and what they leave out
  /// counts by the share that the slip has of the unit of speed.
  static double lengthBeforeEnd(double share) {
    const double R = elementary::pow(share / kLeftOutOfSlip, 1.0 / Gauss::kNodes);
    return 2.6 / (0.5 * (R + 1 / R) + 1);
  }
};

}  // namespace carom::adjoint_detail
