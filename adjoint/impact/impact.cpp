// SPDX-License-Identifier: MIT
#include "adjoint/impact/impact.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/impact/wide_impact.hpp"

namespace carom {

// u_k = sum s (v + omega x r),  K_kl = sum s_k s_l (1/m - [r_k]x A [r_l]x),  A = R diag(1/I) R^T,  omega = A L.
// A kinematic body adds to u and not to K, and no impulse moves it.

ImpactAssembly::ImpactAssembly(const Event& event, const std::vector<BodyModel>& models)
    : event_(event), models_(models), wide_(usesWide(event, models)) {
  if (wide_) return;
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    MovingBody& body = bodies_.emplace_back();
    body.model = &model;
    body.R = p.before.q.toRotationMatrix();
    body.A = model.inverseInertiaWorld(body.R);
    body.omega = body.A * p.before.L;
    body.mobility = model.mobilityWorld(body.R);
    problem_.driven = problem_.driven || model.kinematic;
  }
  const auto n = static_cast<Eigen::Index>(event.contacts.size());
  problem_.u = Eigen::VectorXd::Zero(3 * n);
  problem_.K = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int k = 0; k < n; ++k) {
    const Contact& c = event.contacts[static_cast<std::size_t>(k)];
    problem_.normal.push_back(c.impulse_normal);
    problem_.pair.push_back(c.pair);
    for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) {
      const Participant& p = event.participants[static_cast<std::size_t>(i)];
      if (p.body != c.a && p.body != c.b) continue;
      const Arm arm{k, i, p.body == c.a ? 1.0 : -1.0, c.at.point - p.before.x};
      problem_.u.segment<3>(3 * k) += arm.sign * (p.before.v + bodies_[static_cast<std::size_t>(i)].omega.cross(arm.r));
      arms_.push_back(arm);
    }
  }
  for (const Arm& k : arms_)
    for (const Arm& l : arms_) {
      if (k.participant != l.participant) continue;
      const MovingBody& body = bodies_[static_cast<std::size_t>(k.participant)];
      problem_.K.block<3, 3>(3 * k.contact, 3 * l.contact) +=
          k.sign * l.sign * (body.model->inverse_mass * Mat3::Identity() - skew(k.r) * body.mobility * skew(l.r));
    }
}

std::vector<State> ImpactAssembly::after(const Eigen::VectorXd& P) const {
  std::vector<State> states;
  for (const Participant& p : event_.participants) states.push_back(p.before);
  for (const Arm& arm : arms_) {
    if (bodies_[static_cast<std::size_t>(arm.participant)].model->kinematic) continue;
    State& s = states[static_cast<std::size_t>(arm.participant)];
    const Vec3 P_k = arm.sign * P.segment<3>(3 * arm.contact);
    s.v += bodies_[static_cast<std::size_t>(arm.participant)].model->inverse_mass * P_k;
    s.L += arm.r.cross(P_k);
  }
  return states;
}

