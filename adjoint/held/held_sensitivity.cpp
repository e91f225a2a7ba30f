// SPDX-License-Identifier: MIT
#include "adjoint/held/held_sensitivity.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/held/held_force_rates.hpp"
#include "adjoint/held/held_rates.hpp"
#include "adjoint/held/held_start_derivative.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

// Tangents are taken on in one go while a slip changes by so much of itself. Slower than kNoSlip of the unit of speed it is
// straight, if its acceleration has no more than kStillTurns of itself across it, and slower than kNoDirectionLeft in any case.
constexpr double kReach = 0.7, kNoSlip = 1e-8, kStillTurns = 1e-6, kNoDirectionLeft = 1e-11, kNeverSlips = 1e-13;

// Of what a slip has left at its end, which is rounding: what is no larger across its way there is rounding, too.
constexpr double kLeftAcross = 4;

// Of the acceleration by a force: what turns a slip less than that does not turn it.
constexpr double kNoTurn = 1e-9;

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
  F = PartialLu(M).solveColumns(F);
  const Gauss::Row weight = Gauss::integrals(1) * gauss.coefficients, weight_twice = weight * gauss.integral;
  D.topRows<3>() += h * D.middleRows<3>(6);
  for (int j = 0; j < n; ++j) {
    D.topRows<3>() += h * h * weight_twice[j] * F.middleRows<3>(kUnknown * j + 3);
    D.bottomRows<kUnknown>() += h * weight[j] * F.middleRows<kUnknown>(kUnknown * j);
  }
}

Vec3 acrossSlip(const HeldInstant& now, std::size_t k) { return now.contacts[k].n.cross(now.contacts[k].slip); }

// A stretch of a step that tangents are taken over in one go, and of each contact the direction that its slip keeps: what
// a slip u has across its direction goes as a power of |u|, also where the path itself is straight, and polynomials follow
// that only while |u| does not change by much.
struct Stretch {
  double until;
  std::vector<Vec3> straight;
};

// Where slips end with the path: its instant there.
using SlipEnds = std::optional<HeldInstant>;

// Whether a slip that comes to its end goes straight to it, as far as rounding lets anybody tell.
bool goesStraightTo(const HeldInstant& end, std::size_t k, const HeldInstant& now) {
  const double left = end.slipAt(k).norm(), across = std::abs(acrossSlip(end, k).dot(now.slipAt(k)));
  return left < kLeftAcross * now.slipAt(k).norm() && across <= kLeftAcross * left;
}

Stretch stretchFrom(const HeldPath& path, const SlipEnds& end, const HeldStep& step, double from, double t) {
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
    const bool stops = end && end->slipAt(k).norm() <= kNoDirectionLeft * path.scene().speed;
    const bool turns = rate.cross(now.slipAt(k)).norm() > kStillTurns * rate.norm() * slip && !(stops && goesStraightTo(*end, k, now));
    if (!(slip > (turns ? kNoDirectionLeft : kNoSlip) * path.scene().speed)) {
      out.straight[k] = (stops ? *end : now).contacts[k].slip;
    } else {
      const double reach = kReach * slip / rate.norm();
      if (from + 1.2 * reach < out.until) out.until = from + reach;
    }
  }
  return out;
}

// Takes the tangent at the start of a step to a time in it.
void throughStep(const HeldPath& path, const HeldInputs& inputs, const SlipEnds& end, const HeldStep& step, double t,
                 MatrixXd& D) {
  for (double from = step.start; from < t;) {
    const Stretch stretch = stretchFrom(path, end, step, from, t);
    through(path, inputs, step, from, stretch.until, stretch.straight, D);
    from = stretch.until;
  }
}

// Whether a slip ends there, or begins, so that it keeps its direction whatever it changes by.
bool hasNoDirection(const HeldPath& path, std::size_t k, double t, const HeldInstant& now) {
  const HeldStep& step = path.stepAt(t);
  return (step.length > 0 && step.frozen[k]) || !(now.slipAt(k).norm() > kNoDirectionLeft * path.scene().speed);
}

// Contacts whose slips are 0 at the end of a path: that which ends it, first, and those that come to their end with it, as
// the slips of a body do that slides and spins.
std::vector<std::size_t> contactsThatStop(const HeldPath& path, const HeldInstant& now) {
  const std::optional<std::size_t> first = path.contactThatStops();
  const auto stops = [&](std::size_t k) {
    const HeldContact& c = path.contacts()[k];
    return c.mode == HeldMode::slides && c.friction > 0 && now.slipAt(k).norm() <= kNoDirectionLeft * path.scene().speed;
  };
  if (!first || !stops(*first)) return {};
  std::vector<std::size_t> found{*first};
  for (std::size_t k = 0; k < path.contacts().size(); ++k)
    if (k != *first && stops(k)) found.push_back(k);
  return found;
}

