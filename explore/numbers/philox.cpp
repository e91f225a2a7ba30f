// SPDX-License-Identifier: MIT
#include "explore/numbers/philox.hpp"

namespace carom::explore_detail {
namespace {

constexpr std::uint64_t kMultipliers[] = {0xD2511F53, 0xCD9E8D57};
constexpr std::uint32_t kWeyl[] = {0x9E3779B9, 0xBB67AE85};  // golden ratio, sqrt(3) - 1
constexpr int kRounds = 10;

std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t a = kMultipliers[0] * counter[0], b = kMultipliers[1] * counter[2];
    counter = {high(b) ^ counter[1] ^ key[0], low(b), high(a) ^ counter[3] ^ key[1], low(a)};
    key[0] += kWeyl[0], key[1] += kWeyl[1];
  }
  return counter;
}

double randomNumber(std::uint64_t seed, std::uint64_t world, std::uint32_t number) {
  const auto bits = philox({low(world), high(world), number, 0}, {low(seed), high(seed)});
  const std::uint64_t k = (static_cast<std::uint64_t>(bits[0]) << 20) | (bits[1] >> 12);
  return (static_cast<double>(k) + 0.5) * 0x1p-52;  // exact
}

}  // namespace carom::explore_detail
