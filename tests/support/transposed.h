// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adjoint/derivative/tangent.h"

/// Equation 5.5: <J u, w> = <u, J^T w>.
namespace carom::test {

/// Fails where tangent and adjoint pass differ by more than `most` of the sum of absolute products, which is at least
/// `least` and is returned.
double expectTransposed(DerivativeTape& tape, const SceneTangent& direction, const std::vector<StateSeed>& seeds,
                        double least, const std::string& what, double most = 1e-13);

/// The fields of a SceneDerivative that one kind of control varies.
struct ControlRow {
  const char* name;
  std::function<void(SceneTangent& to, const SceneTangent& from)> copy;
};
std::vector<ControlRow> controlRows();

/// Weights of the central difference of order h^8 over steps of h, 2 h, 3 h and 4 h.
inline constexpr double kEighthOrder[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
/// Position, world rotation vector, velocity and angular velocity by which a state differs from another one.
Eigen::Matrix<double, 12, 1> changeOf(const BodyState& from, const BodyState& to);

std::vector<int> movingBodies(const Scene& scene);

/// expectTransposed of random seeds at times and at impacts, along a random direction: all of it, and each control's
/// part.
void expectTransposed(const Motion& motion, std::uint64_t seed, double most = 1e-13);

}  // namespace carom::test