std::vector<StateDerivative> ImpactAssembly::tangent(const Eigen::VectorXd& P,
                                                     const std::vector<StateDerivative>& dbefore,
                                                     const std::vector<Eigen::Matrix<double, 7, 1>>& dcontact,
                                                     const std::vector<PairCoefficients>& dpair,
                                                     const std::vector<BodyModelDerivative>& dmodel) const {
  if (wide_) return WideImpact(event_, models_).tangent(dbefore, dcontact, dpair, dmodel);
  ImpactProblemDerivative dproblem(problem_.contacts());
  std::vector<Mat3> dA(bodies_.size());
  std::vector<Vec3> domega(bodies_.size());
  std::vector<double> dinverse_mass(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MovingBody& b = bodies_[i];
    const BodyModel& m = *b.model;
    const Mat3 T = skew(dbefore[i].theta);
    dA[i] = T * b.A - b.A * T - b.A * b.R * dmodel[i].inertiaTensor() * b.R.transpose() * b.A;
    domega[i] = dA[i] * event_.participants[i].before.L + b.A * dbefore[i].L;
    dinverse_mass[i] = -dmodel[i].mass * m.inverse_mass * m.inverse_mass;
  }
  std::vector<Vec3> dr(arms_.size());
  for (std::size_t j = 0; j < arms_.size(); ++j) {
    const Arm& arm = arms_[j];
    const auto i = static_cast<std::size_t>(arm.participant);
    dr[j] = dcontact[static_cast<std::size_t>(arm.contact)].tail<3>() - dbefore[i].x;
    dproblem.u.segment<3>(3 * arm.contact) +=
        arm.sign * (dbefore[i].v + domega[i].cross(arm.r) + bodies_[i].omega.cross(dr[j]));
  }
  for (std::size_t k = 0; k < dcontact.size(); ++k) {
    dproblem.normal[k] = dcontact[k].segment<3>(1);
    dproblem.pair[k] = dpair[k];
  }
  for (std::size_t j = 0; j < arms_.size(); ++j)
    for (std::size_t l = 0; l < arms_.size(); ++l) {
      const Arm &a = arms_[j], &b = arms_[l];
      if (a.participant != b.participant) continue;
      const auto i = static_cast<std::size_t>(a.participant);
      if (bodies_[i].model->kinematic) continue;
      const Mat3 Ra = skew(a.r), Rb = skew(b.r), &A = bodies_[i].A;
      dproblem.K.block<3, 3>(3 * a.contact, 3 * b.contact) +=
          a.sign * b.sign *
          (dinverse_mass[i] * Mat3::Identity() - skew(dr[j]) * A * Rb - Ra * dA[i] * Rb - Ra * A * skew(dr[l]));
    }
  const Eigen::VectorXd dP = lawFor(problem_).tangent(problem_, dproblem);
  std::vector<StateDerivative> dafter = dbefore;
  for (std::size_t j = 0; j < arms_.size(); ++j) {
    const Arm& arm = arms_[j];
    const auto i = static_cast<std::size_t>(arm.participant);
    if (bodies_[i].model->kinematic) continue;
    const Vec3 P_k = P.segment<3>(3 * arm.contact), dP_k = dP.segment<3>(3 * arm.contact);
    dafter[i].v += arm.sign * (bodies_[i].model->inverse_mass * dP_k + dinverse_mass[i] * P_k);
    dafter[i].L += arm.sign * (arm.r.cross(dP_k) + dr[j].cross(P_k));
  }
  return dafter;
}

