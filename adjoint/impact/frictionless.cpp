// SPDX-License-Identifier: MIT
#include "adjoint/impact/law.hpp"
#include "adjoint/impact/single_laws.hpp"

namespace carom {
namespace {

using FrictionlessNumbers = detail::FrictionlessTerms<double>;

// By the coefficient of friction that is 0 here: that of the law with friction, towards more of it.
Vec3 rateByFriction(const ImpactProblem& problem) {
  return detail::rateByFrictionFromZero(detail::FrictionTerms<double>(onlyContact(problem)));
}

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
  const Vec3 dP = dc * t.n + t.c * dn;
  if (d.pair[0].friction == 0) return dP;
  return dP + d.pair[0].friction * rateByFriction(problem);
}

void frictionlessPullback(const ImpactProblem& problem, const Eigen::VectorXd& P_bar, ImpactProblemDerivative& bar) {
  FrictionlessNumbers(onlyContact(problem)).pullback(P_bar, bar);
  bar.pair[0].friction += rateByFriction(problem).dot(Vec3(P_bar));
}

}  // namespace

ContactSolution solveFrictionless(const ContactProblem& problem) {
  const FrictionlessNumbers t(problem);
  return {t.impulse(), ImpactMode::frictionless, 1};
}

const ImpactLaw kFrictionlessLaw{"frictionless", solveFrictionlessLaw, frictionlessTangent, frictionlessPullback};

}  // namespace carom
