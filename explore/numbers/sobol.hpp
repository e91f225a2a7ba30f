// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

/// Sobol's sequence. Internal to explore/.
namespace carom::explore_detail {

inline constexpr int kSobolDimensions = 64;                                  ///< as many numbers as a point has at most
inline constexpr std::uint64_t kSobolWorlds = (std::uint64_t{1} << 32) - 1;  ///< as many worlds as there are points

/// Sobol's points with the direction numbers of S. Joe and F. Y. Kuo (SIAM J. Sci. Comput. 30, 2008), in the order of
/// Gray codes: those of scipy.stats.qmc.Sobol. World w has point w + 1, as point 0 is the corner of the cube.
class SobolPoints {
 public:
  /// With a seed other than 0 every coordinate is shifted by exclusive or with a random number of its own.
  SobolPoints(int dimensions, std::uint64_t seed);
  /// A coordinate of the point of a world, in (0, 1).
  double coordinate(std::uint64_t world, int dimension) const;

 private:
  std::vector<std::array<std::uint32_t, 32>> directions_;  // of each coordinate
  std::vector<std::uint32_t> shifts_;                      // empty: none
};

}  // namespace carom::explore_detail
