#include <algorithm>
#include <cmath>

#include "adjoint/impact/complementarity.h"
#include "adjoint/impact/law.h"

// Equation 4.3, contacts of one instant together, each with u_n <= 0 before:
//   P_N: normal impulses, 0 <= P_N,k, u_n,k+ >= -e_k u_n,k, complementary;   P_I: the same with e = 0;
//   P_II: impulses that stop every active contact with friction altogether and the others along their normals;
//   P = P_N + kappa (P_II - P_I), kappa = 1 + min e_t cut back to where the first contact reaches its friction cone.
// One contact gives 4.1 and 4.2. Energy: with |.| the norm of K, the change is
// 1/2 sum P_N,k (1 - e_k) u_n,k - kappa (1 - kappa/2) |P_II - P_I|^2 at the most, which is <= 0 for kappa in [0, 2].
// Redundant contacts (a face on a plane) make K singular; impulses of least norm are taken, velocities are unique.

namespace carom {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Impulses P = C y from directions C (contacts x directions) that are to receive the velocity change -s o (C^T u).
struct DirectedSolve {
  MatrixXd C;
  VectorXd share;  // s
  LeastNormSolve solve;

  DirectedSolve(const ImpactProblem& p, MatrixXd directions, VectorXd shares)
      : C(std::move(directions)),
        share(std::move(shares)),
        solve(C.transpose() * p.K * C, share.cwiseProduct(C.transpose() * p.u)) {}

  VectorXd impulse() const { return C * solve.y; }

  VectorXd tangent(const ImpactProblem& p, const ImpactProblemDerivative& d, const MatrixXd& dC,
                   const VectorXd& dshare) const {
    const MatrixXd CKd = C.transpose() * p.K * dC;
    const MatrixXd dA = CKd + CKd.transpose() + C.transpose() * d.K * C;
    const VectorXd db =
        dshare.cwiseProduct(C.transpose() * p.u) + share.cwiseProduct(dC.transpose() * p.u + C.transpose() * d.u);
    return dC * solve.y + C * solve.tangent(dA, db);
  }
  void pullback(const ImpactProblem& p, const VectorXd& P_bar, ImpactProblemDerivative& bar, MatrixXd& C_bar,
                VectorXd& share_bar) const {
    MatrixXd A_bar;
    VectorXd b_bar;
    solve.pullback(C.transpose() * P_bar, A_bar, b_bar);
    const VectorXd v_bar = share.cwiseProduct(b_bar);
    share_bar = b_bar.cwiseProduct(C.transpose() * p.u);
    C_bar = P_bar * solve.y.transpose() + p.K * C * (A_bar + A_bar.transpose()) + p.u * v_bar.transpose();
    bar.K += C * A_bar * C.transpose();
    bar.u += C * v_bar;
  }
};

using Contacts = std::vector<int>;

MatrixXd normalColumns(const std::vector<Vec3>& normals, const Contacts& active) {
  MatrixXd C = MatrixXd::Zero(3 * static_cast<Index>(normals.size()), static_cast<Index>(active.size()));
  for (std::size_t c = 0; c < active.size(); ++c)
    C.block<3, 1>(3 * active[c], static_cast<Index>(c)) = normals[static_cast<std::size_t>(active[c])];
  return C;
}

void addNormalColumns(const MatrixXd& C_bar, const Contacts& active, ImpactProblemDerivative& bar) {
  for (std::size_t c = 0; c < active.size(); ++c)
    bar.normal[static_cast<std::size_t>(active[c])] += C_bar.block<3, 1>(3 * active[c], static_cast<Index>(c));
}

// The branch of the law with its three solves.
struct Branch {
  Contacts normal_active, plastic_active, directions;  // directions: contacts of P_II, their union
  bool friction = false;
  double kappa = 0;
  int limit = -1;       // contact whose cone cuts kappa, -1: none does
  int lowest_e_t = -1;  // contact that gives kappa when none does
  double margin = 1;
  VectorXd P_N, d;
  std::vector<DirectedSolve> solves;  // P_N, P_I, P_II

