// SPDX-License-Identifier: MIT
#include "adjoint/held/held_sensitivity.hpp"

#include "adjoint/held/held_rates.hpp"
#include "adjoint/held/held_start.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

std::vector<Vec3> followSlips(const HeldPath& path) { return std::vector<Vec3>(path.contacts().size(), Vec3::Zero()); }

// The start as it is projected (held_start.cpp): 12 rows.
MatrixXd startDerivative(const HeldPath& path, const HeldInputs& inputs) {
  const std::vector<HeldContact>& contacts = path.contacts();
  const State start = path.stateAt(path.start());
  HeldRates rates(path.scene(), contacts, inputs, start, followSlips(path));
  const HeldInstant& now = rates.now();
  const auto C = heldRows(now, contacts);
  MatrixXd gaps(contacts.size(), inputs.count), speeds(C.rows(), inputs.count);
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      Eigen::Index row = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        gaps(static_cast<Eigen::Index>(k), first + lane) = lanes.gap[k].rate[at];
        const auto& c = lanes.contacts[k];
        const auto u = lanes.body.velocityAt(c.r);
        if (contacts[k].mode == HeldMode::sticks || contacts[k].begins) {
          speeds.block<3, 1>(row, first + lane) = ratesOf(u, at);
          row += 3;
        } else {
          speeds(row++, first + lane) = c.n.dot(u).rate[at];
        }
      }
    }
  });
  MatrixXd D = MatrixXd::Zero(12, inputs.count);
  D.leftCols<12>().setIdentity();
  D.topRows<6>() -= undoing(now, gapRows(now)) * gaps;
  MatrixXd change = speeds.leftCols<12>() * D;
  change.rightCols(inputs.count - 12) += speeds.rightCols(inputs.count - 12);
  const MatrixXd undone = undoing(now, C) * change;
  const Mat3 R = start.q.toRotationMatrix(), J = R * path.scene().model->inertia.asDiagonal() * R.transpose();
  D.middleRows<3>(6) -= undone.topRows<3>();
  D.bottomRows<3>() -= J * undone.bottomRows<3>();
  return D;
}

// Slopes of the tangent at one node, by the tangent of the state there and the other inputs: 12 rows.
MatrixXd slopeRates(const HeldPath& path, const HeldInputs& inputs, const State& state, const std::vector<Vec3>& slip) {
  MatrixXd G(12, inputs.count);
  HeldRates rates(path.scene(), path.contacts(), inputs, state, slip);
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const HeldDynamics<HeldLanes::Number> forces(lanes.body, lanes.contacts, path.redundant());
    const V3<HeldLanes::Number> a = forces.acceleration(), m = forces.moment();
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      G.col(first + lane) << ratesOf(lanes.body.v, at), ratesOf(lanes.body.omega, at), ratesOf(a, at), ratesOf(m, at);
    }
  });
  // R = exp(theta) R0 turns with omega: theta' = omega x theta + d(omega)
  G.block<3, 3>(3, 3) += skew(rates.now().body.omega);
  return G;
}

// Takes the tangent at the start of a step to a time in it.
void throughStep(const HeldPath& path, const HeldInputs& inputs, const HeldStep& step, double t, MatrixXd& D) {
  constexpr int n = Gauss::kNodes;
  const Gauss& gauss = Gauss::get();
  const double h = step.length;
  const Eigen::Index columns = inputs.count;
  MatrixXd M = MatrixXd::Identity(12 * n, 12 * n), F(12 * n, columns);
  for (int i = 0; i < n; ++i) {
    const State state = step.stateAt(step.start + gauss.node[i] * h);
    std::vector<Vec3> slip = followSlips(path);
    for (std::size_t k = 0; k < slip.size(); ++k)
      if (step.frozen[k]) slip[k] = step.slip[k][static_cast<std::size_t>(i)];
    const MatrixXd G = slopeRates(path, inputs, state, slip);
    F.middleRows<12>(12 * i) = G.leftCols<12>() * D;
    F.middleRows<12>(12 * i).rightCols(columns - 12) += G.rightCols(columns - 12);
    for (int j = 0; j < n; ++j) M.block<12, 12>(12 * i, 12 * j) -= h * gauss.integral(i, j) * G.leftCols<12>();
  }
  F = M.partialPivLu().solve(F);
  const Gauss::Row weight = Gauss::integrals((t - step.start) / h) * gauss.coefficients;
  for (int j = 0; j < n; ++j) D += h * weight[j] * F.middleRows<12>(12 * j);
}

}  // namespace

MatrixXd heldSensitivity(const HeldPath& path, const HeldInputs& inputs, double t) {
  MatrixXd D = startDerivative(path, inputs);
  for (const HeldStep& step : path.allSteps()) {
    if (!(step.length > 0) || !(step.start < t)) break;
    const bool last = &step == &path.allSteps().back();
    throughStep(path, inputs, step, last ? t : std::min(t, step.start + step.length), D);
  }
  return D;
}

HeldRow guardRow(const HeldPath& path, const HeldInputs& inputs, HeldGuard guard, double t) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const HeldInstant end = path.instantAt(t);
  if (guard.cause == TransitionCause::leaves)  // the border there: a circle's has gone round with the contact
    for (HeldGuard& now : guardsOf(path.scene(), path.contacts(), path.stateAt(t)))
      if (now.isSame(guard)) guard = std::move(now);
  std::vector<Vec3> slip = followSlips(path);
  for (std::size_t i = 0; i < slip.size(); ++i)  // those without a direction of their own keep that of the last node
    if (path.contacts()[i].mode == HeldMode::slides && end.slipAt(i).norm() < 1e-7 * path.scene().speed)
      slip[i] = end.contacts[i].slip;
  if (guard.cause == TransitionCause::sticks) slip[k] = end.contacts[k].slip;
  HeldRow row(inputs.count);
  HeldRates rates(path.scene(), path.contacts(), inputs, path.stateAt(t), slip);
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const HeldLanes::Number value = guardRateOf(guard, path, inputs, lanes, first, count);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = value.rate[static_cast<std::size_t>(lane)];
  });
  return row;
}

}  // namespace carom::adjoint_detail
