// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom {

/// State of a moving body inside the integrator: `q` rotates principal axes to world axes (R_WB), `L` is the world
/// angular momentum, constant in free flight.
struct State {
  Vec3 x = Vec3::Zero();      ///< m, centre of mass
  Quat q = Quat::Identity();  ///< R_WB
  Vec3 v = Vec3::Zero();      ///< m/s, of the centre of mass
  Vec3 L = Vec3::Zero();      ///< kg m^2/s, about the centre of mass, world axes
};

/// Whether a number, or each of several, is 0; dual numbers have an isZero of their own.
inline bool isZero(double x) { return x == 0; }
/// The same of three.
template <class S>
bool isZero(const Eigen::Matrix<S, 3, 1>& v) {
  return isZero(v[0]) && isZero(v[1]) && isZero(v[2]);
}

/// Tangent of a State (theta: R <- exp([theta]x) R), or the adjoint of one.
template <class S>
struct StateDerivativeOf {
  using Vector = Eigen::Matrix<S, 3, 1>;  ///< three numbers
  Vector x = Vector::Zero();              ///< of the centre of mass
  Vector theta = Vector::Zero();          ///< of the orientation
  Vector v = Vector::Zero();              ///< of the velocity
  Vector L = Vector::Zero();              ///< of the angular momentum

  /// Sum of products, <adjoint, tangent>.
  S dot(const StateDerivativeOf& o) const { return x.dot(o.x) + theta.dot(o.theta) + v.dot(o.v) + L.dot(o.L); }
  /// Field by field.
  StateDerivativeOf& operator+=(const StateDerivativeOf& o) {
    x += o.x, theta += o.theta, v += o.v, L += o.L;
    return *this;
  }
  /// Adds s times the other.
  void addScaled(double s, const StateDerivativeOf& o) {
    x += s * o.x, theta += s * o.theta, v += s * o.v, L += s * o.L;
  }
  /// Exactly.
  bool isZero() const { return carom::isZero(x) && carom::isZero(theta) && carom::isZero(v) && carom::isZero(L); }
};
using StateDerivative = StateDerivativeOf<double>;  ///< in doubles

/// Mass properties in force (however they were specified), in principal axes. A kinematic body moves like a free body
/// with three equal moments and without gravity: its inertia is the unit tensor, so that L is its angular velocity,
/// and impacts use neither its mass nor its inertia.
struct BodyModel {
  bool moving = false;        ///< not fixed
  bool kinematic = false;     ///< moves unaffected by impacts
  double gravity_factor = 1;  ///< 0 for a kinematic body
  double mass = 0;                       ///< kg
  double inverse_mass = 0;               ///< 1/kg; 0 for fixed and kinematic bodies
  Vec3 inertia = Vec3::Zero();           ///< kg m^2, principal moments about the centre of mass
  Vec3 inverse_inertia = Vec3::Zero();   ///< their inverses
  Vec3 center = Vec3::Zero();    ///< centre of mass in shape axes, p_GB; 0 for a fixed body
  bool has_offset = false;       ///< shape axes are not the principal axes
  Mat3 R_BG = Mat3::Identity();  ///< shape (geometry) to principal axes

  /// R_WG, shape axes to world, for the R_WB of a State.
  Mat3 shapeToWorld(const Mat3& R_WB) const { return has_offset ? Mat3(R_WB * R_BG) : R_WB; }
  /// World inverse inertia R diag(1/I) R^T for R = R_WB.
  Mat3 inverseInertiaWorld(const Mat3& R_WB) const { return R_WB * inverse_inertia.asDiagonal() * R_WB.transpose(); }
  /// The same for the impact law: zero for fixed and kinematic bodies.
  Mat3 mobilityWorld(const Mat3& R_WB) const { return kinematic ? Mat3::Zero().eval() : inverseInertiaWorld(R_WB); }
};

/// Tangent or adjoint of the parameters of a BodyModel. The change of the inertia tensor in the principal axes, which
/// are held fixed in the shape, is diag(inertia) plus `products` off the diagonal: (yz, xz, xy).
template <class S>
struct BodyModelDerivativeOf {
  using Vector = Eigen::Matrix<S, 3, 1>;  ///< three numbers
  using Matrix = Eigen::Matrix<S, 3, 3>;  ///< 3x3
  S mass = 0;                             ///< kg
  Vector inertia = Vector::Zero();        ///< kg m^2, of the diagonal
  Vector products = Vector::Zero();       ///< kg m^2, off the diagonal: yz, xz, xy
  Vector center = Vector::Zero();         ///< m, in shape axes

  /// Read as a tangent: dJ, the change of the inertia tensor in principal axes.
  Matrix inertiaTensor() const {
    Matrix dJ;
    dJ << inertia[0], products[2], products[1], products[2], inertia[1], products[0], products[1], products[0],
        inertia[2];
    return dJ;
  }
  /// Read as an adjoint: adds that of the functional <J_bar, dJ>.
  void addInertiaBar(const Matrix& J_bar) {
    inertia += J_bar.diagonal();
    products += Vector(J_bar(1, 2) + J_bar(2, 1), J_bar(0, 2) + J_bar(2, 0), J_bar(0, 1) + J_bar(1, 0));
  }
  /// Field by field.
  BodyModelDerivativeOf& operator+=(const BodyModelDerivativeOf& o) {
    mass += o.mass, inertia += o.inertia, products += o.products, center += o.center;
    return *this;
  }
  /// Exactly.
  bool isZero() const {
    using carom::isZero;
    return isZero(mass) && isZero(inertia) && isZero(products) && isZero(center);
  }
};
using BodyModelDerivative = BodyModelDerivativeOf<double>;  ///< in doubles

/// Centre of mass of a moving body in shape axes, as written or else the shape's own. 0 for a fixed body. For a
/// kinematic body the point whose velocity is given.
Vec3 centerOfMass(const Body& body);
/// Its derivatives with respect to the dimensions of the shape, 3 x dimensions.
Eigen::Matrix3Xd centerOfMassRates(const Body& body);

/// Mass properties of a body in force.
BodyModel modelOf(const Body& body);
/// `model` is modelOf(body): its principal axes, in which dJ is given, are held fixed.
BodyModelDerivative modelTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody);
/// The adjoint of modelTangent; adds to that of the body.
void modelPullback(const Body& body, const BodyModel& model, const BodyModelDerivative& model_bar,
                   BodyDerivative& body_bar);

/// Start state as written -> integrator state: x = position + R_WG center, L = R diag(I) R^T omega.
State startState(const Body& body, const BodyModel& model);
/// Its tangent.
StateDerivative startTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody,
                             const BodyModelDerivative& dmodel);
/// Its adjoint; adds to those of the body and of the model.
void startPullback(const Body& body, const BodyModel& model, const StateDerivative& state_bar, BodyDerivative& body_bar,
                   BodyModelDerivative& model_bar);

}  // namespace carom
