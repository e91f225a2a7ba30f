// SPDX-License-Identifier: MIT
#include "adjoint/held/held_sensitivity.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/held/held_force_rates.hpp"
#include "adjoint/held/held_rates.hpp"
#include "adjoint/held/held_start.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

std::vector<Vec3> followSlips(const HeldPath& path) { return std::vector<Vec3>(path.contacts().size(), Vec3::Zero()); }

// Below this share of gravity a slip that begins has no acceleration: the contact came to the limit of friction there.
constexpr double kNoStart = 1e-9;

// Tangents are taken on in one go while a slip changes by so much of itself. Slower than kNoSlip of the unit of speed it is
// straight, if its acceleration has no more than kStillTurns of itself across it, and slower than kNoDirectionLeft in any case.
constexpr double kReach = 0.7, kNoSlip = 1e-8, kStillTurns = 1e-6, kNoDirectionLeft = 1e-11, kNeverSlips = 1e-13;

// Of the acceleration by a force: what turns a slip less than that does not turn it.
constexpr double kNoTurn = 1e-9;

HeldVector asColumn(const StateDerivative& d) { return (HeldVector() << d.x, d.theta, d.v, d.L).finished(); }

// The derivative of the start, 12 rows, and that of its time. Slips that begin with an acceleration u' are 0 at the start,
// whenever it is; what the state at a fixed time has of them tells how far the start is moved: dt = -u' . du / |u'|^2.
struct StartDerivative {
  MatrixXd state;
  HeldRow time;
};

// Accelerations of slips that begin, in the rows of heldRows.
Eigen::VectorXd rateOfBeginningSlips(const HeldPath& path, Eigen::Index rows) {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(rows);
  const HeldInstant now = path.instantAt(path.start());
  const HeldDynamics forces(now.body, now.contacts, path.redundant());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const HeldContact& c = path.contacts()[k];
    if (c.begins) rate.segment<3>(row) = forces.slipRate(k);
    row += c.stands() ? 3 : 1;
  }
  return rate;
}

// What the impulses that took away what was left of speeds do to v and L: they turn with the normals of contacts that
// slide, and act where the contacts are. How large they are follows from the speeds, which stay 0.
struct Stopped {
  V3<HeldLanes::Number> v = V3<HeldLanes::Number>::Zero(), L = V3<HeldLanes::Number>::Zero();
};

Stopped stoppedBy(const HeldPath& path, const HeldLanes& lanes) {
  Stopped sum;
  for (std::size_t k = 0; k < path.stopped().size(); ++k) {
    const HeldContact& c = path.contacts()[k];
    const Vec3& p = path.stopped()[k];
    const auto& n = lanes.contacts[k].n;
    V3<HeldLanes::Number> impulse = p.cast<HeldLanes::Number>();
    if (!c.stands()) impulse = n * HeldLanes::Number(p.dot(valuesOf(n)));
    sum.v += impulse * lanes.body.inverse_mass;
    sum.L += lanes.contacts[k].r.cross(impulse);
  }
  return sum;
}

// Of the start as it is projected (held_start.cpp).
StartDerivative startDerivative(const HeldPath& path, const HeldInputs& inputs) {
  const std::vector<HeldContact>& contacts = path.contacts();
  const State start = path.stateAt(path.start());
  HeldRates rates(path.scene(), contacts, inputs, start, followSlips(path));
  const HeldInstant& now = rates.now();
  const auto C = heldRows(now, contacts);
  MatrixXd gaps(contacts.size(), inputs.count), speeds(C.rows(), inputs.count), stopped(6, inputs.count);
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const auto taken = stoppedBy(path, lanes);
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      stopped.col(first + lane) << ratesOf(taken.v, at), ratesOf(taken.L, at);
      Eigen::Index row = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        gaps(static_cast<Eigen::Index>(k), first + lane) = lanes.gap[k].rate[at];
        const auto& c = lanes.contacts[k];
        const auto u = lanes.body.velocityAt(c.r);
        if (contacts[k].stands()) {
          speeds.block<3, 1>(row, first + lane) = ratesOf(u, at);
          row += 3;
        } else {
          speeds(row++, first + lane) = c.n.dot(u).rate[at];
        }
      }
    }
  });
  StartDerivative out{MatrixXd::Zero(12, inputs.count), HeldRow::Zero(inputs.count)};
  MatrixXd& D = out.state;
  D.leftCols<12>().setIdentity();
  D.topRows<6>() -= undoing(now, gapRows(now)) * gaps;
  // At its own time: HeldPath::startRate takes along what a later start does to it.
  MatrixXd taken = stopped.leftCols<12>() * D;
  taken.rightCols(inputs.count - 12) += stopped.rightCols(inputs.count - 12);
  D.bottomRows<6>() += taken;
  const auto changeOf = [&](const MatrixXd& tangent) {
    MatrixXd change = speeds.leftCols<12>() * tangent;
    change.rightCols(inputs.count - 12) += speeds.rightCols(inputs.count - 12);
    return change;
  };
  MatrixXd change = changeOf(D);
  const Eigen::VectorXd slip_rate = rateOfBeginningSlips(path, C.rows());
  if (slip_rate.norm() > kNoStart * path.scene().gravity.norm()) {
    out.time = -(slip_rate.transpose() * change) / slip_rate.squaredNorm();
    D += asColumn(path.rateAt(path.start())) * out.time;
    change = changeOf(D);
  }
  const MatrixXd undone = undoing(now, C) * change;
  const Mat3 R = start.q.toRotationMatrix(), J = R * path.scene().model->inertia.asDiagonal() * R.transpose();
  D.middleRows<3>(6) -= undone.topRows<3>();
  D.bottomRows<3>() -= J * undone.bottomRows<3>();
  return out;
}

