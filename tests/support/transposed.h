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

std::vector<int> movingBodies(const Scene& scene);

/// expectTransposed of random seeds at times and at impacts, along a random direction: all of it, and each control's
/// part.
void expectTransposed(const Motion& motion, std::uint64_t seed, double most = 1e-13);

}  // namespace carom::test
