// SPDX-License-Identifier: MIT
#include "adjoint/group/group_sensitivity.hpp"

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/constrained/constrained_slip_ends.hpp"
#include "adjoint/constrained/straight_slips.hpp"
#include "adjoint/group/group_guards.hpp"
#include "adjoint/group/group_limit.hpp"
#include "adjoint/group/group_slip_ends.hpp"
#include "adjoint/group/group_stretches.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kNeverSlips = 1e-13;     // of the unit of speed
constexpr double kSameBeginning = 1e-5;   // see requireSlips

// Where supports are redundant, friction may be at its limit without any slip that begins. And one that begins has to go as its path was told
// to: it has no derivative where another way was found.
void requireSlips(const GroupPath& path) {
  if (path.allSteps().empty() || !(path.allSteps().front().length > 0)) return;
  const GroupStep& first = path.allSteps().front();
  std::vector<Vec3> begins;
  first.placeSlips(first.start, begins);
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const GroupContact& c = path.contacts()[k];
    if (!c.begins || !c.turns()) continue;
    double fastest = 0;
    for (const double node : Gauss::get().node)
      fastest = std::max(fastest, path.instantAt(first.start + node * first.length).contacts[k].slipVelocity().norm());
    if (!(fastest > kNeverSlips * path.scene().speed)) throw NotComputable("the derivative of a sticking contact at its friction limit is not unique");
    if (!((begins[k] - c.slip).norm() <= kSameBeginning))
      throw NotComputable("a slip begins in another direction than that in which friction held it");
  }
}

// Takes the tangent over a stretch, as that of one body: with the slopes F of theta, v and L of all members as unknowns, the tangent D of the
// start, and G the slopes by x, by the others and by the other inputs,
//   F = G_x (D_x + h node D_v + h^2 A^2 F_v) + G_others (D + h A F) + G_inputs.
void through(const GroupPath& path, const GroupInputs& inputs, const GroupStretch& stretch, const GroupStartDerivative& start, MatrixXd& D) {
  constexpr int n = Gauss::kNodes;
  const Gauss& gauss = Gauss::get();
  const Gauss::Square twice = gauss.integral * gauss.integral;
  const double h = stretch.until - stretch.from;
  const Index members = rowAt(path.scene().members.size()), unknown = 9 * members, states = 12 * members;
  MatrixXd M = MatrixXd::Identity(unknown * n, unknown * n), F(unknown * n, inputs.count), moved = D;
  for (int i = 0; i < n; ++i) {
    const double t = stretch.from + gauss.node[i] * h;
    const MatrixXd all = slopeRates(path, inputs, stretch.step->statesAt(t), t, stretch.straight);
    MatrixXd G(unknown, inputs.count);
    for (Index m = 0; m < members; ++m) {
      G.middleRows<9>(9 * m) = all.middleRows<9>(12 * m + 3);
      moved.middleRows<3>(12 * m) = D.middleRows<3>(12 * m) + gauss.node[i] * h * D.middleRows<3>(12 * m + 6);
    }
    F.middleRows(unknown * i, unknown) = G.leftCols(states) * moved;
    F.middleRows(unknown * i, unknown).rightCols(inputs.count - states) += G.rightCols(inputs.count - states);
    if (start.shift.size() > 0) F.middleRows(unknown * i, unknown) += (G * start.shift) * start.time;
    for (int j = 0; j < n; ++j)
      for (Index m = 0; m < members; ++m) {
        auto block = M.block(unknown * i, unknown * j + 9 * m, unknown, 9);
        block -= h * gauss.integral(i, j) * G.middleCols<9>(12 * m + 3);
        block.middleCols<3>(3) -= h * h * twice(i, j) * G.middleCols<3>(12 * m);
      }
  }
  F = PartialLu(M).solveColumns(F);
  const Gauss::Row weight = Gauss::integrals(1) * gauss.coefficients, weight_twice = weight * gauss.integral;
  for (Index m = 0; m < members; ++m) {
    D.middleRows<3>(12 * m) += h * D.middleRows<3>(12 * m + 6);
    for (int j = 0; j < n; ++j) {
      D.middleRows<3>(12 * m) += h * h * weight_twice[j] * F.middleRows<3>(unknown * j + 9 * m + 3);
      D.middleRows<9>(12 * m + 3) += h * weight[j] * F.middleRows<9>(unknown * j + 9 * m);
    }
  }
}

// Whether a slip ends there, or begins, so that it keeps its direction whatever it changes by.
bool hasNoDirection(const GroupPath& path, std::size_t k, double t, const GroupInstant& now) {
  if (path.allSteps().empty()) return true;
  const GroupStep& step = path.stepAt(t);
  return (step.length > 0 && step.frozen[k]) || !(now.contacts[k].slipVelocity().norm() > kNoDirectionLeft * path.scene().speed);
}

}  // namespace

MatrixXd groupSensitivity(const GroupPath& path, const GroupInputs& inputs, double t) {
  requireSlips(path);
  GroupStartDerivative start = groupStartDerivative(path, inputs);
  MatrixXd& D = start.state;
  for (const GroupStretch& stretch : stretchesUntil(path, t)) through(path, inputs, stretch, start, D);
  if (const auto turns = slipTurns(path, inputs, t)) {
    MatrixXd across = inputs.chained(turns->across, D);
    start.addShift(turns->across, across);
    D -= turns->change * SlipTurns::takingBack(turns->turned, across);
  }
  if (!start.time.isZero(0)) D -= path.ratesAt(t) * start.time;
  return D;
}

Eigen::RowVectorXd guardRow(const GroupPath& path, const GroupInputs& inputs, ConstrainedGuard guard, double t) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const GroupInstant end = path.instantAt(t);
  const std::vector<State> states = path.statesAt(t);
  if (guard.cause == TransitionCause::leaves)  // the border there: a circle's has gone round with the contact
    for (ConstrainedGuard& now : guardsOf(path.scene(), path.contacts(), states, t))
      if (now.isSame(guard)) guard = std::move(now);
  std::vector<Vec3> slip = followSlips(path);
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (path.contacts()[i].mode == ContactMode::slides && hasNoDirection(path, i, t, end)) slip[i] = end.contacts[i].slip;
  if (guard.cause == TransitionCause::sticks) slip[k] = end.contacts[k].slip;
  GroupRates rates(path.scene(), path.contacts(), inputs, states, t, slip);
  const GroupForceRates of_forces(path.contacts(), rates.now(), path.redundant());
  std::optional<GroupLimit> limit;
  const bool of_force = guard.cause == TransitionCause::lifts || guard.cause == TransitionCause::slips;
  if (of_force && path.redundant() && path.contacts()[k].mode == ContactMode::sticks)
    limit.emplace(path.scene(), path.contacts(), rates.now(), of_forces.forces());
  Eigen::RowVectorXd row(inputs.count);
  rates.each([&](const GroupLanes& lanes, int first, int count) {
    const GroupLanes::Number value = guardRateOf(guard, path.contacts(), inputs, of_forces, limit, rates, lanes, first, count);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = value.rate[static_cast<std::size_t>(lane)];
  });
  return row;
}

}  // namespace carom::adjoint_detail