  explicit Branch(const ImpactProblem& p) {
    const int n = p.contacts();
    Contacts all(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) all[static_cast<std::size_t>(k)] = k;
    const MatrixXd N = normalColumns(p.normal, all);
    const MatrixXd A = N.transpose() * p.K * N;
    const VectorXd u_n = N.transpose() * p.u;
    normal_active = activeContacts(A, share(p, all).cwiseProduct(u_n));
    solves.emplace_back(p, normalColumns(p.normal, normal_active), share(p, normal_active));
    P_N = solves[0].impulse();
    d = VectorXd::Zero(3 * n);
    friction = std::any_of(p.pair.begin(), p.pair.end(), [](const auto& c) { return c.friction > 0; });
    if (!friction) return;
    plastic_active = activeContacts(A, u_n);
    std::set_union(normal_active.begin(), normal_active.end(), plastic_active.begin(), plastic_active.end(),
                   std::back_inserter(directions));
    solves.emplace_back(p, normalColumns(p.normal, plastic_active), ones(plastic_active.size()));
    const MatrixXd C = stickColumns(p, p.normal);
    solves.emplace_back(p, C, ones(static_cast<std::size_t>(C.cols())));
    d = solves[2].impulse() - solves[1].impulse();
    cutBack(p);
  }

  static VectorXd ones(std::size_t n) { return VectorXd::Ones(static_cast<Index>(n)); }
  static VectorXd share(const ImpactProblem& p, const Contacts& list) {
    VectorXd s(static_cast<Index>(list.size()));
    for (std::size_t c = 0; c < list.size(); ++c)
      s[static_cast<Index>(c)] = 1 + p.pair[static_cast<std::size_t>(list[c])].elasticity;
    return s;
  }
  bool sticks(const ImpactProblem& p, int k) const { return p.pair[static_cast<std::size_t>(k)].friction > 0; }

  // Whole 3x3 blocks for contacts with friction, the normal (or its derivative) for those without.
  MatrixXd stickColumns(const ImpactProblem& p, const std::vector<Vec3>& normals, bool derivative = false) const {
    Index columns = 0;
    for (int k : directions) columns += sticks(p, k) ? 3 : 1;
    MatrixXd C = MatrixXd::Zero(3 * p.contacts(), columns);
    Index at = 0;
    for (int k : directions) {
      if (sticks(p, k)) {
        if (!derivative) C.block<3, 3>(3 * k, at).setIdentity();
        at += 3;
      } else {
        C.block<3, 1>(3 * k, at++) = normals[static_cast<std::size_t>(k)];
      }
    }
    return C;
  }
  void addStickColumns(const ImpactProblem& p, const MatrixXd& C_bar, ImpactProblemDerivative& bar) const {
    Index at = 0;
    for (int k : directions) {
      if (!sticks(p, k)) bar.normal[static_cast<std::size_t>(k)] += C_bar.block<3, 1>(3 * k, at);
      at += sticks(p, k) ? 3 : 1;
    }
  }

