// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "adjoint/flight/arc.h"
#include "adjoint/scene/body_pass.hpp"

/// States, models and their adjoints in dual numbers, whose rates go along up to kLanes directions of the inputs at
/// once.
namespace carom::adjoint_detail {

inline constexpr std::size_t kLanes = 4;
using Num = Dual<static_cast<int>(kLanes)>;
using NVec = V3<Num>;
using NMat = M3<Num>;

using StateBar = StateDerivativeOf<Num>;
using ModelBar = BodyModelDerivativeOf<Num>;
using BodyBar = BodyDerivativeOf<Num>;
using SceneBar = SceneDerivativeOf<Num>;

/// BodyModel with its full inertia tensor J in body axes, which stay the principal axes of the values, and A = J^-1.
struct DualModel {
  bool moving = false, kinematic = false;
  double gravity_factor = 1;
  Num mass, inverse_mass;
  NMat J = NMat::Zero(), A = NMat::Zero();
  NVec center = NVec::Zero();
  Mat3 R_BG = Mat3::Identity();

  NMat shapeToWorld(const NMat& R_WB) const { return R_WB * R_BG; }
  NMat inverseInertiaWorld(const NMat& R_WB) const { return R_WB * A * R_WB.transpose(); }
};
inline NVec spinOf(const DualModel& m, const NMat& R, const NVec& L) { return R * (m.A * (R.transpose() * L)); }
inline NMat inertiaWorld(const DualModel& m, const NMat& R) { return R * m.J * R.transpose(); }

/// State with the orientation as a matrix, R_WB.
struct DualState {
  NVec x = NVec::Zero(), v = NVec::Zero(), L = NVec::Zero();
  NMat R = NMat::Identity();
};

/// The rates of a gradient along one direction; its values, which are the gradient itself.
SceneGradient ratesOf(const SceneBar& bar, const Scene& scene, std::size_t lane);
SceneGradient valuesOf(const SceneBar& bar, const Scene& scene);

inline NVec constant(const Vec3& v) { return v.cast<Num>(); }
inline NMat constant(const Mat3& m) { return m.cast<Num>(); }

/// R with R' = [theta]x R along one direction.
inline void turn(NMat& R, const Vec3& theta, std::size_t lane) { setRates(R, Mat3(skew(theta) * valuesOf(R)), lane); }

DualModel dualModel(const BodyModel& model);
void setRates(DualModel& dual, const BodyModelDerivative& d, std::size_t lane);
DualState dualState(const State& state);
void setRates(DualState& dual, const StateDerivative& d, std::size_t lane);

/// Adjoint of the mass properties and of the start as written, to the body; `direction` are the lanes of the body.
void startPullback(const Body& body, const DualModel& model, std::span<const BodyDerivative* const> lanes,
                   const StateBar& bar, BodyBar& body_bar, ModelBar& model_bar);
void modelPullback(const Body& body, const DualModel& model, std::span<const BodyDerivative* const> lanes,
                   const ModelBar& bar, BodyBar& body_bar);

}  // namespace carom::adjoint_detail
