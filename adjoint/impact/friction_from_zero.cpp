// SPDX-License-Identifier: MIT
#include "adjoint/impact/friction_from_zero.hpp"

#include <algorithm>

#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr double kAlike = 1e-9;  // of unit directions, scaled by K

bool sharesByFriction(const ConeTerms<double>& t, const std::vector<Eigen::Index>& rubbing) {
  const ConeProgramOf<double>& q = *t.program;
  const auto n = static_cast<Eigen::Index>(rubbing.size());
  Eigen::MatrixXd normals = Eigen::MatrixXd::Zero(q.b.size(), n), slips = normals;
  for (Eigen::Index c = 0; c < n; ++c) {
    const Eigen::Index k = rubbing[static_cast<std::size_t>(c)];
    const Vec3 &at = q.normal[static_cast<std::size_t>(k)], V = t.V.segment<3>(3 * k);
    normals.col(c).segment<3>(3 * k) = at;
    slips.col(c).segment<3>(3 * k) = (V - at.dot(V) * at).normalized();
  }
  const Eigen::MatrixXd A = normals.transpose() * q.K * normals, by_slip = (q.K * slips).transpose();
  const Eigen::MatrixXd determined = A * CompleteOrthogonal(A, kAlike).pseudoInverse() * by_slip;  // A A^+ is onto no free z
  return !((by_slip - determined).norm() <= kAlike * by_slip.norm());
}

}  // namespace

FromZero fromZero(const ConeTerms<double>& t) {
  const ConeProgramOf<double>& q = *t.program;
  const double fastest = q.b.cwiseAbs().maxCoeff();
  FromZero out;
  std::vector<Eigen::Index> rubbing;
  for (Eigen::Index k = 0; k < q.contacts(); ++k) {
    const auto kk = static_cast<std::size_t>(k);
    if (q.friction[kk] > 0 || t.at.state[kk] != ConeState::slides) continue;
    const Vec3 &n = q.normal[kk], V = t.V.segment<3>(3 * k);
    const double slip = (V - n.dot(V) * n).norm();
    out.margin = std::min(out.margin, fastest > 0 ? slip / fastest : 0);
    if (slip > 0) rubbing.push_back(k);
  }
  out.shared = rubbing.size() > 1 && sharesByFriction(t, rubbing);
  return out;
}

}  // namespace carom::adjoint_detail