// Slopes of the tangent at one node, by the tangent of the state there and the other inputs: 12 rows.
MatrixXd slopeRates(const HeldPath& path, const HeldInputs& inputs, const State& state, const std::vector<Vec3>& slip) {
  MatrixXd G(12, inputs.count);
  HeldRates rates(path.scene(), path.contacts(), inputs, state, slip);
  const HeldForceRates of_forces(rates.now(), path.redundant());
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const ForceLanes forces = of_forces.in(lanes);
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      G.col(first + lane) << ratesOf(lanes.body.v, at), ratesOf(lanes.body.omega, at), ratesOf(forces.acceleration, at),
          ratesOf(forces.moment, at);
    }
  });
  // R = exp(theta) R0 turns with omega: theta' = omega x theta + d(omega)
  G.block<3, 3>(3, 3) += skew(rates.now().body.omega);
  return G;
}

// Takes the tangent from one time of a step to another. `straight`: of each contact the direction that its slip keeps.
// As x' = v, only the slopes F of theta, v and L are unknowns: with the tangent D of the start, A the integrals from it to the
// nodes, and G the slopes by x, by the others and by the other inputs,
//   F = G_x (D_x + h node D_v + h^2 A^2 F_v) + G_others (D + h A F) + G_inputs.
void through(const HeldPath& path, const HeldInputs& inputs, const HeldStep& step, double from, double to,
             const std::vector<Vec3>& straight, MatrixXd& D) {
  constexpr int n = Gauss::kNodes, kUnknown = 9;
  const Gauss& gauss = Gauss::get();
  const Gauss::Square twice = gauss.integral * gauss.integral;
  const double h = to - from;
  const Eigen::Index columns = inputs.count;
  MatrixXd M = MatrixXd::Identity(kUnknown * n, kUnknown * n), F(kUnknown * n, columns), moved = D;
  for (int i = 0; i < n; ++i) {
    const MatrixXd G = slopeRates(path, inputs, step.stateAt(from + gauss.node[i] * h), straight).bottomRows<kUnknown>();
    moved.topRows<3>() = D.topRows<3>() + gauss.node[i] * h * D.middleRows<3>(6);
    F.middleRows<kUnknown>(kUnknown * i) = G.leftCols<12>() * moved;
    F.middleRows<kUnknown>(kUnknown * i).rightCols(columns - 12) += G.rightCols(columns - 12);
    for (int j = 0; j < n; ++j) {
      auto block = M.block<kUnknown, kUnknown>(kUnknown * i, kUnknown * j);
      block -= h * gauss.integral(i, j) * G.middleCols<kUnknown>(3);
      block.middleCols<3>(3) -= h * h * twice(i, j) * G.leftCols<3>();
    }
  }
  F = M.partialPivLu().solve(F);
  const Gauss::Row weight = Gauss::integrals(1) * gauss.coefficients, weight_twice = weight * gauss.integral;
  D.topRows<3>() += h * D.middleRows<3>(6);
  for (int j = 0; j < n; ++j) {
    D.topRows<3>() += h * h * weight_twice[j] * F.middleRows<3>(kUnknown * j + 3);
    D.bottomRows<kUnknown>() += h * weight[j] * F.middleRows<kUnknown>(kUnknown * j);
  }
}

// A stretch of a step that tangents are taken over in one go, and of each contact the direction that its slip keeps: what
// a slip u has across its direction goes as a power of |u|, also where the path itself is straight, and polynomials follow
// that only while |u| does not change by much.
struct Stretch {
  double until;
  std::vector<Vec3> straight;
};

