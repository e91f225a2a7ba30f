// SPDX-License-Identifier: MIT
#include "adjoint/impact/impact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "adjoint/base/errors.h"
#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/single_laws.hpp"
#include "adjoint/impact/double_double_impact.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {

using Rate = Dual<1>;

ImpactInputs<double> impactInputs(const Event& event, const std::vector<BodyModel>& models) {
  ImpactInputs<double> in;
  in.bodies.reserve(event.participants.size());
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    const bool moves = !model.kinematic && !p.stays;
    const bool stands = p.stays && p.before.v.isZero(0) && p.before.L.isZero(0);
    in.bodies.push_back({!moves, stands, moves ? model.inverse_mass : 0, p.before.q.toRotationMatrix(),
                         model.inverse_inertia.asDiagonal(), p.before.x, p.before.v, p.before.L});
  }
  for (const Contact& c : event.contacts)
    in.contacts.push_back(
        {participantOf(event, c.a), participantOf(event, c.b), c.at.point, c.impulse_normal, c.pair, c.kept,
         c.surface_velocity, !c.surface_velocity.isZero(0)});
  return in;
}

namespace {

template <class Values, class Rates>
auto along(const Values& values, const Rates& rates) {
  auto both = values.template cast<Rate>().eval();
  setRates(both, rates, 0);
  return both;
}
Rate along(double value, double rate) {
  Rate both(value);
  both.rate[0] = rate;
  return both;
}

ImpactInputs<Rate> along(const ImpactInputs<double>& in, const std::vector<StateDerivative>& dbefore,
                         const std::vector<Eigen::Matrix<double, 7, 1>>& dcontact, const std::vector<Vec3>& dsurface,
                         const std::vector<PairCoefficients>& dpair, const std::vector<BodyModelDerivative>& dmodel) {
  ImpactInputs<Rate> both;
  for (std::size_t i = 0; i < in.bodies.size(); ++i) {
    const auto& b = in.bodies[i];
    const StateDerivative& d = dbefore[i];
    both.bodies.push_back({b.kinematic, b.stays, along(b.inverse_mass, -dmodel[i].mass * b.inverse_mass * b.inverse_mass),
                           along(b.R, Mat3(skew(d.theta) * b.R)),
                           along(b.D, Mat3(-b.D * dmodel[i].inertiaTensor() * b.D)), along(b.x, d.x), along(b.v, d.v),
                           along(b.L, d.L)});
  }
  for (std::size_t k = 0; k < in.contacts.size(); ++k) {
    const auto& c = in.contacts[k];
    both.contacts.push_back({c.a, c.b, along(c.point, Vec3(dcontact[k].tail<3>())),
                             along(c.normal, Vec3(dcontact[k].segment<3>(1))),
                             {along(c.pair.elasticity, dpair[k].elasticity), along(c.pair.friction, dpair[k].friction),
                              along(c.pair.tangential_elasticity, dpair[k].tangential_elasticity)},
                             c.kept, along(c.surface, dsurface[k]), c.surface_moves});
  }
  return both;
}

}  // namespace

std::vector<StateDerivative> impactTangent(const ImpactInputs<double>& inputs, bool wide,
                                           const std::vector<StateDerivative>& dbefore,
                                           const std::vector<Eigen::Matrix<double, 7, 1>>& dcontact,
                                           const std::vector<Vec3>& dsurface,
                                           const std::vector<PairCoefficients>& dpair,
                                           const std::vector<BodyModelDerivative>& dmodel) {
  ImpactInputs<Rate> both = along(inputs, dbefore, dcontact, dsurface, dpair, dmodel);
  std::vector<Velocities<Rate>> after;
  if (wide) {
    after = doubleDoubleImpact(both).after;
  } else {
    const ImpactPass<Rate> pass(std::move(both));
    after = pass.after(pass.solve().P);
  }
  std::vector<StateDerivative> dafter = dbefore;
  for (std::size_t i = 0; i < after.size(); ++i) {
    dafter[i].v = ratesOf(after[i].v, 0);
    dafter[i].L = ratesOf(after[i].L, 0);
  }
  return dafter;
}

