// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/contact_source.h"
#include "adjoint/scene/scene.h"
#include "editing/control.h"
#include "editing/motion_function.h"

namespace carom {

/// Outcome of checkMotionFunction.
struct MotionFunctionCheck {
  bool passed = false;  ///< everything could be compared, and agrees
  /// What disagrees, and what could not be compared and why, a sentence each; empty if passed.
  std::vector<std::string> findings;
  int compared = 0;           ///< first and second derivatives that were compared
  int not_compared = 0;       ///< those that could not be: nothing is known about them
  double gradient_error = 0;  ///< largest difference of first derivatives, relative to their size
  double hessian_error = 0;   ///< largest difference of second derivatives, relative to their size
};

/// Checks a function of the motion while you write it: compares the derivatives that it gives (RowReading::seeds, and
/// seed_rates if it has second_order) with central differences over changes of the controls; calls it twice on one
/// motion; and compares its value on the whole motion with that on one that ends at `until`. Derivatives must agree to
/// 1e-6 of their size. Where the impact sequence changes nearby, or differences are too inaccurate, nothing is compared,
/// and the check does not pass: choose another scene. One that is stopped says so, and does not pass. Throws InputError
/// for invalid input, and what the function throws.
MotionFunctionCheck checkMotionFunction(const Scene& scene, ContactSource& contacts, double duration,
                                        const MotionFunction& function, const std::vector<Control>& controls,
                                        std::stop_token stop = {});

/// A duration is in seconds, no bool and no character.
template <NoTime T>
MotionFunctionCheck checkMotionFunction(const Scene& scene, ContactSource& contacts, T duration, const MotionFunction& function,
                                        const std::vector<Control>& controls, std::stop_token stop = {}) = delete;

}  // namespace carom
