// SPDX-License-Identifier: MIT
#include "adjoint/scene/body_model.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "adjoint/scene/body_pass.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

// Products of inertia below this share of the largest moment are rounding: the shape's axes are principal.
constexpr double kDiagonal = 1e-14;
// Derived moments that differ by less than this share are equal, but for the rounding of sums over parts.
constexpr double kEqual = 1e-13;

// Nothing of an open mesh: its mass and inertia are written, and its centre of mass is the shape's origin.
SolidProperties propertiesOf(const Body& body) {
  const ShapeKind& kind = kindOf(body.shape);
  return kind.solid(body.shape) ? kind.properties(body.shape) : SolidProperties{};
}
bool isDerived(const Body& body) { return body.inertia.source == Inertia::Source::derived; }

// Moments that ought to be equal become so, which keeps the body in the cheap tiers of flight.
void joinEqualMoments(Vec3& I) {
  const double tolerance = kEqual * I.maxCoeff();
  const auto near = [&](int i, int j) { return std::abs(I[i] - I[j]) <= tolerance; };
  if (near(0, 1) && near(1, 2) && near(0, 2)) {
    if (!(I[0] == I[1] && I[1] == I[2])) I.setConstant(I.mean());
    return;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (near(i, j) && I[i] != I[j]) I[i] = I[j] = 0.5 * (I[i] + I[j]);
  }
}

void setInertiaTensor(const Mat3& J, BodyModel& model) {
  const double products = std::max({std::abs(J(1, 2)), std::abs(J(0, 2)), std::abs(J(0, 1))});
  if (products <= kDiagonal * J.diagonal().maxCoeff() || !J.allFinite()) {
    model.inertia = J.diagonal();  // what is not finite is for validate to refuse
  } else {
    const Inertia inertia = Inertia::fromMatrix(J);
    model.inertia = inertia.moments;
    model.R_BG = inertia.axes.toRotationMatrix().transpose();
    model.has_offset = true;
  }
  joinEqualMoments(model.inertia);
}

}  // namespace

Vec3 centerOfMass(const Body& body) {
  if (body.fixed) return Vec3::Zero();
  return body.center_of_mass ? *body.center_of_mass : propertiesOf(body).center;
}

Eigen::Matrix3Xd centerOfMassRates(const Body& body) {
  const ShapeKind& kind = kindOf(body.shape);
  Eigen::Matrix3Xd rates = Eigen::Matrix3Xd::Zero(3, kind.dimensions(body.shape).size());
  if (body.fixed || body.center_of_mass) return rates;
  const SolidProperties solid = propertiesOf(body);
  for (std::size_t d = 0; d < solid.rates.size(); ++d) rates.col(static_cast<Eigen::Index>(d)) = solid.rates[d].center;
  return rates;
}

// m = density V or as written; J = m j when derived, or as written; c as written, or the shape's own. V, j and c are
// functions of the shape's dimensions.

BodyModel modelOf(const Body& body) {
  BodyModel model;
  if (body.fixed) return model;
  const bool all_written = body.center_of_mass && (body.kinematic || (body.mass && !isDerived(body)));
  const SolidProperties solid = all_written ? SolidProperties{} : propertiesOf(body);
  model.moving = true;
  model.center = body.center_of_mass ? *body.center_of_mass : solid.center;
  if (body.kinematic) {
    model.kinematic = true;
    model.gravity_factor = 0;
    model.inertia = model.inverse_inertia = Vec3::Ones();
    return model;
  }
  model.gravity_factor = body.gravity_factor;
  model.mass = body.density ? *body.density * solid.volume : *body.mass;
  model.inverse_mass = 1 / model.mass;
  if (isDerived(body)) {
    setInertiaTensor(model.mass * solid.unit_inertia, model);
  } else {
    model.inertia = body.inertia.moments;
  }
  if (body.inertia.source == Inertia::Source::matrix) {
    // axes turns principal axes into shape axes; the integrator's body axes are the principal ones
    model.R_BG = body.inertia.axes.normalized().toRotationMatrix().transpose();
    model.has_offset = !model.R_BG.isIdentity(0);
  }
  model.inverse_inertia = model.inertia.cwiseInverse();
  return model;
}

