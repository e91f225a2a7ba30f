// SPDX-License-Identifier: MIT
#include "adjoint/impact/untruncated.hpp"

#include <Eigen/Cholesky>

// P_I = -(u_n/a) n, a = n.K n, P_II = -K^-1 u.

namespace carom::adjoint_detail {
namespace {

struct UntruncatedTerms {
  explicit UntruncatedTerms(const ContactProblem& p) : Kn(p.K * p.normal), u_n(p.normal.dot(p.u)), a(p.normal.dot(Kn)), K(p.K) {
    P_I = -(u_n / a) * p.normal;
    P_II = -K.solve(p.u);
    e1 = 1 + p.pair.elasticity;
    et1 = 1 + p.pair.tangential_elasticity;
  }
  Vec3 Kn;
  double u_n, a;
  Eigen::LDLT<Mat3> K;
  Vec3 P_I, P_II;
  double e1 = 0, et1 = 0;
};

}  // namespace

Vec3 untruncatedImpulse(const ContactProblem& problem) {
  const UntruncatedTerms t(problem);
  return t.e1 * t.P_I + t.et1 * (t.P_II - t.P_I);
}

ContactProblemBar untruncatedImpulsePullback(const ContactProblem& problem, const Vec3& P_bar) {
  const UntruncatedTerms t(problem);
  ContactProblemBar bar;
  bar.pair.elasticity = P_bar.dot(t.P_I);
  bar.pair.tangential_elasticity = P_bar.dot(t.P_II - t.P_I);
  const Vec3 P_I_bar = (t.e1 - t.et1) * P_bar, z = t.K.solve(t.et1 * P_bar);
  const double c_bar = P_I_bar.dot(problem.normal), u_n_bar = -c_bar / t.a, a_bar = t.u_n / (t.a * t.a) * c_bar;
  bar.normal = -t.u_n / t.a * P_I_bar + u_n_bar * problem.u + 2 * a_bar * t.Kn;
  bar.u = u_n_bar * problem.normal - z;
  bar.K = a_bar * problem.normal * problem.normal.transpose() - z * t.P_II.transpose();
  return bar;
}

}  // namespace carom::adjoint_detail
