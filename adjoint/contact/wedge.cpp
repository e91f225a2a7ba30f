// SPDX-License-Identifier: MIT
#include "adjoint/contact/wedge.hpp"

#include "adjoint/numeric/symmetric_eigen.hpp"

namespace carom::adjoint_detail {
namespace {

// Of the largest eigenvalue what counts as 0, and of the friction that a push takes what is rounding.
constexpr double kMovesNothing = 1e-12, kOnCone = 1e-7;

}  // namespace

std::optional<std::pair<int, int>> wedgedPair(const ConeProgramOf<double>& program) {
  const int n = program.contacts();
  const auto bears = [&](int k, const Vec3& f) {
    const Vec3& normal = program.normal[static_cast<std::size_t>(k)];
    const double pressing = normal.dot(f);
    return pressing > 0 && (f - pressing * normal).norm() <= (1 + kOnCone) * program.friction[static_cast<std::size_t>(k)] * pressing;
  };
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < k; ++l) {
      Eigen::MatrixXd K(6, 6);
      K << program.K.block<3, 3>(3 * k, 3 * k), program.K.block<3, 3>(3 * k, 3 * l), program.K.block<3, 3>(3 * l, 3 * k),
          program.K.block<3, 3>(3 * l, 3 * l);
      const SymmetricEigen<double> eigen(K);
      if (!(eigen.values[0] <= kMovesNothing * eigen.values[5])) continue;
      for (const double sign : {1.0, -1.0}) {
        const Eigen::VectorXd f = sign * eigen.vectors.col(0);
        if (bears(k, f.head<3>()) && bears(l, f.tail<3>())) return std::pair(l, k);
      }
    }
  return std::nullopt;
}

}  // namespace carom::adjoint_detail