std::vector<StateDerivative> ImpactAssembly::pullback(const Eigen::VectorXd& P,
                                                      const std::vector<StateDerivative>& after_bar,
                                                      std::vector<Eigen::Matrix<double, 7, 1>>& contact_bar,
                                                      std::vector<PairCoefficients>& pair_bar,
                                                      std::vector<BodyModelDerivative>& model_bar) const {
  if (wide_) return WideImpact(event_, models_).pullback(after_bar, contact_bar, pair_bar, model_bar);
  std::vector<StateDerivative> before_bar = after_bar;
  std::vector<double> inverse_mass_bar(bodies_.size(), 0.0);
  std::vector<Vec3> r_bar(arms_.size(), Vec3::Zero()), omega_bar(bodies_.size(), Vec3::Zero());
  std::vector<Mat3> A_bar(bodies_.size(), Mat3::Zero());
  Eigen::VectorXd P_bar = Eigen::VectorXd::Zero(P.size());
  for (std::size_t j = 0; j < arms_.size(); ++j) {
    const Arm& arm = arms_[j];
    const auto i = static_cast<std::size_t>(arm.participant);
    if (bodies_[i].model->kinematic) continue;
    const Vec3 P_k = P.segment<3>(3 * arm.contact);
    const Vec3 &v_bar = after_bar[i].v, &L_bar = after_bar[i].L;
    P_bar.segment<3>(3 * arm.contact) += arm.sign * (bodies_[i].model->inverse_mass * v_bar + L_bar.cross(arm.r));
    inverse_mass_bar[i] += arm.sign * P_k.dot(v_bar);
    r_bar[j] = arm.sign * P_k.cross(L_bar);
  }
  ImpactProblemDerivative bar(problem_.contacts());
  lawFor(problem_).pullback(problem_, P_bar, bar);
  for (std::size_t j = 0; j < arms_.size(); ++j)
    for (std::size_t l = 0; l < arms_.size(); ++l) {
      const Arm &a = arms_[j], &b = arms_[l];
      if (a.participant != b.participant) continue;
      const auto i = static_cast<std::size_t>(a.participant);
      if (bodies_[i].model->kinematic) continue;
      const Mat3 Ra = skew(a.r), Rb = skew(b.r), &A = bodies_[i].A;
      const Mat3 K_bar = a.sign * b.sign * bar.K.block<3, 3>(3 * a.contact, 3 * b.contact);
      inverse_mass_bar[i] += K_bar.trace();
      A_bar[i] -= Ra * K_bar * Rb;         // <K_bar, -Ra dA Rb>, Ra^T = -Ra
      r_bar[j] += unskew(K_bar * Rb * A);  // <K_bar, -[dr]x A Rb>
      r_bar[l] += unskew(A * Ra * K_bar);  // <K_bar, -Ra A [dr]x>
    }
  for (std::size_t j = 0; j < arms_.size(); ++j) {
    const Arm& arm = arms_[j];
    const auto i = static_cast<std::size_t>(arm.participant);
    const Vec3 u_bar = arm.sign * bar.u.segment<3>(3 * arm.contact);
    before_bar[i].v += u_bar;
    omega_bar[i] += arm.r.cross(u_bar);
    r_bar[j] += u_bar.cross(bodies_[i].omega);
    before_bar[i].x -= r_bar[j];
    contact_bar[static_cast<std::size_t>(arm.contact)].tail<3>() += r_bar[j];
  }
  for (std::size_t k = 0; k < contact_bar.size(); ++k) {
    contact_bar[k].segment<3>(1) += bar.normal[k];
    pair_bar[k].elasticity += bar.pair[k].elasticity;
    pair_bar[k].friction += bar.pair[k].friction;
    pair_bar[k].tangential_elasticity += bar.pair[k].tangential_elasticity;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MovingBody& b = bodies_[i];
    const BodyModel& m = *b.model;
    A_bar[i] += omega_bar[i] * event_.participants[i].before.L.transpose();
    before_bar[i].L += b.A * omega_bar[i];
    // dA = [theta]x A - A [theta]x - A R dJ R^T A, A symmetric
    before_bar[i].theta += unskew(A_bar[i] * b.A - b.A * A_bar[i]);
    model_bar[i].addInertiaBar(-(b.R.transpose() * b.A * A_bar[i] * b.A * b.R));
    model_bar[i].mass -= inverse_mass_bar[i] * m.inverse_mass * m.inverse_mass;
  }
  return before_bar;
}

