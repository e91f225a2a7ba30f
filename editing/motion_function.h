// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/second_order/second_order.h"
#include "editing/constraint.h"

namespace carom {

/// A quantity evaluated on a motion, with its derivative.
struct RowReading {
  double value = 0;  ///< SI
  /// Derivative of the value with respect to the states that it depends on, as a sum of seeds: at times up to the end
  /// of the motion, or at its events (whose time varies). Empty if there is none; then `doubt` gives the reason.
  std::vector<StateSeed> seeds = {};
  /// Derivatives of the weights of the seeds. Must not refer to the motion, whose lifetime may have ended.
  SeedRates seed_rates = {};
  /// Whether second derivatives are given: by `seed_rates`, or as 0 if that is empty. Otherwise the Hessian of this
  /// quantity is approximated by secant updates.
  bool second_order = false;
  std::string doubt = {};    ///< not empty: why the derivative is unreliable here, a clause
  std::string missing = {};  ///< not empty: why the quantity cannot be evaluated on this motion, a sentence
};

/// A function of the motion that an edit constrains (Edit::require) or minimises (Edit::minimise).
struct MotionFunction {
  std::string name;  ///< for messages: "angle of incidence"
  /// Evaluates it. Called many times, concurrently from several threads, with motions of similar scenes; must be
  /// deterministic. Edit::solve propagates its exceptions.
  std::function<RowReading(const Motion&)> read;
  double scale = 1;  ///< SI: natural scale of the quantity
  /// The latest time that it depends on: a time, or just after an impact of `body` or its coming to rest, without
  /// which it is not called. Empty: the end. Later parts of the motion need not be simulated for it, and may change
  /// freely.
  std::optional<When> until = std::nullopt;
  std::string body = {};  ///< whose impact or rest `until` refers to; else empty
};

}  // namespace carom