Vec3 velocityTangent(const ImpactInputs<double>& inputs, const std::vector<StateDerivative>& dbefore,
                     const Eigen::Matrix<double, 7, 1>& dcontact, const std::vector<BodyModelDerivative>& dmodel) {
  ImpactInputs<double> first = inputs;
  first.contacts.resize(1);
  const ImpactPass<Rate> pass(along(first, dbefore, {dcontact}, {Vec3::Zero()}, {PairCoefficients()}, dmodel));
  return ratesOf(V3<Rate>(pass.problem().u), 0);
}

namespace {

// A contact may part slower than it should by this share of the speeds at it.
constexpr double kParting = 1e-9;
// Of the fastest contact's speeds so much counts at all others: impulses of all are found together.
constexpr double kOfFastest = 1e-3;

bool isFinite(const State& s) { return s.v.allFinite() && s.L.allFinite(); }

void requireContacts(const Event& event) {
  for (const Contact& c : event.contacts)
    if (!(std::isfinite(c.at.gap) && c.at.point.allFinite() && c.impulse_normal.allFinite()))
      throw NotComputable("its features define no contact point or no normal");
}

// How fast a contact parts, how fast it should at least, and the size of the speeds that this is made of.
struct Parting {
  double after = 0, least = 0, size = 0;
};

Parting partingOf(const Contact& c, const Event& event, const std::vector<BodyModel>& models,
                  const std::vector<State>& after) {
  Vec3 u = c.surface_velocity, v = u;  // of one body's point relative to the other's, before and after
  Parting parting;
  parting.size = u.norm();
  for (std::size_t i = 0; i < event.participants.size(); ++i) {
    const Participant& p = event.participants[i];
    if (p.body != c.a && p.body != c.b) continue;
    const Mat3 A = models[static_cast<std::size_t>(p.body)].inverseInertiaWorld(p.before.q.toRotationMatrix());
    const auto add = [&](const State& s, Vec3& sum) {
      const Vec3 turning = (A * s.L).cross(c.at.point - p.before.x);
      sum += (p.body == c.a ? 1.0 : -1.0) * (s.v + turning);
      parting.size += s.v.norm() + turning.norm();
    };
    add(p.before, u);
    add(after[i], v);
  }
  parting.after = c.impulse_normal.dot(v);
  parting.least = -c.pair.elasticity * c.impulse_normal.dot(u);
  return parting;
}

// The states as they go on, rounded, must part every contact as fast as its elasticity says. One contact without
// friction has its impulse from that condition. A body that is struck and yet stays at rest has no speeds but what is
// left of the others' in rounding.
void requireParting(const Event& event, const std::vector<BodyModel>& models, const std::vector<State>& after) {
  if (event.contacts.size() == 1 && event.mode == ImpactMode::frictionless) return;
  std::vector<Parting> all;
  double fastest = 0;
  for (const Contact& c : event.contacts) {
    all.push_back(partingOf(c, event, models, after));
    fastest = std::max(fastest, all.back().size);
  }
  for (const Parting& c : all)
    if (!(c.after >= c.least - kParting * (c.size + kOfFastest * fastest)))
      throw NotComputable("the velocities that separate its contacts are lost in rounding: masses, or moments of inertia, "
                          "differ too much");
}

// With 32 digits, where they find an answer.
std::optional<ImpactOutcome<double>> doubleDoubleOutcomeOf(const ImpactPass<double>& pass) {
  try {
    return doubleDoubleImpact(pass.inputs());
  } catch (const NotComputable&) {
    return std::nullopt;
  }
}

ImpactOutcome<double> outcomeOf(const ImpactPass<double>& pass, bool& wide) {
  if (wide) return doubleDoubleImpact(pass.inputs());
  std::optional<ImpactSolution> solution;
  try {
    solution = pass.solve();
  } catch (const NotComputable&) {  // many contacts, nearly redundant
    wide = true;
    return doubleDoubleImpact(pass.inputs());
  }
  if (solution->loses_digits) {
    if (auto outcome = doubleDoubleOutcomeOf(pass)) {
      wide = true;
      return *std::move(outcome);
    }
  }
  auto after = pass.after(solution->P);
  return {*std::move(solution), std::move(after)};
}

void record(Contact& c, const Vec3& u, const Vec3& P) {
  c.approach = c.at.normal.dot(u);
  c.impulse = P;
}

Margins marginsOf(const Contact& c, const Vec3& u, double stick_slip) {
  const double speed = u.norm();
  return {speed > 0 ? std::abs(c.approach) / speed : 1, stick_slip};
}

// What ImpactPass does, for one contact and in fixed sizes: nearly every impact of a simulation is one
// (docs/decisions.md, "Derivatives", has the figures).
void solveSingle(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  Contact& c = event.contacts[0];
  ContactProblem problem{Mat3::Zero(), c.surface_velocity, c.impulse_normal, c.pair};
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    const Mat3 A = model.inverseInertiaWorld(p.before.q.toRotationMatrix());
    const Vec3 r = c.at.point - p.before.x, omega = A * p.before.L;
    problem.u += (p.body == c.a ? 1.0 : -1.0) * (p.before.v + omega.cross(r));
    if (!model.kinematic && !p.stays) problem.K += model.inverse_mass * Mat3::Identity() - skew(r) * A * skew(r);
  }
  Vec3 impulse;
  double stick_slip = 1;
  if (lawOf(problem.pair) == Law::frictionless) {
    impulse = FrictionlessTerms<double>(problem).impulse();
    event.mode = ImpactMode::frictionless;
  } else {
    const FrictionTerms<double> friction(problem);
    impulse = friction.impulse();
    event.mode = friction.slides ? ImpactMode::slide : ImpactMode::stick;
    stick_slip = friction.margin;
  }
  record(c, problem.u, impulse);
  c.lasts = c.pair.elasticity == 0;
  event.margins = marginsOf(c, problem.u, stick_slip);
  for (const Participant& p : event.participants) {
    State& s = after.emplace_back(p.before);
    if (models[static_cast<std::size_t>(p.body)].kinematic || p.stays) continue;
    const Vec3 P = (p.body == c.a ? 1.0 : -1.0) * impulse;
    s.v += models[static_cast<std::size_t>(p.body)].inverse_mass * P;
    s.L += (c.at.point - p.before.x).cross(P);
  }
}

