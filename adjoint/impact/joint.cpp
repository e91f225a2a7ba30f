// SPDX-License-Identifier: MIT
#include <cmath>

#include "adjoint/impact/joint_law.hpp"
#include "adjoint/impact/law.hpp"

// Equation 4.3: the law and its adjoint stand in joint_law.hpp, the tangent here.

namespace carom {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Branch = detail::Branch<double>;

VectorXd tangentOf(const detail::DirectedSolve<double>& s, const ImpactProblem& p, const ImpactProblemDerivative& d,
                   const MatrixXd& dC, const VectorXd& dshare) {
  const MatrixXd& C = s.C;
  const MatrixXd CKd = C.transpose() * p.K * dC;
  const MatrixXd dA = CKd + CKd.transpose() + C.transpose() * d.K * C;
  const VectorXd db =
      dshare.cwiseProduct(C.transpose() * p.u) + s.share.cwiseProduct(dC.transpose() * p.u + C.transpose() * d.u);
  return dC * s.solve.y + C * s.solve.tangent(dA, db);
}

ImpactSolution solveJointLaw(const ImpactProblem& p) {
  const Branch b(p);
  return {b.P_N + b.kappa * b.d, ImpactMode::joint, b.limit < 0 ? b.margin : 1.0};
}

VectorXd jointTangent(const ImpactProblem& p, const ImpactProblemDerivative& dp) {
  const Branch b(p);
  VectorXd dshare(static_cast<Index>(b.normal_active.size()));
  for (std::size_t c = 0; c < b.normal_active.size(); ++c)
    dshare[static_cast<Index>(c)] = dp.pair[static_cast<std::size_t>(b.normal_active[c])].elasticity;
  const VectorXd dP_N =
      tangentOf(b.solves[0], p, dp, detail::normalColumns<double>(dp.normal, b.normal_active), dshare);
  if (!b.friction) return dP_N;
  const auto zeros = [](Index n) { return VectorXd::Zero(n).eval(); };
  const VectorXd dP_I = tangentOf(b.solves[1], p, dp, detail::normalColumns<double>(dp.normal, b.plastic_active),
                                  zeros(static_cast<Index>(b.plastic_active.size())));
  const MatrixXd dC = b.stickColumns(p, dp.normal, true);
  const VectorXd dd = tangentOf(b.solves[2], p, dp, dC, zeros(dC.cols())) - dP_I;
  double dkappa = 0;
  if (b.limit >= 0 && !b.by_cone) {  // kappa loss = spare
    const auto k = static_cast<std::size_t>(b.limit);
    const Index at = 3 * b.limit;
    const Vec3 n = p.normal[k], dn = dp.normal[k], u = p.u.segment<3>(at), du = dp.u.segment<3>(at);
    const VectorXd both = b.P_N + b.kappa * b.d, dboth = dP_N + b.kappa * dd;
    const double e1 = 1 + p.pair[k].elasticity, de = dp.pair[k].elasticity;
    const Vec3 gain = p.K.middleRows<3>(at) * both,
               dgain = dp.K.middleRows<3>(at) * both + p.K.middleRows<3>(at) * dboth;
    dkappa = (de * n.dot(u) + e1 * (dn.dot(u) + n.dot(du)) + dn.dot(gain) + n.dot(dgain)) / b.lossOf(p, b.limit);
  } else if (b.limit >= 0) {  // kappa = mu P_n / (|d_t| - mu d_n)
    const auto k = static_cast<std::size_t>(b.limit);
    const Index at = 3 * b.limit;
    const Vec3 n = p.normal[k], dn = dp.normal[k], d = b.d.segment<3>(at), ddk = dd.segment<3>(at);
    const double mu = p.pair[k].friction, dmu = dp.pair[k].friction;
    const double d_n = n.dot(d), dd_n = dn.dot(d) + n.dot(ddk);
    const Vec3 d_t = d - d_n * n;
    const Vec3 P = b.P_N.segment<3>(at), dP = dP_N.segment<3>(at);
    const double P_n = n.dot(P), dP_n = dn.dot(P) + n.dot(dP);
    if (mu > 0) {
      const double s = d_t.norm(), ds = d_t.dot(ddk - d_n * dn) / s;
      dkappa = (dmu * P_n + mu * dP_n - b.kappa * (ds - dmu * d_n - mu * dd_n)) / (s - mu * d_n);
    } else {
      dkappa = (dP_n + b.kappa * dd_n) / -d_n;
    }
  } else if (b.lowest_e_t >= 0) {
    dkappa = dp.pair[static_cast<std::size_t>(b.lowest_e_t)].tangential_elasticity;
  }
  return dP_N + dkappa * b.d + b.kappa * dd;
}

void jointLawPullback(const ImpactProblem& p, const VectorXd& P_bar, ImpactProblemDerivative& bar) {
  detail::jointPullback<double>(p, P_bar, bar);
}

}  // namespace

const ImpactLaw kJointLaw{"joint", solveJointLaw, jointTangent, jointLawPullback};

}  // namespace carom
