#include "adjoint/impact/law.h"

// Equation 4.1: P = c n with c = -(1 + e) u_n / a, u_n = n.u, a = n.K n.

namespace carom {
namespace {

struct Terms {
  explicit Terms(const ContactProblem& p)
      : K(p.K),
        u(p.u),
        n(p.normal),
        e1(1 + p.pair.elasticity),
        Kn(K * n),
        u_n(n.dot(u)),
        a(n.dot(Kn)),
        c(-e1 * u_n / a) {}
  Mat3 K;
  Vec3 u, n;
  double e1;
  Vec3 Kn;
  double u_n, a, c;
};

ImpactSolution solve(const ImpactProblem& problem) {
  const ContactSolution s = solveFrictionless(onlyContact(problem));
  return {s.P, s.mode, s.stick_slip_margin};
}

Eigen::VectorXd tangent(const ImpactProblem& problem, const ImpactProblemDerivative& d) {
  const Terms t(onlyContact(problem));
  const Vec3 &dn = d.normal[0], du = d.u;
  const double du_n = dn.dot(t.u) + t.n.dot(du);
  const double da = 2 * dn.dot(t.Kn) + t.n.dot(d.K * t.n);
  const double dc = -(d.pair[0].elasticity * t.u_n + t.e1 * du_n + t.c * da) / t.a;
  return dc * t.n + t.c * dn;
}

void pullback(const ImpactProblem& problem, const Eigen::VectorXd& P_bar, ImpactProblemDerivative& bar) {
  const Terms t(onlyContact(problem));
  const double c_bar = t.n.dot(P_bar);
  const double u_n_bar = -t.e1 / t.a * c_bar, a_bar = -t.c / t.a * c_bar;
  bar.pair[0].elasticity -= t.u_n / t.a * c_bar;
  bar.normal[0] += t.c * P_bar + u_n_bar * t.u + 2 * a_bar * t.Kn;
  bar.u += u_n_bar * t.n;
  bar.K += a_bar * t.n * t.n.transpose();
}

}  // namespace

ContactSolution solveFrictionless(const ContactProblem& problem) {
  const Terms t(problem);
  return {t.c * t.n, ImpactMode::frictionless, 1};
}

const ImpactLaw kFrictionlessLaw{"frictionless", solve, tangent, pullback};

}  // namespace carom
