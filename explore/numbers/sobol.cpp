// SPDX-License-Identifier: MIT
#include "explore/numbers/sobol.hpp"

#include <bit>

#include "explore/numbers/philox.hpp"
#include "explore/numbers/sobol_table.hpp"

namespace carom::explore_detail {
namespace {

constexpr int kBits = 32;

/// v_k = m_k 2^(32 - k), with m_k = 2 a_1 m_(k-1) ^ 4 a_2 m_(k-2) ^ ... ^ 2^s m_(k-s) ^ m_(k-s).
std::array<std::uint32_t, kBits> directionsOf(const SobolRow& row) {
  const int degree = std::bit_width(row.polynomial) - 1;
  std::array<std::uint32_t, kBits> m{};
  for (int k = 0; k < kBits; ++k) {
    if (degree == 0) {
      m[k] = 1;
    } else if (k < degree) {
      m[k] = row.first[k];
    } else {
      m[k] = m[k - degree];
      for (int j = 1; j <= degree; ++j)
        if (row.polynomial >> (degree - j) & 1) m[k] ^= m[k - j] << j;
    }
  }
  for (int k = 0; k < kBits; ++k) m[k] <<= kBits - 1 - k;
  return m;
}

}  // namespace

SobolPoints::SobolPoints(int dimensions, std::uint64_t seed) {
  static_assert(std::size(kSobolRows) == kSobolDimensions);
  for (int d = 0; d < dimensions; ++d) {
    directions_.push_back(directionsOf(kSobolRows[d]));
    if (seed != 0)
      shifts_.push_back(philox({static_cast<std::uint32_t>(d), 0, 0, 0},
                               {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)})[0]);
  }
}

double SobolPoints::coordinate(std::uint64_t world, int dimension) const {
  const auto d = static_cast<std::size_t>(dimension);
  const auto point = static_cast<std::uint32_t>(world + 1);
  std::uint32_t x = 0;
  for (std::uint32_t gray = point ^ (point >> 1); gray != 0; gray &= gray - 1)
    x ^= directions_[d][std::countr_zero(gray)];
  // Unshifted no coordinate of a point but the corner's is 0; shifted it may be.
  return shifts_.empty() ? x * 0x1p-32 : ((x ^ shifts_[d]) + 0.5) * 0x1p-32;
}

}  // namespace carom::explore_detail
