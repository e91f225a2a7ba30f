// SPDX-License-Identifier: MIT
#include "explore/worlds/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace carom {
namespace {

constexpr double kZ = 1.959963984540054;  // 97.5 % of the standard normal distribution
constexpr double kLevels[] = {0.025, 0.25, 0.5, 0.75, 0.975};

bool counts(const WorldTable& table, std::size_t k) { return table.status[k] != world_status::kOutside; }

/// How far a row is off, SI.
double missOf(const ExploredRow& row, double value) { return value - std::clamp(value, row.lower, row.upper); }

bool isComplete(const WorldTable& table, std::size_t k) {
  return hasMotion(table.status[k]) && (table.status[k] & world_status::kMissingRow) == 0;
}

std::vector<Outcome> outcomesOf(const WorldTable& table, std::uint64_t all) {
  std::map<std::pair<std::uint64_t, std::uint8_t>, Outcome> found;
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (!counts(table, k)) continue;
    const auto status = static_cast<std::uint8_t>(hasMotion(table.status[k]) ? table.status[k] & world_status::kMotion
                                                                             : table.status[k]);
    Outcome& outcome = found[{table.signature[k], status}];
    if (outcome.share.count++ == 0)
      outcome.signature = table.signature[k], outcome.status = status, outcome.example = table.world[k];
  }
  std::vector<Outcome> outcomes;
  for (auto& [key, outcome] : found) {
    outcome.share = shareOf(outcome.share.count, all);
    outcomes.push_back(outcome);
  }
  std::ranges::sort(outcomes, [](const Outcome& a, const Outcome& b) {
    return std::pair(b.share.count, a.example) < std::pair(a.share.count, b.example);
  });
  return outcomes;
}

/// Between the two nearest of sorted values.
double quantile(const std::vector<double>& sorted, double level) {
  const double at = level * static_cast<double>(sorted.size() - 1);
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= sorted.size()) return sorted.back();
  return sorted[k] + (at - static_cast<double>(k)) * (sorted[k + 1] - sorted[k]);
}

RowSummary summaryOf(const ExploredRow& row, const WorldTable& table, std::size_t index, std::uint64_t all) {
  RowSummary summary;
  std::vector<double> values;
  std::uint64_t within = 0;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double value = table.values[k * table.rows + index];
    if (std::isnan(value) || !counts(table, k)) continue;
    values.push_back(value);
    within += missOf(row, value) == 0;
  }
  summary.count = values.size();
  summary.mean = summary.deviation = std::numeric_limits<double>::quiet_NaN();
  summary.quantiles.fill(summary.mean);
  if (row.isRange()) summary.within = shareOf(within, all);
  if (values.empty()) return summary;
  std::ranges::sort(values);
  // Of sorted values, so that the sums do not depend on how the table was put together.
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  summary.mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  if (values.size() > 1) summary.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  for (std::size_t q = 0; q < summary.quantiles.size(); ++q) summary.quantiles[q] = quantile(values, kLevels[q]);
  return summary;
}

}  // namespace

Share shareOf(std::uint64_t count, std::uint64_t all) {
  if (all == 0) return {};
  const double n = static_cast<double>(all), p = static_cast<double>(count) / n, z2 = kZ * kZ;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {count, p, count == 0 ? 0 : std::max(0.0, middle - half), count == all ? 1 : std::min(1.0, middle + half)};
}

ExploreSummary summarise(const Exploration& exploration, const WorldTable& table) {
  ExploreSummary summary;
  std::uint64_t met = 0;
  std::vector<std::array<std::uint64_t, 7>> faces(table.boxes);
  const std::vector<ExploredRow>& rows = exploration.rows();
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (!counts(table, k)) {
      ++summary.outside;
      continue;
    }
    ++summary.worlds;
    bool all_within = isComplete(table, k);
    for (std::size_t i = 0; i < rows.size() && all_within; ++i)
      all_within = !rows[i].isRange() || missOf(rows[i], table.values[k * table.rows + i]) == 0;
    met += all_within;
    for (std::size_t b = 0; b < table.boxes; ++b) ++faces[b][table.face[k * table.boxes + b]];
    if (!hasMotion(table.status[k])) continue;
    summary.without_derivative += (table.status[k] & world_status::kNoDerivative) != 0;
    summary.unreliable += (table.status[k] & world_status::kUnreliable) != 0;
  }
  summary.outcomes = outcomesOf(table, summary.worlds);
  for (std::size_t i = 0; i < rows.size(); ++i) summary.rows.push_back(summaryOf(rows[i], table, i, summary.worlds));
  for (std::size_t b = 0; b < table.boxes; ++b) {
    FaceSummary& of_box = summary.faces.emplace_back();
    of_box.box = exploration.boxes()[b];
    for (std::size_t f = 0; f < faces[b].size(); ++f) of_box.faces[f] = shareOf(faces[b][f], summary.worlds);
  }
  summary.met = shareOf(met, summary.worlds);
  return summary;
}

std::vector<NearWorld> nearestWorlds(const Exploration& exploration, const WorldTable& table, std::size_t most) {
  const std::vector<ExploredRow>& rows = exploration.rows();
  std::vector<NearWorld> near;
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (!isComplete(table, k)) continue;
    double squares = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double miss = missOf(rows[i], table.values[k * table.rows + i]) / rows[i].scale;
      squares += miss * miss;
    }
    if (std::isfinite(squares)) near.push_back({table.world[k], std::sqrt(squares)});
  }
  const auto nearer = [](const NearWorld& a, const NearWorld& b) {
    return std::pair(a.distance, a.world) < std::pair(b.distance, b.world);
  };
  const std::size_t kept = std::min(most, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept), near.end(), nearer);
  near.resize(kept);
  return near;
}

}  // namespace carom
