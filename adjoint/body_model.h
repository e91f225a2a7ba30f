#pragma once

#include "adjoint/scene.h"

namespace carom {

/// State of a moving body inside the integrator: `q` turns principal axes into world axes (R_WB), `L` is the world
/// angular momentum, constant in free flight.
struct State {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero();
  Vec3 L = Vec3::Zero();
};

/// Tangent of a State (theta: R <- exp([theta]x) R), or the adjoint of one.
struct StateDerivative {
  Vec3 x = Vec3::Zero(), theta = Vec3::Zero(), v = Vec3::Zero(), L = Vec3::Zero();

  double dot(const StateDerivative& o) const { return x.dot(o.x) + theta.dot(o.theta) + v.dot(o.v) + L.dot(o.L); }
  StateDerivative& operator+=(const StateDerivative& o) {
    x += o.x, theta += o.theta, v += o.v, L += o.L;
    return *this;
  }
  void addScaled(double s, const StateDerivative& o) { x += s * o.x, theta += s * o.theta, v += s * o.v, L += s * o.L; }
  bool isZero() const { return x.isZero(0) && theta.isZero(0) && v.isZero(0) && L.isZero(0); }
};

/// Mass properties in force (whatever way they were written), in principal axes.
struct BodyModel {
  bool moving = false;
  double mass = 0, inverse_mass = 0;
  Vec3 inertia = Vec3::Zero(), inverse_inertia = Vec3::Zero();
  bool has_offset = false;       ///< shape axes are not the principal axes
  Mat3 R_BG = Mat3::Identity();  ///< shape (geometry) to principal axes

  /// World inverse inertia R diag(1/I) R^T for R = R_WB.
  Mat3 inverseInertiaWorld(const Mat3& R_WB) const { return R_WB * inverse_inertia.asDiagonal() * R_WB.transpose(); }
};

/// Tangent or adjoint of the parameters of a BodyModel that vary.
struct BodyModelDerivative {
  double mass = 0;
  Vec3 inertia = Vec3::Zero();
};

BodyModel modelOf(const Body& body);
BodyModelDerivative modelTangent(const Body& body, const BodyDerivative& dbody);
void modelPullback(const Body& body, const BodyModelDerivative& model_bar, BodyDerivative& body_bar);

/// Start state as written -> integrator state (L = R diag(I) R^T omega), and its derivatives.
State startState(const Body& body, const BodyModel& model);
StateDerivative startTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody,
                             const BodyModelDerivative& dmodel);
void startPullback(const Body& body, const BodyModel& model, const StateDerivative& state_bar, BodyDerivative& body_bar,
                   BodyModelDerivative& model_bar);

}  // namespace carom
