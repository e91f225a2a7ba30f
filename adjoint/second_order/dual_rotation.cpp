// SPDX-License-Identifier: MIT
#include "adjoint/second_order/dual_rotation.hpp"

#include "adjoint/numeric/so3_rates.hpp"

namespace carom::adjoint_detail {
// The formulae of flight_symmetric.cpp. Those stay in doubles: they are called for every step of a derivative, and
// their small angles are tuned for one number.

DualSensitivity sphericalSensitivity(const Stretch& s) {
  const Num I = s.model.J.trace() / 3.0;
  const NVec a = s.start.L * (s.elapsed / I);
  const DualTurn<Num> turn(a);
  DualSensitivity S;
  S.dtheta_dtheta = turn.E;
  S.dtheta_dL = turn.J * (s.elapsed / I);
  const NVec by_I = -a / (3 * I);
  for (Eigen::Index i = 0; i < 3; ++i) S.dtheta_dI.col(i) = by_I;
  return S;
}

DualSensitivity symmetricSensitivity(const Stretch& s, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Num perp = 0.5 * (s.model.J(i, i) + s.model.J(j, j)), par = s.model.J(axis, axis);
  const Num c = (1.0 / par - 1.0 / perp) * s.elapsed;
  const NVec &L = s.start.L, a = L * (s.elapsed / perp), n = s.start.R.col(axis);
  const DualTurn<Num> turn(a);
  const NVec En = turn.E * n, nL = n.cross(L);
  const Num Ln = L.dot(n);
  DualSensitivity S;
  S.dtheta_dtheta = turn.E + c * (En * nL.transpose());
  S.dtheta_dL = turn.J * (s.elapsed / perp) + c * (En * n.transpose());
  const NVec by_perp = -a / perp + En * (Ln * s.elapsed / (perp * perp));
  S.dtheta_dI.col(axis) = -En * (Ln * s.elapsed / (par * par));
  S.dtheta_dI.col(i) = S.dtheta_dI.col(j) = 0.5 * by_perp;
  return S;
}

// The response with rates: along its own directions from its derivatives, along time from its equations,
//   G' = -w x G + A Phi,  Phi = R(h)^T R(0) + [M]x G,   H' = -w x H + A [M]x H + dA M.
DualSensitivity generalSensitivity(const Stretch& s, const BodyResponse& r) {
  const Mat3 A = valuesOf(s.model.A), R0 = valuesOf(s.start.R), Rh = valuesOf(s.R_end);
  const Vec3 M = Rh.transpose() * valuesOf(s.start.L), w = A * M;
  const Mat3 W = skew(w), MX = skew(M);
  const Mat3 slope_G = -W * r.G + A * (Rh.transpose() * R0 + MX * r.G);
  Mat3 slope_H = -W * r.H + A * MX * r.H, slope_P = -W * r.P + A * MX * r.P;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    slope_H(i, i) -= A(i, i) * w[i];
    if (!r.products) continue;
    slope_P(j, i) -= A(j, j) * w[k];
    slope_P(k, i) -= A(k, k) * w[j];
  }
  const NVec M0 = s.start.R.transpose() * s.start.L;
  NMat G = constant(r.G), H = constant(r.H), P = constant(r.P);
  const std::size_t count = r.dG.size();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Mat3 dJ = ratesOf(s.model.J, lane);
    std::array<double, 9> along{};
    for (std::size_t i = 0; i < 3; ++i) along[i] = M0[static_cast<Eigen::Index>(i)].rate[lane];
    along[3] = dJ(0, 0), along[4] = dJ(1, 1), along[5] = dJ(2, 2);
    along[6] = dJ(1, 2), along[7] = dJ(0, 2), along[8] = dJ(0, 1);
    const double ds = s.elapsed.rate[lane];
    Mat3 dG = ds * slope_G, dH = ds * slope_H, dP = ds * slope_P;
    for (std::size_t k = 0; k < count; ++k)
      if (along[k] != 0) dG += along[k] * r.dG[k], dH += along[k] * r.dH[k], dP += along[k] * r.dP[k];
    setRates(G, dG, lane);
    setRates(H, dH, lane);
    setRates(P, dP, lane);
  }
  const NMat RG = s.R_end * G, R0t = s.start.R.transpose();
  DualSensitivity S;
  S.dtheta_dL = RG * R0t;
  S.dtheta_dtheta = NMat::Identity() + RG * skew(M0) * R0t;
  S.dtheta_dI = s.R_end * H;
  S.dtheta_dproducts = s.R_end * P;
  return S;
}

}  // namespace carom::adjoint_detail
