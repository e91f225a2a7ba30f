// SPDX-License-Identifier: MIT
#include "editing/session/session_kink.hpp"

#include <cmath>

#include "adjoint/numeric/decompositions.hpp"
#include "editing/problem/margins/sequence_boundaries.hpp"

namespace carom::editing_detail {
namespace {

/// A kink changes the derivatives by more than this share of them; less is their curvature.
constexpr double kSharp = 0.02;
/// Other ranks of the change are smaller than this share of the first: else it is no kink but a jump.
constexpr double kOneRank = 0.3;
/// A boundary is crossed on the way where that is so, to first order, after so much of it.
constexpr double kOnTheWay = 1.3;
/// Share of the way to a boundary that may be taken.
constexpr double kBefore = 0.9;

}  // namespace

std::optional<Kink> kinkBetween(const EditProblem& problem, const EditPoint& a, const EditPoint& b) {
  const Eigen::MatrixXd &Ja = *a.row_jacobian, &Jb = *b.row_jacobian;
  if (!Ja.allFinite() || !Jb.allFinite() || Ja.rows() == 0 || Ja.cols() == 0) return std::nullopt;
  Eigen::VectorXd jump = b.rows.values - a.rows.values;
  for (int i = 0; i < problem.constraints.size(); ++i)
    jump[i] /= problem.constraints.rows()[static_cast<std::size_t>(i)].scale;
  jump += Ja * a.changes - Jb * b.changes;
  const adjoint_detail::ThinSvd svd(Ja - Jb);
  const Eigen::VectorXd& all = svd.s;
  const double s = all[0], second = all.size() > 1 ? all[1] : 0;
  if (!(s > kSharp * Ja.norm()) || second > kOneRank * s) return std::nullopt;
  const Kink kink{svd.V.col(0), svd.U.col(0).dot(jump) / s};
  const double side_a = kink.normal.dot(a.changes) - kink.offset, side_b = kink.normal.dot(b.changes) - kink.offset;
  if (!(side_a * side_b < 0)) return std::nullopt;
  return kink;
}

std::vector<Kink> jumpsBetween(const EditProblem& problem, const EditPoint& a, const EditPoint& b) {
  const std::size_t events = problem.constraints.extentIn(a.motion, a.rows.times).events;
  if (events == 0 || events > kBoundariesUpTo) return {};
  const Eigen::VectorXd way = b.changes - a.changes;
  const Eigen::Index n = problem.controls.size();
  const auto byChanges = [&](const SceneGradient& gradient) { return problem.byChanges(gradient, a.changes); };
  std::vector<Kink> jumps;
  DerivativeTape tape(a.motion);
  for (const EventMargin& m : eventMargins(tape, events, {}, byChanges)) {
    const bool jumps_there = m.way == EventMargin::Way::grazes || m.way == EventMargin::Way::leaves;
    const double slope = m.gradient.norm();
    if (!jumps_there || !(slope > 0) || !std::isfinite(slope)) continue;
    const double share = -m.value / m.gradient.dot(way.head(n));
    if (!(share > 0 && share < kOnTheWay)) continue;
    Kink jump{Eigen::VectorXd::Zero(a.changes.size()), 0};
    jump.normal.head(n) = m.gradient / slope;
    jump.offset = jump.normal.dot(a.changes) - kBefore * m.value / slope;
    jumps.push_back(std::move(jump));
  }
  return jumps;
}

}  // namespace carom::editing_detail
