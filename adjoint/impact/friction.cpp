#include <Eigen/Cholesky>
#include <cmath>

#include "adjoint/impact/law.h"

// Equation 4.2, the algebraic law of Chatterjee and Ruina (1998):
//   P_I = -(u_n/a) n, P_II = -K^-1 u, d = P_II - P_I,
//   stick: P = (1 + e) P_I + (1 + e_t) d          where |P_t| <= mu P_n,
//   slide: P = (1 + e) P_I + kappa d, kappa = mu (1 + e) n.P_I / (|d_t| - mu n.d).

namespace carom {
namespace {

struct Terms {
  explicit Terms(const ContactProblem& p)
      : K(p.K),
        u(p.u),
        n(p.normal),
        mu(p.pair.friction),
        e1(1 + p.pair.elasticity),
        et1(1 + p.pair.tangential_elasticity),
        Kn(K * n),
        u_n(n.dot(u)),
        a(n.dot(Kn)),
        factor(K) {
    P_I = -(u_n / a) * n;
    P_II = -factor.solve(u);
    d = P_II - P_I;
    d_n = n.dot(d);
    d_t = d - d_n * n;
    s = d_t.norm();
    const double P_n = e1 * n.dot(P_I) + et1 * d_n, P_t = std::abs(et1) * s;
    slides = P_t > mu * P_n;
    margin = std::abs(mu * P_n - P_t) / ((1 + mu) * std::abs(P_n));
    if (slides) {
      slope = s - mu * d_n;  // > mu e1 n.P_I / et1 > 0, because the stick impulse lies outside the cone
      kappa = mu * e1 * n.dot(P_I) / slope;
    } else {
      kappa = et1;
    }
  }
  Mat3 K;
  Vec3 u, n;
  double mu, e1, et1;
  Vec3 Kn;
  double u_n, a;
  Eigen::LDLT<Mat3> factor;
  Vec3 P_I, P_II, d, d_t;
  double d_n = 0, s = 0, kappa = 0, slope = 0, margin = 1;
  bool slides = false;
};

ImpactSolution solve(const ImpactProblem& problem) {
  const ContactSolution s = solveFriction(onlyContact(problem));
  return {s.P, s.mode, s.stick_slip_margin};
}

Eigen::VectorXd tangent(const ImpactProblem& problem, const ImpactProblemDerivative& dp) {
  const Terms t(onlyContact(problem));
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

void pullback(const ImpactProblem& problem, const Eigen::VectorXd& P_bar_in, ImpactProblemDerivative& bar) {
  const Terms t(onlyContact(problem));
  const Vec3 P_bar = P_bar_in;
  Vec3 P_I_bar = t.e1 * P_bar, d_bar = t.kappa * P_bar, n_bar = Vec3::Zero();
  double e_bar = P_bar.dot(t.P_I);
  const double kappa_bar = P_bar.dot(t.d);
  if (t.slides) {
    const double P_In = t.n.dot(t.P_I);
    const double top_bar = kappa_bar / t.slope, slope_bar = -t.kappa * top_bar;
    bar.pair[0].friction += t.e1 * P_In * top_bar - t.d_n * slope_bar;
    e_bar += t.mu * P_In * top_bar;
    const double P_In_bar = t.mu * t.e1 * top_bar, d_n_bar = -t.mu * slope_bar;
    n_bar += P_In_bar * t.P_I + d_n_bar * t.d - slope_bar * t.d_n / t.s * t.d_t;
    P_I_bar += P_In_bar * t.n;
    d_bar += slope_bar / t.s * t.d_t + d_n_bar * t.n;
  } else {
    bar.pair[0].tangential_elasticity += kappa_bar;
  }
  bar.pair[0].elasticity += e_bar;
  P_I_bar -= d_bar;
  const Vec3 z = t.factor.solve(d_bar);  // d P_II = -K^-1 (du + dK P_II)
  const double c_bar = P_I_bar.dot(t.n), u_n_bar = -c_bar / t.a, a_bar = t.u_n / (t.a * t.a) * c_bar;
  bar.normal[0] += n_bar - t.u_n / t.a * P_I_bar + u_n_bar * t.u + 2 * a_bar * t.Kn;
  bar.u += u_n_bar * t.n - z;
  bar.K += a_bar * t.n * t.n.transpose() - z * t.P_II.transpose();
}

}  // namespace

ContactSolution solveFriction(const ContactProblem& problem) {
  const Terms t(problem);
  return {t.e1 * t.P_I + t.kappa * t.d, t.slides ? ImpactMode::slide : ImpactMode::stick, t.margin};
}

const ImpactLaw kFrictionLaw{"friction", solve, tangent, pullback};

}  // namespace carom