// The tangents of slips across their ways, by all inputs: a row of each contact.
MatrixXd acrossSlips(const HeldPath& path, const HeldInputs& inputs, double t, const HeldInstant& now,
                     const std::vector<std::size_t>& contacts) {
  MatrixXd rows(contacts.size(), inputs.count);
  HeldRates rates(path.scene(), path.contacts(), inputs, path.stateAt(t), followSlips(path));
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Vec3 across = acrossSlip(now, contacts[i]);
      const auto u = lanes.body.velocityAt(lanes.contacts[contacts[i]].r);
      for (int lane = 0; lane < count; ++lane)
        rows(static_cast<Eigen::Index>(i), first + lane) = across.dot(ratesOf(u, static_cast<std::size_t>(lane)));
    }
  });
  return rows;
}

// At its end a slip has no tangent across its way: whichever way it came, it goes to 0 as a power of |u|. What is left is
// taken back by turns of the frictions of all that stop, which are all that turns them there.
void endAcross(const HeldPath& path, const HeldInputs& inputs, double t, MatrixXd& D) {
  const HeldInstant now = path.instantAt(t);
  std::vector<std::size_t> stop = contactsThatStop(path, now);
  if (stop.empty()) return;
  const HeldDynamics forces(now.body, now.contacts, path.redundant());
  const auto count = static_cast<Eigen::Index>(stop.size());
  MatrixXd turned(count, count);           // of slips, across their ways, by the turns
  Eigen::Matrix<double, 6, Eigen::Dynamic> change(6, count);  // of (v, L)
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::vector<Vec3> push = forces.answerToTurn(stop[static_cast<std::size_t>(j)], path.redundant());
    const double size = now.body.inverse_mass * push[stop[static_cast<std::size_t>(j)]].norm();
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t l = 0; l < push.size(); ++l) force += push[l], moment += now.contacts[l].r.cross(push[l]);
    change.col(j) << now.body.inverse_mass * force / size, moment / size;
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t k = stop[static_cast<std::size_t>(i)];
      turned(i, j) = acrossSlip(now, k).dot(forces.responseAt(now.contacts[k].r, push)) / size;
    }
  }
  const FullLu turns(turned, kNoTurn);
  if (!(std::abs(turned(0, 0)) > kNoTurn)) return;  // it goes round another
  const MatrixXd left = HeldInputs::chained(acrossSlips(path, inputs, t, now, stop), D);
  const MatrixXd turn = turns.solveColumns(left);
  if ((turned * turn - left).norm() <= kNoTurn * left.norm()) {  // of four corners two turn the rest
    D.bottomRows<6>() -= change * turn;
  } else {  // those that do not turn by themselves follow the first
    D.bottomRows<6>() -= change.col(0) * left.row(0) / turned(0, 0);
  }
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
  HeldStartDerivative start = heldStartDerivative(path, inputs);
  MatrixXd& D = start.state;
  SlipEnds end;
  if (path.contactThatStops()) end = path.instantAt(path.end()->time);
  for (const HeldStep& step : path.allSteps()) {
    if (!(step.length > 0) || !(step.start < t)) break;
    const bool last = &step == &path.allSteps().back();
    throughStep(path, inputs, end, step, last ? t : std::min(t, step.start + step.length), D);
  }
  endAcross(path, inputs, t, D);
  if (!start.time.isZero(0)) D -= asVector(path.rateAt(t)) * start.time;
  return D;
}

HeldRow guardRow(const HeldPath& path, const HeldInputs& inputs, HeldGuard guard, double t) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const HeldInstant end = path.instantAt(t);
  if (guard.cause == TransitionCause::leaves)  // the border there: a circle's has gone round with the contact
    for (HeldGuard& now : guardsOf(path.scene(), path.contacts(), path.stateAt(t)))
      if (now.isSame(guard)) guard = std::move(now);
  std::vector<Vec3> slip = followSlips(path);
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (path.contacts()[i].mode == HeldMode::slides && hasNoDirection(path, i, t, end)) slip[i] = end.contacts[i].slip;
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
