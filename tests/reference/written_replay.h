// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "tests/reference/written_body.h"

namespace carom::reference {

/// A plane { p : n . p = offset } in its own axes, and where it is.
struct FloorNumbers {
  RVec normal, position;
  Real offset;
  RMat orientation = RMat::identity();
};

/// One body on one floor.
struct ThrowNumbers {
  WrittenNumbers body;
  FloorNumbers floor;
};
ThrowNumbers throwNumbers(const Scene& scene, int body, int floor);

/// An impact of the sequence that is followed: the swept point (numbered as in tests/support/swept_points.h) and the
/// mode are frozen, the time is a first guess.
struct PointImpact {
  int point = 0;
  ImpactMode mode = ImpactMode::frictionless;
  Real time = 0;
};

/// State as people write it.
struct WrittenState {
  RVec position, velocity, spin;
  RMat R;
  Real time;
};

/// The states just before each impact, and at the end. Throws std::runtime_error where the sequence cannot be followed;
/// with `decide`, also where the impact law takes another mode.
std::vector<WrittenState> replay(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts, const Real& end,
                                 bool decide);

/// One number that can vary, and its place in a derivative.
struct ThrowKnob {
  std::string name;
  std::function<void(ThrowNumbers&, const Real& change)> nudge;
  std::function<double&(SceneDerivative&)> entry;
};
std::vector<ThrowKnob> throwKnobs(const ThrowNumbers& numbers, int body, int floor);

/// The part of a derivative by the mass or density that comes through the derived inertia. For a lone body it cancels
/// the rest, so the whole is to be held to this size and not to its own, which is 0.
ThrowKnob inertiaOfMass();

/// d(position, rotation vector, velocity, angular velocity, time) of each of the states of `replay`.
using MomentRates = std::vector<Eigen::Matrix<double, 13, 1>>;

/// By each of the knobs, by differences in the same arithmetic.
std::vector<MomentRates> replayDerivatives(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts,
                                           const Real& end, const std::vector<ThrowKnob>& knobs);

/// The rates of the derivatives by `columns_of` as all `knobs` change along `direction`, one number each: by central
/// differences of differences.
std::vector<MomentRates> replaySecondDerivatives(const ThrowNumbers& numbers, const std::vector<PointImpact>& impacts,
                                                 const Real& end, const std::vector<ThrowKnob>& knobs,
                                                 const std::vector<double>& direction,
                                                 const std::vector<ThrowKnob>& columns_of);

}  // namespace carom::reference
