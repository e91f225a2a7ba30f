// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "adjoint/flight/arc.h"
#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/scene.h"

/// States, models and their adjoints in dual numbers, whose rates go along up to kLanes directions of the inputs at
/// once.
namespace carom::detail {

inline constexpr std::size_t kLanes = 4;
using Num = Dual<static_cast<int>(kLanes)>;
using NVec = V3<Num>;
using NMat = M3<Num>;

/// BodyModel with its full inertia tensor J in body axes, which stay the principal axes of the values, and A = J^-1.
struct DualModel {
  bool moving = false, kinematic = false;
  double gravity_factor = 1;
  Num mass, inverse_mass;
  NMat J = NMat::Zero(), A = NMat::Zero();
  NVec center = NVec::Zero();
  Mat3 R_BG = Mat3::Identity();
};

/// State with the orientation as a matrix, R_WB.
struct DualState {
  NVec x = NVec::Zero(), v = NVec::Zero(), L = NVec::Zero();
  NMat R = NMat::Identity();

  NVec omega(const DualModel& m) const { return R * (m.A * (R.transpose() * L)); }
};

inline bool isZero(const Num& n) {
  if (n.value != 0) return false;
  for (double r : n.rate)
    if (r != 0) return false;
  return true;
}
inline bool isZero(const NVec& v) { return isZero(v[0]) && isZero(v[1]) && isZero(v[2]); }

/// Adjoint of a State, or its rate in time.
struct StateBar {
  NVec x = NVec::Zero(), theta = NVec::Zero(), v = NVec::Zero(), L = NVec::Zero();

  StateBar& operator+=(const StateBar& o) {
    x += o.x, theta += o.theta, v += o.v, L += o.L;
    return *this;
  }
  Num dot(const StateBar& o) const { return x.dot(o.x) + theta.dot(o.theta) + v.dot(o.v) + L.dot(o.L); }
  bool isZero() const { return detail::isZero(x) && detail::isZero(theta) && detail::isZero(v) && detail::isZero(L); }
};

/// Adjoint of a BodyModel; see BodyModelDerivative.
struct ModelBar {
  Num mass;
  NVec inertia = NVec::Zero(), products = NVec::Zero(), center = NVec::Zero();

  void addInertiaBar(const NMat& J_bar) {
    inertia += J_bar.diagonal();
    products += NVec(J_bar(1, 2) + J_bar(2, 1), J_bar(0, 2) + J_bar(2, 0), J_bar(0, 1) + J_bar(1, 0));
  }
  ModelBar& operator+=(const ModelBar& o) {
    mass += o.mass, inertia += o.inertia, products += o.products, center += o.center;
    return *this;
  }
};

struct PairNums {
  Num elasticity, friction, tangential_elasticity;
};

/// Adjoint of a Body and of a Scene, with the fields of BodyDerivative and SceneDerivative.
struct BodyBar {
  NVec position = NVec::Zero(), orientation = NVec::Zero(), velocity = NVec::Zero(), angular_velocity = NVec::Zero();
  Num mass, density;
  NVec inertia = NVec::Zero();
  Eigen::Matrix<Num, Eigen::Dynamic, 1> size;
};
struct SceneBar {
  explicit SceneBar(const Scene& scene);
  /// The rates along one direction.
  SceneGradient rates(const Scene& scene, std::size_t lane) const;
  /// The values, which are the gradient itself.
  SceneGradient values(const Scene& scene) const;

  NVec gravity = NVec::Zero();
  std::vector<PairNums> materials;
  std::vector<BodyBar> bodies;
  std::vector<V2<Num>> tilts;

 private:
  template <class OfNum, class OfMatrix>
  SceneGradient picked(const Scene& scene, const OfNum& number, const OfMatrix& matrix) const;
};

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

}  // namespace carom::detail
