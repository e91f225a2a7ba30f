// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

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

/// Mass properties in force (whatever way they were written), in principal axes. A kinematic body moves as a free body
/// does that has three equal moments and no weight: its inertia is the unit tensor, so that L is its angular velocity,
/// and impacts see neither mass nor inertia of it.
struct BodyModel {
  bool moving = false;
  bool kinematic = false;
  double gravity_factor = 1;  ///< 0 for a kinematic body
  double mass = 0, inverse_mass = 0;
  Vec3 inertia = Vec3::Zero(), inverse_inertia = Vec3::Zero();
  Vec3 center = Vec3::Zero();    ///< centre of mass in shape axes, p_GB; 0 for a fixed body
  bool has_offset = false;       ///< shape axes are not the principal axes
  Mat3 R_BG = Mat3::Identity();  ///< shape (geometry) to principal axes

  /// R_WG, shape axes to world, for the R_WB of a State.
  Mat3 shapeToWorld(const Mat3& R_WB) const { return has_offset ? Mat3(R_WB * R_BG) : R_WB; }
  /// World inverse inertia R diag(1/I) R^T for R = R_WB.
  Mat3 inverseInertiaWorld(const Mat3& R_WB) const { return R_WB * inverse_inertia.asDiagonal() * R_WB.transpose(); }
  /// The same as impacts see it: zero for a body that they do not move.
  Mat3 mobilityWorld(const Mat3& R_WB) const { return kinematic ? Mat3::Zero().eval() : inverseInertiaWorld(R_WB); }
};

/// Tangent or adjoint of the parameters of a BodyModel that vary. The change of the inertia tensor in the principal
/// axes, which stay where they are in the shape, is diag(inertia) plus `products` off the diagonal: (yz, xz, xy).
struct BodyModelDerivative {
  double mass = 0;
  Vec3 inertia = Vec3::Zero();
  Vec3 products = Vec3::Zero();
  Vec3 center = Vec3::Zero();  ///< in shape axes

  /// Read as a tangent: dJ, the change of the inertia tensor in principal axes.
  Mat3 inertiaTensor() const {
    Mat3 dJ;
    dJ << inertia[0], products[2], products[1], products[2], inertia[1], products[0], products[1], products[0],
        inertia[2];
    return dJ;
  }
  /// Read as an adjoint: adds that of the functional <J_bar, dJ>.
  void addInertiaBar(const Mat3& J_bar) {
    inertia += J_bar.diagonal();
    products += Vec3(J_bar(1, 2) + J_bar(2, 1), J_bar(0, 2) + J_bar(2, 0), J_bar(0, 1) + J_bar(1, 0));
  }
  BodyModelDerivative& operator+=(const BodyModelDerivative& o) {
    mass += o.mass, inertia += o.inertia, products += o.products, center += o.center;
    return *this;
  }
  bool isZero() const { return mass == 0 && inertia.isZero(0) && products.isZero(0) && center.isZero(0); }
};

/// Centre of mass of a moving body in shape axes, as written or else the shape's own, and its rates by the dimensions
/// (3 x dimensions). 0 for a fixed body. Of a kinematic body it is the point that its velocity is of.
Vec3 centerOfMass(const Body& body);
Eigen::Matrix3Xd centerOfMassRates(const Body& body);

BodyModel modelOf(const Body& body);
/// `model` is modelOf(body): its principal axes, in which dJ is given, stay where they are.
BodyModelDerivative modelTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody);
void modelPullback(const Body& body, const BodyModel& model, const BodyModelDerivative& model_bar,
                   BodyDerivative& body_bar);

/// Start state as written -> integrator state (x = position + R_WG center, L = R diag(I) R^T omega), and its
/// derivatives.
State startState(const Body& body, const BodyModel& model);
StateDerivative startTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody,
                             const BodyModelDerivative& dmodel);
void startPullback(const Body& body, const BodyModel& model, const StateDerivative& state_bar, BodyDerivative& body_bar,
                   BodyModelDerivative& model_bar);

}  // namespace carom