  void cutBack(const ImpactProblem& p) {
    kappa = 2;
    for (int k : directions) {
      const double bound = 1 + p.pair[static_cast<std::size_t>(k)].tangential_elasticity;
      if (sticks(p, k) && (lowest_e_t < 0 || bound < kappa)) kappa = bound, lowest_e_t = k;
    }
    if (lowest_e_t < 0) kappa = 0;
    for (int k : directions) {
      const auto kk = static_cast<std::size_t>(k);
      const Vec3 dk = d.segment<3>(3 * k), n = p.normal[kk];
      const double mu = p.pair[kk].friction, d_n = n.dot(dk), P_n = std::max(0.0, n.dot(P_N.segment<3>(3 * k)));
      const double s = mu > 0 ? (dk - d_n * n).norm() / mu : 0, slope = s - d_n;
      if (slope > 0 && P_n < kappa * slope) kappa = P_n / slope, limit = k;
      const double whole = P_n + kappa * d_n;
      if (whole > 0) margin = std::min(margin, std::abs(whole - kappa * s) * (mu > 0 ? mu / (1 + mu) : 1) / whole);
    }
  }
};

ImpactSolution solve(const ImpactProblem& p) {
  const Branch b(p);
  return {b.P_N + b.kappa * b.d, ImpactMode::joint, b.limit < 0 ? b.margin : 1.0};
}

VectorXd tangent(const ImpactProblem& p, const ImpactProblemDerivative& dp) {
  const Branch b(p);
  VectorXd dshare(static_cast<Index>(b.normal_active.size()));
  for (std::size_t c = 0; c < b.normal_active.size(); ++c)
    dshare[static_cast<Index>(c)] = dp.pair[static_cast<std::size_t>(b.normal_active[c])].elasticity;
  const VectorXd dP_N = b.solves[0].tangent(p, dp, normalColumns(dp.normal, b.normal_active), dshare);
  if (!b.friction) return dP_N;
  const auto zeros = [](Index n) { return VectorXd::Zero(n).eval(); };
  const VectorXd dP_I = b.solves[1].tangent(p, dp, normalColumns(dp.normal, b.plastic_active),
                                            zeros(static_cast<Index>(b.plastic_active.size())));
  const MatrixXd dC = b.stickColumns(p, dp.normal, true);
  const VectorXd dd = b.solves[2].tangent(p, dp, dC, zeros(dC.cols())) - dP_I;
  double dkappa = 0;
  if (b.limit >= 0) {  // kappa = mu P_n / (|d_t| - mu d_n)
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

// The adjoint of dkappa in `tangent`.
void limitPullback(const ImpactProblem& p, const Branch& b, double kappa_bar, ImpactProblemDerivative& bar,
                   VectorXd& P_N_bar, VectorXd& d_bar) {
  const auto k = static_cast<std::size_t>(b.limit);
  const Index at = 3 * b.limit;
  const Vec3 n = p.normal[k], d = b.d.segment<3>(at), P = b.P_N.segment<3>(at);
  const double mu = p.pair[k].friction, d_n = n.dot(d), P_n = n.dot(P);
  double P_n_bar, d_n_bar;
  if (mu > 0) {
    const Vec3 d_t = d - d_n * n;
    const double s = d_t.norm(), w = kappa_bar / (s - mu * d_n), s_bar = -b.kappa * w;
    bar.pair[k].friction += w * (P_n + b.kappa * d_n);
    P_n_bar = mu * w;
    d_n_bar = b.kappa * mu * w;
    d_bar.segment<3>(at) += s_bar / s * d_t;
    bar.normal[k] -= s_bar / s * d_n * d_t;
  } else {
    P_n_bar = -kappa_bar / d_n;
    d_n_bar = b.kappa * P_n_bar;
  }
  P_N_bar.segment<3>(at) += P_n_bar * n;
  d_bar.segment<3>(at) += d_n_bar * n;
  bar.normal[k] += P_n_bar * P + d_n_bar * d;
}

void pullback(const ImpactProblem& p, const VectorXd& P_bar, ImpactProblemDerivative& bar) {
  const Branch b(p);
  VectorXd P_N_bar = P_bar, share_bar;
  MatrixXd C_bar;
  if (b.friction) {
    VectorXd d_bar = b.kappa * P_bar;
    const double kappa_bar = P_bar.dot(b.d);
    if (b.limit >= 0)
      limitPullback(p, b, kappa_bar, bar, P_N_bar, d_bar);
    else if (b.lowest_e_t >= 0)
      bar.pair[static_cast<std::size_t>(b.lowest_e_t)].tangential_elasticity += kappa_bar;
    b.solves[1].pullback(p, -d_bar, bar, C_bar, share_bar);
    addNormalColumns(C_bar, b.plastic_active, bar);
    b.solves[2].pullback(p, d_bar, bar, C_bar, share_bar);
    b.addStickColumns(p, C_bar, bar);
  }
  b.solves[0].pullback(p, P_N_bar, bar, C_bar, share_bar);
  addNormalColumns(C_bar, b.normal_active, bar);
  for (std::size_t c = 0; c < b.normal_active.size(); ++c)
    bar.pair[static_cast<std::size_t>(b.normal_active[c])].elasticity += share_bar[static_cast<Index>(c)];
}

}  // namespace

const ImpactLaw kJointLaw{"joint", solve, tangent, pullback};

}  // namespace carom
