// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>

namespace carom::test {

/// CAROM_TEST_SCALE, by which random tests multiply how much they try: 1 unless it is set.
inline double testScale() {
  const char* scale = std::getenv("CAROM_TEST_SCALE");
  return scale ? std::atof(scale) : 1.0;
}
/// A number of random cases by that scale, one at least.
inline int scaled(int count) { return std::max(1, static_cast<int>(count * testScale())); }

}  // namespace carom::test