namespace {

// A contact may part slower than it should by this share of the speeds at it.
constexpr double kParting = 1e-9;

bool isFinite(const State& s) { return s.v.allFinite() && s.L.allFinite(); }

void requireContacts(const Event& event) {
  for (const Contact& c : event.contacts)
    if (!(std::isfinite(c.at.gap) && c.at.point.allFinite() && c.impulse_normal.allFinite()))
      throw NotComputable("its features give the contact no point or no normal");
}

void record(Contact& c, const Vec3& u, const Vec3& P) {
  c.approach = c.at.normal.dot(u);
  c.impulse = P;
}

Margins marginsOf(const Contact& c, const Vec3& u, double stick_slip) {
  const double speed = u.norm();
  return {speed > 0 ? std::abs(c.approach) / speed : 1, stick_slip};
}

// Velocity of one body's point relative to the other's, and the sum of what it is made of.
struct ContactVelocity {
  Vec3 u = Vec3::Zero();
  double size = 0;
};
ContactVelocity contactVelocity(const Event& event, const std::vector<BodyModel>& models, const Contact& c,
                                const std::vector<State>* after) {
  ContactVelocity sum;
  for (std::size_t i = 0; i < event.participants.size(); ++i) {
    const Participant& p = event.participants[i];
    if (p.body != c.a && p.body != c.b) continue;
    const State& s = after ? (*after)[i] : p.before;
    const Mat3 A = models[static_cast<std::size_t>(p.body)].inverseInertiaWorld(p.before.q.toRotationMatrix());
    const Vec3 turning = (A * s.L).cross(c.at.point - p.before.x);
    sum.u += (p.body == c.a ? 1.0 : -1.0) * (s.v + turning);
    sum.size += s.v.norm() + turning.norm();
  }
  return sum;
}

// The states as they go on, rounded, must part every contact as fast as its elasticity says. One contact without
// friction has its impulse from that condition.
void requireParting(const Event& event, const std::vector<BodyModel>& models, const std::vector<State>& after) {
  if (event.contacts.size() == 1 && event.mode == ImpactMode::frictionless) return;
  for (const Contact& c : event.contacts) {
    const ContactVelocity u = contactVelocity(event, models, c, nullptr), v = contactVelocity(event, models, c, &after);
    const double least = -c.pair.elasticity * c.impulse_normal.dot(u.u);
    if (!(c.impulse_normal.dot(v.u) >= least - kParting * (u.size + v.size)))
      throw NotComputable("no digits are left of the velocities that part its contacts: masses, or moments of inertia, "
                          "differ too much");
  }
}

// What ImpactAssembly does, for one contact and in fixed sizes.
void solveSingle(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  Contact& c = event.contacts[0];
  ContactProblem problem{Mat3::Zero(), Vec3::Zero(), c.impulse_normal, c.pair};
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    const Mat3 A = model.inverseInertiaWorld(p.before.q.toRotationMatrix());
    const Vec3 r = c.at.point - p.before.x, omega = A * p.before.L;
    problem.u += (p.body == c.a ? 1.0 : -1.0) * (p.before.v + omega.cross(r));
    if (!model.kinematic) problem.K += model.inverse_mass * Mat3::Identity() - skew(r) * A * skew(r);
  }
  const ContactSolution solution = lawOf(c.pair) == Law::friction ? solveFriction(problem) : solveFrictionless(problem);
  record(c, problem.u, solution.P);
  event.mode = solution.mode;
  event.margins = marginsOf(c, problem.u, solution.stick_slip_margin);
  for (const Participant& p : event.participants) {
    State& s = after.emplace_back(p.before);
    if (models[static_cast<std::size_t>(p.body)].kinematic) continue;
    const Vec3 P = (p.body == c.a ? 1.0 : -1.0) * solution.P;
    s.v += models[static_cast<std::size_t>(p.body)].inverse_mass * P;
    s.L += (c.at.point - p.before.x).cross(P);
  }
}

void solveJoint(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  const ImpactAssembly assembly(event, models);
  const ImpactProblem& problem = assembly.problem();
  const ImpactSolution solution = lawFor(problem).solve(problem);
  event.mode = solution.mode;
  for (std::size_t k = 0; k < event.contacts.size(); ++k) {
    const auto row = 3 * static_cast<Eigen::Index>(k);
    record(event.contacts[k], problem.u.segment<3>(row), solution.P.segment<3>(row));
  }
  event.margins = marginsOf(event.contacts[0], problem.u.head<3>(), solution.stick_slip_margin);
  after = assembly.after(solution.P);
}

void solveWide(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  after = WideImpact(event, models).solve(event);
  const double stick_slip = event.margins.stick_slip;
  for (std::size_t k = event.contacts.size(); k-- > 0;) {
    Contact& c = event.contacts[k];
    const Vec3 u = contactVelocity(event, models, c, nullptr).u;
    record(c, u, c.impulse);
    event.margins = marginsOf(c, u, stick_slip);
  }
}

}  // namespace

void solveImpact(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after) {
  after.clear();
  requireContacts(event);
  event.wide = needsWide(event, models);
  if (event.wide) {
    solveWide(event, models, after);
  } else if (event.contacts.size() == 1) {
    solveSingle(event, models, after);
  } else {
    try {
      solveJoint(event, models, after);
    } catch (const NotComputable&) {  // many contacts, nearly redundant
      event.wide = true;
      solveWide(event, models, after);
    }
  }
  if (!std::all_of(after.begin(), after.end(), isFinite))
    throw NotComputable("its impulses, or the velocities after it, are beyond the range of doubles");
  requireParting(event, models, after);
}

}  // namespace carom
