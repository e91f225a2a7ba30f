// SPDX-License-Identifier: MIT
#include "adjoint/impact/law.hpp"
#include "adjoint/impact/single_laws.hpp"

namespace carom {
namespace {

using FrictionNumbers = detail::FrictionTerms<double>;

ImpactSolution solveFrictionLaw(const ImpactProblem& problem) {
  const ContactSolution s = solveFriction(onlyContact(problem));
  return {s.P, s.mode, s.stick_slip_margin};
}

Eigen::VectorXd frictionTangent(const ImpactProblem& problem, const ImpactProblemDerivative& dp) {
  const FrictionNumbers t(onlyContact(problem));
  const Vec3 dn = dp.normal[0], du = dp.u;
  const Mat3 dK = dp.K;
  const double de = dp.pair[0].elasticity, dmu = dp.pair[0].friction, det = dp.pair[0].tangential_elasticity;
  const double du_n = dn.dot(t.u) + t.n.dot(du), da = 2 * dn.dot(t.Kn) + t.n.dot(dK * t.n);
  const Vec3 dP_I = -(du_n - t.u_n / t.a * da) / t.a * t.n - t.u_n / t.a * dn;
  const Vec3 dP_II = -t.factor.solve(du + dK * t.P_II);
  const Vec3 dd = dP_II - dP_I;
  double dkappa = det;
  if (t.slides) {
    const double dd_n = dn.dot(t.d) + t.n.dot(dd);
    const double ds = t.d_t.dot(dd - t.d_n * dn) / t.s;  // d_t has no part along n
    const double P_In = t.n.dot(t.P_I), dP_In = dn.dot(t.P_I) + t.n.dot(dP_I);
    const double top = dmu * t.e1 * P_In + t.mu * (de * P_In + t.e1 * dP_In);
    dkappa = (top - t.kappa * (ds - dmu * t.d_n - t.mu * dd_n)) / t.slope;
  }
  return de * t.P_I + t.e1 * dP_I + dkappa * t.d + t.kappa * dd;
}

void frictionPullback(const ImpactProblem& problem, const Eigen::VectorXd& P_bar, ImpactProblemDerivative& bar) {
  FrictionNumbers(onlyContact(problem)).pullback(P_bar, bar);
}

}  // namespace

ContactSolution solveFriction(const ContactProblem& problem) {
  const FrictionNumbers t(problem);
  return {t.impulse(), t.slides ? ImpactMode::slide : ImpactMode::stick, t.margin};
}

double frictionFromZeroMargin(const ContactProblem& problem) {
  const FrictionNumbers t(problem);
  return t.slides ? t.margin : 0;
}

const ImpactLaw kFrictionLaw{"friction", solveFrictionLaw, frictionTangent, frictionPullback};

}  // namespace carom
