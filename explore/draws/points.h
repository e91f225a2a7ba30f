// SPDX-License-Identifier: MIT
#pragma once

namespace carom {

/// Where the numbers of worlds come from.
enum class Points {
  random,  ///< independent, by Philox4x32-10 from seed, world and number
  sobol    ///< Sobol's sequence: shares converge faster, up to 64 numbers
};

}  // namespace carom