Stretch stretchFrom(const HeldPath& path, const HeldStep& step, double from, double t) {
  const HeldInstant now = path.instantAt(from);
  const HeldDynamics forces(now.body, now.contacts, path.redundant());
  Stretch out{t, followSlips(path)};
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const HeldContact& c = path.contacts()[k];
    if (c.mode != HeldMode::slides || !(c.friction > 0)) continue;
    const double slip = now.slipAt(k).norm();
    if (step.frozen[k]) {
      out.straight[k] = now.contacts[k].slip;
      continue;
    }
    if (c.begins && !(from > path.start())) continue;
    const Vec3 rate = forces.slipRate(k);
    const bool turns = rate.cross(now.slipAt(k)).norm() > kStillTurns * rate.norm() * slip;
    if (!(slip > (turns ? kNoDirectionLeft : kNoSlip) * path.scene().speed)) {
      out.straight[k] = (path.contactThatStops() == k ? path.instantAt(path.end()->time) : now).contacts[k].slip;
    } else {
      const double reach = kReach * slip / rate.norm();
      if (from + 1.2 * reach < out.until) out.until = from + reach;
    }
  }
  return out;
}

// Takes the tangent at the start of a step to a time in it.
void throughStep(const HeldPath& path, const HeldInputs& inputs, const HeldStep& step, double t, MatrixXd& D) {
  for (double from = step.start; from < t;) {
    const Stretch stretch = stretchFrom(path, step, from, t);
    through(path, inputs, step, from, stretch.until, stretch.straight, D);
    from = stretch.until;
  }
}

// At its end a slip has no tangent across its way: whichever way it came, it goes to 0 as a power of |u|. Where it is
// straight, what is left is taken back by a turn of its friction, which is all that turns it there.
void endAcross(const HeldPath& path, const HeldInputs& inputs, double t, MatrixXd& D) {
  const std::optional<std::size_t> stops = path.contactThatStops();
  if (!stops) return;
  const std::size_t k = *stops;
  const HeldInstant now = path.instantAt(t);
  if (!(now.slipAt(k).norm() <= kNoDirectionLeft * path.scene().speed) || !(path.contacts()[k].friction > 0)) return;
  const Vec3 across = now.contacts[k].n.cross(now.contacts[k].slip);
  HeldRow row(inputs.count);
  HeldRates rates(path.scene(), path.contacts(), inputs, path.stateAt(t), followSlips(path));
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const auto u = lanes.body.velocityAt(lanes.contacts[k].r);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = across.dot(ratesOf(u, static_cast<std::size_t>(lane)));
  });
  HeldRow left = row.leftCols<12>() * D;
  left.rightCols(inputs.count - 12) += row.rightCols(inputs.count - 12);
  const HeldDynamics forces(now.body, now.contacts, path.redundant());
  const std::vector<Vec3> push = forces.answerToTurn(k, path.redundant());
  const Vec3 turned = forces.responseAt(now.contacts[k].r, push);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t l = 0; l < push.size(); ++l) force += push[l], moment += now.contacts[l].r.cross(push[l]);
  if (!(std::abs(across.dot(turned)) > kNoTurn * now.body.inverse_mass * push[k].norm())) return;  // it goes round another
  left /= across.dot(turned);
  D.middleRows<3>(6) -= now.body.inverse_mass * force * left;
  D.bottomRows<3>() -= moment * left;
}

// Where supports are redundant, friction may be at its limit without any slip that begins.
void requireSlips(const HeldPath& path) {
  const HeldStep& first = path.allSteps().front();
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    if (!path.contacts()[k].begins || !(first.length > 0)) continue;
    double fastest = 0;
    for (const double node : Gauss::get().node)
      fastest = std::max(fastest, path.instantAt(first.start + node * first.length).slipAt(k).norm());
    if (!(fastest > kNeverSlips * path.scene().speed))
      throw NotComputable("the derivative of a contact at the limit of friction that does not slip is not determined");
  }
}

}  // namespace

MatrixXd heldSensitivity(const HeldPath& path, const HeldInputs& inputs, double t) {
  requireSlips(path);
  StartDerivative start = startDerivative(path, inputs);
  MatrixXd& D = start.state;
  for (const HeldStep& step : path.allSteps()) {
    if (!(step.length > 0) || !(step.start < t)) break;
    const bool last = &step == &path.allSteps().back();
    throughStep(path, inputs, step, last ? t : std::min(t, step.start + step.length), D);
  }
  endAcross(path, inputs, t, D);
  if (!start.time.isZero(0)) D -= asColumn(path.rateAt(t)) * start.time;
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
  const HeldForceRates of_forces(rates.now(), path.redundant());
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const HeldLanes::Number value = guardRateOf(guard, path, inputs, of_forces, lanes, first, count);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = value.rate[static_cast<std::size_t>(lane)];
  });
  return row;
}

}  // namespace carom::adjoint_detail
