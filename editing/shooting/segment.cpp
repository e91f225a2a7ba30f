// SPDX-License-Identifier: MIT
#include "editing/shooting/segment.h"

#include <algorithm>

#include "adjoint/base/errors.h"
#include "editing/hessian.h"

namespace carom {

Eigen::VectorXd Segment::unknownsAt(const Eigen::VectorXd& x) const {
  Eigen::VectorXd z(static_cast<Eigen::Index>(unknowns.size()));
  for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = unknowns[static_cast<std::size_t>(i)].at(x);
  return z;
}

bool Segment::follow(const Motion& whole, const Eigen::VectorXd& x, double from, double until,
                     const std::vector<int>& bodies) {
  like = std::make_shared<Motion>(simulateAt(problem, problem.valuesOf(unknownsAt(x)), until - from));
  const auto impacts = [&](const Motion& motion, double lo, double hi) {
    std::string text;
    for (int body : bodies)
      for (int e : motion.world_lines[static_cast<std::size_t>(body)].events) {
        const double t = motion.events[static_cast<std::size_t>(e)].time;
        if (t >= lo && t <= hi) text += motion.describeEvent(e) + ';';
      }
    return text;
  };
  return impacts(*like, 0, until - from) == impacts(whole, from, until);
}

double Segment::until(const Eigen::VectorXd& x, const Eigen::VectorXd& times) const {
  const double from = start.at(x);
  if (!end && reads_impacts) return horizon - from;
  double last = end ? end->at(x) - from : 0;
  for (double t : times) last = std::max(last, t);
  for (const Constraint& constraint : problem.constraints.constraints()) {
    const bool at_time = !constraint.targets.empty() && constraint.at.impact == 0 && !constraint.at.span;
    if (at_time) last = std::max(last, constraint.at.time);
    for (const Region& region : constraint.regions) last = std::max(last, region.during->second);
  }
  return last;
}

SegmentPointPtr Segment::evaluate(const Eigen::VectorXd& x) const {
  auto point = std::make_shared<SegmentPoint>();
  point->unknowns = unknownsAt(x);
  if (!point->unknowns.allFinite()) return nullptr;
  const Eigen::VectorXd times = point->unknowns.tail(problem.times()), latest = problem.upper().tail(problem.times());
  if ((times.array() < 0).any() || (times.array() > latest.array()).any()) return nullptr;
  point->values = problem.valuesOf(point->unknowns);
  if (end && !(end->at(x) > start.at(x))) return nullptr;
  try {
    Replay replay = replayAt(problem, point->values, *like, until(x, problem.timesOf(point->unknowns)), contacts.get());
    if (!replay.complete || replay.left_out > 0) return nullptr;
    point->motion = std::move(replay.motion);
    point->rows = problem.constraints.evaluate(point->motion, problem.timesOf(point->unknowns));
  } catch (const InputError&) {
    return nullptr;
  }
  return point->rows.available && point->rows.values.allFinite() ? point : nullptr;
}

void Segment::differentiate(SegmentPoint& point) const {
  if (point.jacobian) return;
  const Eigen::Index n = problem.controls.size(), k = problem.times();
  Eigen::MatrixXd J(problem.constraints.size(), n + k);
  J.leftCols(n) = jacobianByAdjoint(problem, point.values, point.motion, point.rows);
  J.rightCols(k) = jacobianByTimes(problem, point.motion, point.rows);
  point.jacobian = J * problem.rates(point.unknowns).asDiagonal();
}

Eigen::MatrixXd Segment::hessian(const SegmentPoint& point, const Eigen::VectorXd& weights) const {
  return rowsHessian(problem, point.unknowns, point.motion, point.rows, weights);
}

}  // namespace carom
