// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_sensitivity.hpp"

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/constrained/constrained_force_rates.hpp"
#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/constrained/constrained_slip_ends.hpp"
#include "adjoint/constrained/constrained_start_derivative.hpp"
#include "adjoint/constrained/constrained_stretches.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/gauss.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

constexpr int kStretchNodes = Gauss::kNodes, kUnknown = 9;

constexpr double kNeverSlips = 1e-13;  // of the unit of speed

// A slip begins in the direction that the polynomials of its path give there, to so much.
constexpr double kSameBeginning = 1e-5;

// Where supports are redundant, friction may be at its limit without any slip that begins. And one that begins has to go as
// its path was told to: it has no derivative where another way was found.
void requireSlips(const ConstrainedPath& path) {
  const ConstrainedStep& first = path.allSteps().front();
  std::vector<Vec3> begins;
  if (first.length > 0) first.placeSlips(first.start, begins);
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    if (!path.contacts()[k].begins || !(first.length > 0)) continue;
    double fastest = 0;
    for (const double node : Gauss::get().node)
      fastest = std::max(fastest, path.instantAt(first.start + node * first.length).slipAt(k).norm());
    if (!(fastest > kNeverSlips * path.scene().speed))
      throw NotComputable("the derivative of a sticking contact at its friction limit is not unique");
    if (!((begins[k] - path.contacts()[k].slip).norm() <= kSameBeginning))
      throw NotComputable("a slip begins in another direction than that in which friction held it");
  }
}

// Takes the tangent over a stretch.
// As x' = v, only the slopes F of theta, v and L are unknowns: with the tangent D of the start, A the integrals from it to the
// nodes, and G the slopes by x, by the others and by the other inputs,
//   F = G_x (D_x + h node D_v + h^2 A^2 F_v) + G_others (D + h A F) + G_inputs.
void through(const ConstrainedPath& path, const ConstrainedInputs& inputs, const ConstrainedStretch& stretch,
             const ConstrainedStartDerivative& start, MatrixXd& D) {
  constexpr int n = kStretchNodes;
  const Gauss& gauss = Gauss::get();
  const Gauss::Square twice = gauss.integral * gauss.integral;
  const double h = stretch.until - stretch.from;
  const Eigen::Index columns = inputs.count;
  MatrixXd M = MatrixXd::Identity(kUnknown * n, kUnknown * n), F(kUnknown * n, columns), moved = D;
  for (int i = 0; i < n; ++i) {
    const double t = stretch.from + gauss.node[i] * h;
    const MatrixXd G = slopeRates(path, inputs, stretch.step->stateAt(t), t, stretch.straight).bottomRows<kUnknown>();
    moved.topRows<3>() = D.topRows<3>() + gauss.node[i] * h * D.middleRows<3>(6);
    F.middleRows<kUnknown>(kUnknown * i) = G.leftCols<12>() * moved;
    F.middleRows<kUnknown>(kUnknown * i).rightCols(columns - 12) += G.rightCols(columns - 12);
    if (start.shift.size() > 0) F.middleRows<kUnknown>(kUnknown * i) += (G * start.shift) * start.time;
    for (int j = 0; j < n; ++j) {
      auto block = M.block<kUnknown, kUnknown>(kUnknown * i, kUnknown * j);
      block -= h * gauss.integral(i, j) * G.middleCols<kUnknown>(3);
      block.middleCols<3>(3) -= h * h * twice(i, j) * G.leftCols<3>();
    }
  }
  F = PartialLu(M).solveColumns(F);
  const Gauss::Row weight = Gauss::integrals(1) * gauss.coefficients, weight_twice = weight * gauss.integral;
  D.topRows<3>() += h * D.middleRows<3>(6);
  for (int j = 0; j < n; ++j) {
    D.topRows<3>() += h * h * weight_twice[j] * F.middleRows<3>(kUnknown * j + 3);
    D.bottomRows<kUnknown>() += h * weight[j] * F.middleRows<kUnknown>(kUnknown * j);
  }
}

// Whether a slip ends there, or begins, so that it keeps its direction whatever it changes by.
bool hasNoDirection(const ConstrainedPath& path, std::size_t k, double t, const ConstrainedInstant& now) {
  const ConstrainedStep& step = path.stepAt(t);
  return (step.length > 0 && step.frozen[k]) || !(now.slipAt(k).norm() > kNoDirectionLeft * path.scene().speed);
}

}  // namespace

MatrixXd constrainedSensitivity(const ConstrainedPath& path, const ConstrainedInputs& inputs, double t) {
  requireSlips(path);
  ConstrainedStartDerivative start = constrainedStartDerivative(path, inputs);
  MatrixXd& D = start.state;
  for (const ConstrainedStretch& stretch : stretchesUntil(path, t)) through(path, inputs, stretch, start, D);
  if (const auto turns = slipTurns(path, inputs, t)) {
    MatrixXd across = ConstrainedInputs::chained(turns->across, D);
    start.addShift(turns->across, across);
    D.bottomRows<6>() -= turns->change * turns->takingBack(across);
  }
  if (!start.time.isZero(0)) D -= asVector(path.rateAt(t)) * start.time;
  return D;
}

ConstrainedRow guardRow(const ConstrainedPath& path, const ConstrainedInputs& inputs, ConstrainedGuard guard, double t) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const ConstrainedInstant end = path.instantAt(t);
  if (guard.cause == TransitionCause::leaves)  // the border there: a circle's has gone round with the contact
    for (ConstrainedGuard& now : guardsOf(path.scene(), path.contacts(), path.stateAt(t), t))
      if (now.isSame(guard)) guard = std::move(now);
  std::vector<Vec3> slip = followSlips(path);
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (path.contacts()[i].mode == ContactMode::slides && hasNoDirection(path, i, t, end)) slip[i] = end.contacts[i].slip;
  if (guard.cause == TransitionCause::sticks) slip[k] = end.contacts[k].slip;
  ConstrainedRow row(inputs.count);
  ConstrainedRates rates(path.scene(), path.contacts(), inputs, path.stateAt(t), t, slip);
  const ConstrainedForceRates of_forces(rates.now(), path.redundant());
  rates.each([&](const ConstrainedLanes& lanes, int first, int count) {
    const ConstrainedLanes::Number value = guardRateOf(guard, path, inputs, of_forces, lanes, first, count, rates);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = value.rate[static_cast<std::size_t>(lane)];
  });
  return row;
}

}  // namespace carom::adjoint_detail