BodyModelDerivative modelTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody) {
  BodyModelDerivative dmodel;
  if (body.fixed) return dmodel;
  if (body.kinematic) {
    dmodel.center = centerOfMassRates(body) * dbody.size;
    return dmodel;
  }
  dmodel.mass = dbody.mass;
  if (!isDerived(body)) dmodel.inertia = dbody.inertia;
  const bool by_size = !dbody.size.isZero(0);
  if (!by_size && !body.density && !isDerived(body)) return dmodel;

  const SolidProperties solid = propertiesOf(body);
  SolidRate rate;
  for (std::size_t d = 0; d < solid.rates.size(); ++d) {
    const double size = dbody.size[static_cast<Eigen::Index>(d)];
    rate.volume += size * solid.rates[d].volume;
    rate.center += size * solid.rates[d].center;
    rate.unit_inertia += size * solid.rates[d].unit_inertia;
  }
  if (body.density) dmodel.mass = dbody.density * solid.volume + *body.density * rate.volume;
  if (!body.center_of_mass) dmodel.center = rate.center;
  if (isDerived(body)) {
    const Mat3 dJ_G = dmodel.mass * solid.unit_inertia + model.mass * rate.unit_inertia;
    const Mat3 dJ = model.R_BG * dJ_G * model.R_BG.transpose();
    dmodel.inertia = dJ.diagonal();
    dmodel.products = {dJ(1, 2), dJ(0, 2), dJ(0, 1)};
  }
  return dmodel;
}

void modelPullback(const Body& body, const BodyModel& model, const BodyModelDerivative& model_bar,
                   BodyDerivative& body_bar) {
  if (body.fixed) return;
  const bool by_size = !body.center_of_mass || (!body.kinematic && (body.density || isDerived(body)));
  modelPullbackOf(body, model, body.density.value_or(0), by_size ? propertiesOf(body) : SolidProperties{}, model_bar,
                  body_bar);
}

State startState(const Body& body, const BodyModel& model) {
  State s;
  s.q = body.orientation;
  s.x = body.position;
  if (!model.moving) return s;
  s.q.normalize();
  s.x += s.q * model.center;
  if (body.inertia.source == Inertia::Source::matrix && !model.kinematic) {
    s.q = (body.orientation * body.inertia.axes).normalized();
  } else if (model.has_offset) {
    s.q = (s.q * Quat(Mat3(model.R_BG.transpose()))).normalized();
  }
  s.v = body.velocity;
  const Mat3 R = s.q.toRotationMatrix();
  s.L = R * (model.inertia.asDiagonal() * (R.transpose() * body.angular_velocity));
  return s;
}

// With J = R diag(I) R^T: dL = J domega + dtheta x L - J (dtheta x omega) + R dJ R^T omega;
// with c_W = R_WG c: dx = dposition + dtheta x c_W + R_WG dc.

StateDerivative startTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody,
                             const BodyModelDerivative& dmodel) {
  StateDerivative ds;
  ds.x = dbody.position;
  ds.theta = dbody.orientation;
  if (!model.moving) return ds;
  const Mat3 R_WG = body.orientation.normalized().toRotationMatrix(), R = R_WG * model.R_BG.transpose();
  ds.x += dbody.orientation.cross(R_WG * model.center) + R_WG * dmodel.center;
  ds.v = dbody.velocity;
  const Mat3 J = R * model.inertia.asDiagonal() * R.transpose();
  const Vec3& w = body.angular_velocity;
  ds.L = J * (dbody.angular_velocity - dbody.orientation.cross(w)) + dbody.orientation.cross(J * w) +
         R * (dmodel.inertiaTensor() * (R.transpose() * w));
  return ds;
}

void startPullback(const Body& body, const BodyModel& model, const StateDerivative& state_bar, BodyDerivative& body_bar,
                   BodyModelDerivative& model_bar) {
  startPullbackOf<double>(model, body.orientation.normalized().toRotationMatrix(), body.angular_velocity, state_bar,
                          body_bar, model_bar);
}

}  // namespace carom
