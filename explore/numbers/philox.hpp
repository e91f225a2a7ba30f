// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

/// Random numbers by place. Internal to explore/.
namespace carom::explore_detail {

/// Philox4x32-10 (J. K. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC11): a bijection of the counter
/// for each key, whose values pass for random. There is no state, so that any world is drawn by itself.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// The number of a world in (0, 1): one of 2^52 that are evenly spaced, none nearer to an end than half of that.
double randomNumber(std::uint64_t seed, std::uint64_t world, std::uint32_t number);

}  // namespace carom::explore_detail
