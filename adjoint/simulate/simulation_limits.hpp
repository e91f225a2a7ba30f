// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Where the event loop gives up, and what counts as one instant.
namespace carom::adjoint_detail {

// How far a contact may move within an instant and still be the same one, as a share of its arm.
inline constexpr double kSamePlace = 1e-6;
/// Bounces lower than PairScales::leastHeight, of which no digits are left to speak of, on changing features (a rattling
/// box) count as a cascade after so many in a row.
inline constexpr int kRattles = 8;
/// As many impacts of one body as this within kStall instants are a cascade, whichever bodies it meets.
inline constexpr std::size_t kStallEvents = 64;
inline constexpr double kStall = 10;

/// A body further away or faster than this (m, m/s) cannot be computed with: fourth powers of it would overflow, whatever
/// the units.
inline constexpr double kFurthest = 1e60;
/// Bodies that ask for their neighbours as often as this without an impact fly too fast for how near they are.
inline constexpr long kMostSearches = 5'000'000;
/// An angle of which a sine has no digit left, rad.
inline constexpr double kMostTurn = 1e15;
/// Steps of work in which a motion that was ended may bring what it knows into order.
inline constexpr std::size_t kStepsToEnd = 100'000;

}  // namespace carom::adjoint_detail
