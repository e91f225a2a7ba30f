// SPDX-License-Identifier: MIT
#include "formats/svg/shade.hpp"

#include <algorithm>

namespace carom::formats_detail {
namespace {

constexpr double kShadeSamples = 3e6;  // places of all paths

CellGrid crowdGrid(const Motion& motion, const View& view, const PathPlan& paths, double cell) {
  CellGrid grid(view.panel, cell);
  const double most = kShadeSamples / std::max(1, paths.crowd), each = motion.end > 0 ? 1 / motion.end : 0;
  for (std::size_t body = 0; body < paths.looks.size(); ++body)
    if (paths.looks[body].as == BodyLook::As::crowd)
      for (const PathSample& sample : samplesOfPath(motion, static_cast<int>(body), view, 0.4 * cell, most))
        grid.add(sample.pixel, each * sample.seconds);
  return grid;
}

}  // namespace

ShadePlan planShade(const Motion& motion, const std::vector<View>& views, const PathPlan& paths, std::size_t most) {
  ShadePlan plan;
  if (paths.crowd == 0 || !paths.shaded) return plan;
  for (const double cell : {7.0, 11.0, 22.0}) {
    plan = {};
    plan.cell = cell;
    std::vector<CellGrid> grids;
    for (const View& view : views) {
      grids.push_back(crowdGrid(motion, view, paths, cell));
      plan.largest = std::max(plan.largest, grids.back().largest());
    }
    std::size_t bytes = 0;
    for (const CellGrid& grid : grids) {
      plan.paths.emplace_back();
      double high = plan.largest;
      for (std::size_t k = kShades.size(); k-- > 0; high *= 0.5) {
        plan.paths.back()[k] = grid.rows(k == 0 ? 0 : 0.5 * high, high);
        bytes += plan.paths.back()[k].size();
      }
    }
    if (bytes <= most) break;
  }
  return plan;
}

}  // namespace carom::formats_detail
