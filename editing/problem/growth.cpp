// SPDX-License-Identifier: MIT
#include "editing/problem/growth.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/numeric/elementary.hpp"
#include "editing/problem/controls/natural_scales.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

/// |weights| of a functional of states, in natural scales.
double norm(const NaturalScales& scales, const Vec3& x, const Vec3& theta, const Vec3& v, const Vec3& w) {
  return std::sqrt((scales.length * x).squaredNorm() + theta.squaredNorm() + (scales.velocity * v).squaredNorm() +
                   (scales.angular_velocity * w).squaredNorm());
}

}  // namespace

double growthOf(const Motion& motion, const EditProblem& problem, const RowValues& rows) {
  const Scene& scene = problem.controls.startScene();
  DerivativeTape tape(motion, problem.leaver());
  double growth = 0;
  for (const std::vector<StateSeed>& seeds : rows.seeds) {
    double free = 0;
    for (const StateSeed& seed : seeds) {
      const NaturalScales scales = naturalScales(scene, seed.body);
      const double t = readPlace(motion, seed.body, seed.at).time;
      const double flown = elementary::hypot(1, t / scales.time);
      free += norm(scales, flown * (seed.position + seed.center_of_mass), flown * seed.orientation, seed.velocity,
                   seed.angular_velocity);
      free += flown * scales.time * std::abs(seed.time);
    }
    if (!(free > 0)) continue;
    const SceneGradient gradient = adjoint(tape, seeds);
    double square = 0;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].fixed) continue;
      const BodyDerivative& d = gradient.bodies[b];
      const double one =
          norm(naturalScales(scene, static_cast<int>(b)), d.position, d.orientation, d.velocity, d.angular_velocity);
      square += one * one;
    }
    growth = std::max(growth, std::sqrt(square) / free);
  }
  return growth;
}

}  // namespace carom::editing_detail
