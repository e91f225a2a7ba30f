// SPDX-License-Identifier: MIT
#include "adjoint/detail/single_laws.hpp"
#include "adjoint/impact/law.h"

namespace carom {
namespace {

using FrictionlessNumbers = detail::FrictionlessTerms<double>;

ImpactSolution solveFrictionlessLaw(const ImpactProblem& problem) {
  const ContactSolution s = solveFrictionless(onlyContact(problem));
  return {s.P, s.mode, s.stick_slip_margin};
}

Eigen::VectorXd frictionlessTangent(const ImpactProblem& problem, const ImpactProblemDerivative& d) {
  const FrictionlessNumbers t(onlyContact(problem));
  const Vec3 &dn = d.normal[0], du = d.u;
  const double du_n = dn.dot(t.u) + t.n.dot(du);
  const double da = 2 * dn.dot(t.Kn) + t.n.dot(d.K * t.n);
  const double dc = -(d.pair[0].elasticity * t.u_n + t.e1 * du_n + t.c * da) / t.a;
  return dc * t.n + t.c * dn;
}

void frictionlessPullback(const ImpactProblem& problem, const Eigen::VectorXd& P_bar, ImpactProblemDerivative& bar) {
  FrictionlessNumbers(onlyContact(problem)).pullback(P_bar, bar);
}

}  // namespace

ContactSolution solveFrictionless(const ContactProblem& problem) {
  const FrictionlessNumbers t(problem);
  return {t.impulse(), ImpactMode::frictionless, 1};
}

const ImpactLaw kFrictionlessLaw{"frictionless", solveFrictionlessLaw, frictionlessTangent, frictionlessPullback};

}  // namespace carom
