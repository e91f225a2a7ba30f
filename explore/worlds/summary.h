// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "explore/worlds/exploration.h"
#include "explore/worlds/world_table.h"

namespace carom {

/// How many of some worlds, and between what bounds the probability lies with 95 % confidence: Wilson's interval, for
/// independent worlds; Sobol's points are usually closer than that.
struct Share {
  std::uint64_t count = 0;      ///< worlds
  double share = 0;             ///< of those that count
  double lower = 0;             ///< end of the interval
  double upper = 1;             ///< end of the interval
};
/// Of `count` in `all` worlds; without any worlds nothing is known: 0 to 1.
Share shareOf(std::uint64_t count, std::uint64_t all);

/// Worlds with one impact sequence and one status.
struct Outcome {
  std::uint64_t signature = 0;  ///< hash of the sequence; 0 without a motion
  std::uint8_t status = 0;      ///< without flags
  Share share;                  ///< of all worlds
  std::uint64_t example = 0;    ///< the first such world
};

/// What worlds say of one row.
struct RowSummary {
  std::uint64_t count = 0;            ///< worlds that have it
  double mean = 0;                    ///< SI, of these; NaN without any
  double deviation = 0;               ///< SI, standard deviation with n - 1; NaN without any
  std::array<double, 5> quantiles{};  ///< SI, at 2.5, 25, 50, 75 and 97.5 %; NaN without any
  Share within;                       ///< of all worlds: it exists, and is within the range; only of a range
};

/// How often which face of a box looks up.
struct FaceSummary {
  std::string box;             ///< the name of the body
  std::array<Share, 7> faces;  ///< as in WorldTable::face; 0: none
};

/// A table in few numbers. Worlds that a joint distribution drew outside of bounds do not count.
struct ExploreSummary {
  std::uint64_t worlds = 0;        ///< that count
  std::uint64_t outside = 0;       ///< drawn outside of bounds, see world_status::kOutside
  std::vector<Outcome> outcomes;   ///< the most frequent first
  std::vector<RowSummary> rows;    ///< as Exploration::rows
  std::vector<FaceSummary> faces;  ///< as Exploration::boxes
  /// Every row and required impact is there, and every range is kept to. Rows that ask for a number do not count: no
  /// world has that exactly.
  Share met;
  std::uint64_t without_derivative = 0;  ///< worlds with a row that has no derivative
  std::uint64_t unreliable = 0;          ///< worlds whose derivatives are not reliable
};

/// Counts a table of the exploration.
ExploreSummary summarise(const Exploration& exploration, const WorldTable& table);

/// A world, and how far it is from what the constraints ask for.
struct NearWorld {
  std::uint64_t world = 0;  ///< its index
  double distance = 0;  ///< sqrt(sum (r / s)^2), r how far a row is off, s its natural scale
};
/// The worlds nearest to what the constraints ask for, the nearest first, of those that have all rows and required
/// impacts: starts for an edit (Exploration::sceneAt).
std::vector<NearWorld> nearestWorlds(const Exploration& exploration, const WorldTable& table, std::size_t most);

}  // namespace carom