void solveByPass(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  const ImpactPass<double> pass(impactInputs(event, models));
  const ImpactOutcome<double> outcome = outcomeOf(pass, event.wide);
  const Eigen::VectorXd& u = pass.problem().u;
  event.mode = outcome.solution.mode;
  for (std::size_t k = 0; k < event.contacts.size(); ++k) {
    const auto row = 3 * static_cast<Eigen::Index>(k);
    record(event.contacts[k], u.segment<3>(row), outcome.solution.P.segment<3>(row));
    event.contacts[k].lasts = outcome.solution.closed[k];
  }
  event.margins = marginsOf(event.contacts[0], u.head<3>(), outcome.solution.stick_slip_margin);
  for (std::size_t i = 0; i < outcome.after.size(); ++i) {
    State& s = after.emplace_back(event.participants[i].before);
    s.v = outcome.after[i].v;
    s.L = outcome.after[i].L;
  }
}

}  // namespace

void solveImpact(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  after.clear();
  requireContacts(event);
  event.wide = needsDoubleDouble(event, models);
  if (event.contacts.size() == 1 && !event.wide && !event.contacts[0].kept) {
    solveSingle(event, models, after);
  } else {
    solveByPass(event, models, after);
  }
  if (!std::all_of(after.begin(), after.end(), isFinite))
    throw NotComputable("its impulses, or the velocities after it, are beyond the range of doubles");
  requireParting(event, models, after);
}

}  // namespace carom::adjoint_detail
