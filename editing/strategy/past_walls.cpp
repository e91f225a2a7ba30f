// SPDX-License-Identifier: MIT
#include "editing/strategy/past_walls.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "editing/detail/messages.hpp"
#include "editing/strategy/energy_bounds.hpp"
#include "editing/strategy/place_ranges.hpp"

namespace carom::editing_detail {
namespace {

constexpr double kWallRounding = 1e-9;

bool isConvex(const Shape& shape) {
  return !std::holds_alternative<Mesh>(shape) && !std::holds_alternative<Compound>(shape) &&
         !std::holds_alternative<Plane>(shape);
}

/// Its corners, if its edges run along the axes.
struct Block {
  Vec3 lower, upper;
};
std::optional<Block> blockOf(const Body& solid) {
  const auto* box = std::get_if<Box>(&solid.shape);
  if (!box || !solid.fixed || !solid.orientation.vec().isZero(0)) return std::nullopt;
  return Block{solid.position - 0.5 * box->size, solid.position + 0.5 * box->size};
}

/// Whether all that a centre of mass reaches lies within the box across an axis.
bool closesOff(const Block& block, Eigen::Index axis, const CenterLimits& limits, double time) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (k == axis) continue;
    double from = limits.start[k] - limits.speed * time, to = limits.start[k] + limits.speed * time;
    if (k == 2) from = std::max(from, limits.lowest), to = std::min(to, limits.highest);
    if (!(block.lower[k] <= from && to < block.upper[k] - kWallRounding * (1 + std::abs(to)))) return false;
  }
  return true;
}

double latestOf(const EditProblem& problem, const When& at) {
  return at.span ? double(at.span->second) : at.isTime() ? double(at.time) : problem.duration;
}

}  // namespace

std::string whyItStaysBefore(const EditProblem& problem, double tolerance) {
  const ConstraintSet& set = problem.constraints;
  const Scene& scene = problem.controls.startScene();
  for (std::size_t i = 0; i < set.constraints().size(); ++i) {
    const Constraint& constraint = set.constraints()[i];
    const PositionRange place = placeOf(set, static_cast<int>(i), tolerance);
    if (!place.any || !constraint.relative_to.empty()) continue;
    const int index = bodyIndex(scene, constraint.body);
    const Body& body = scene.bodies[static_cast<std::size_t>(index)];
    if (body.immovable() || !isConvex(body.shape) || body.center_of_mass) continue;
    const std::optional<CenterLimits> limits = centerLimits(problem, index);
    if (!limits) continue;
    const double time = latestOf(problem, constraint.at);
    for (const Body& solid : scene.bodies) {
      const std::optional<Block> block = blockOf(solid);
      if (!block || !mayCollide(body, solid)) continue;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        const bool beyond = limits->start[k] < block->lower[k] && place.lower[axis] - limits->offset > block->upper[k];
        const bool before = limits->start[k] > block->upper[k] && place.upper[axis] + limits->offset < block->lower[k];
        if (!(beyond || before) || !closesOff(*block, k, *limits, time)) continue;
        return "'" + body.name + "' does not get past '" + solid.name + "', behind which it is to be (" +
               set.describeConstraint(static_cast<int>(i)) + "): it has energy for a height of " +
               brief(limits->highest) + " m and for " + brief(limits->speed) +
               " m/s at most, which takes it neither over nor round it by " + brief(time) + " s.";
      }
    }
  }
  return "";
}

}  // namespace carom::editing_detail
