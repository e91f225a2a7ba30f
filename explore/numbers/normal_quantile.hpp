// SPDX-License-Identifier: MIT
#pragma once

/// The standard normal distribution, with the same bits everywhere. Internal to explore/.
namespace carom::explore_detail {

/// z such that a standard normal number is below it with probability p, in (0, 1): algorithm AS 241, PPND16 (M. J.
/// Wichura, Applied Statistics 37, 1988), to about 1e-15. -infinity at 0, infinity at 1.
double normalQuantile(double p);

/// The probability of a standard normal number below z: that whose quantile is z, so that the two belong together.
/// Relative to itself as exact as that, for z <= 0; 0 below -38.4.
double normalProbability(double z);

}  // namespace carom::explore_detail
