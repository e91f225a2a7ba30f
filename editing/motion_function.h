// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/second_order/second_order.h"
#include "editing/constraint.h"

namespace carom {

/// A number that was read from a motion, with its derivative.
struct RowReading {
  double value = 0;  ///< SI
  /// Derivative of the value by the states that it is read from, a sum: at times up to the end of the motion, or at its
  /// events (a reading there moves along with the event). Empty where there is none; then `doubt` says why.
  std::vector<StateSeed> seeds = {};
  /// How the weights of the seeds change with the states. Must not refer to the motion, which may be gone by then.
  SeedRates seed_rates = {};
  /// Whether second derivatives are known: by `seed_rates`, or as 0 where that is empty. Otherwise the curvature of this
  /// number alone is learnt from its gradients, by a secant update.
  bool second_order = false;
  std::string doubt = {};    ///< not empty: why the derivative cannot be trusted here, a clause
  std::string missing = {};  ///< not empty: why this motion does not have the number, a sentence
};

/// A function of the motion that an edit holds (Edit::require) or makes small (Edit::minimise).
struct MotionFunction {
  std::string name;  ///< for people: "angle of incidence"
  /// Reads it. Called many times, from several threads at once, with motions of scenes near the one that is edited; the
  /// same motion must give the same reading. What it throws comes out of Edit::solve.
  std::function<RowReading(const Motion&)> read;
  double scale = 1;  ///< SI: what counts as much as a natural scale of a body does
  /// Up to when it reads the motion: a time, or just after an impact of `body` or its coming to rest, without which it
  /// is not asked. Empty: up to the end. What comes later than a time or an impact is not simulated for it, and may
  /// change freely.
  std::optional<When> until = std::nullopt;
  std::string body = {};  ///< whose impact or rest `until` means; else empty
};

}  // namespace carom
