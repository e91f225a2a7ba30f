#include "adjoint/body_model.h"

namespace carom {

// m = density V(size) or as written; I = m i(size) when derived, or as written.

BodyModel modelOf(const Body& body) {
  BodyModel model;
  if (body.fixed) return model;
  const SolidProperties solid = kindOf(body.shape).properties(body.shape);
  model.moving = true;
  model.mass = body.density ? *body.density * solid.volume : *body.mass;
  model.inverse_mass = 1 / model.mass;
  model.inertia =
      body.inertia.source == Inertia::Source::derived ? Vec3(model.mass * solid.unit_inertia) : body.inertia.moments;
  model.inverse_inertia = model.inertia.cwiseInverse();
  if (body.inertia.source == Inertia::Source::matrix) {
    // axes turns principal axes into shape axes; the integrator's body axes are the principal ones
    model.R_BG = body.inertia.axes.toRotationMatrix().transpose();
    model.has_offset = !model.R_BG.isIdentity(0);
  }
  return model;
}

BodyModelDerivative modelTangent(const Body& body, const BodyDerivative& dbody) {
  BodyModelDerivative dmodel;
  if (body.fixed) return dmodel;
  const SolidProperties solid = kindOf(body.shape).properties(body.shape);
  const double mass = body.density ? *body.density * solid.volume : *body.mass;
  dmodel.mass =
      body.density ? dbody.density * solid.volume + *body.density * solid.dvolume.dot(dbody.size) : dbody.mass;
  dmodel.inertia = body.inertia.source == Inertia::Source::derived
                       ? Vec3(dmodel.mass * solid.unit_inertia + mass * (solid.dunit_inertia * dbody.size))
                       : dbody.inertia;
  return dmodel;
}

void modelPullback(const Body& body, const BodyModelDerivative& model_bar, BodyDerivative& body_bar) {
  if (body.fixed) return;
  const SolidProperties solid = kindOf(body.shape).properties(body.shape);
  const double mass = body.density ? *body.density * solid.volume : *body.mass;
  double mass_bar = model_bar.mass;
  if (body.inertia.source == Inertia::Source::derived) {
    mass_bar += model_bar.inertia.dot(solid.unit_inertia);
    body_bar.size += mass * (solid.dunit_inertia.transpose() * model_bar.inertia);
  } else {
    body_bar.inertia += model_bar.inertia;
  }
  if (body.density) {
    body_bar.density += mass_bar * solid.volume;
    body_bar.size += mass_bar * *body.density * solid.dvolume;
  } else {
    body_bar.mass += mass_bar;
  }
}

namespace {

Mat3 principalToWorld(const Body& body, const BodyModel& model) {
  const Mat3 R_WG = body.orientation.toRotationMatrix();
  return model.has_offset ? Mat3(R_WG * model.R_BG.transpose()) : R_WG;
}

}  // namespace

State startState(const Body& body, const BodyModel& model) {
  State s;
  s.x = body.position;
  s.q = body.orientation;
  if (!model.moving) return s;
  if (body.inertia.source == Inertia::Source::matrix) s.q = body.orientation * body.inertia.axes;
  s.q.normalize();
  s.v = body.velocity;
  const Mat3 R = s.q.toRotationMatrix();
  s.L = R * (model.inertia.asDiagonal() * (R.transpose() * body.angular_velocity));
  return s;
}

// With J = R diag(I) R^T: dL = J domega + dtheta x L - J (dtheta x omega) + R diag(dI) R^T omega.

StateDerivative startTangent(const Body& body, const BodyModel& model, const BodyDerivative& dbody,
                             const BodyModelDerivative& dmodel) {
  StateDerivative ds;
  ds.x = dbody.position;
  ds.theta = dbody.orientation;
  if (!model.moving) return ds;
  ds.v = dbody.velocity;
  const Mat3 R = principalToWorld(body, model);
  const Mat3 J = R * model.inertia.asDiagonal() * R.transpose();
  const Vec3& w = body.angular_velocity;
  ds.L = J * (dbody.angular_velocity - dbody.orientation.cross(w)) + dbody.orientation.cross(J * w) +
         R * (dmodel.inertia.asDiagonal() * (R.transpose() * w));
  return ds;
}

void startPullback(const Body& body, const BodyModel& model, const StateDerivative& state_bar, BodyDerivative& body_bar,
                   BodyModelDerivative& model_bar) {
  body_bar.position += state_bar.x;
  body_bar.orientation += state_bar.theta;
  if (!model.moving) return;
  body_bar.velocity += state_bar.v;
  const Mat3 R = principalToWorld(body, model);
  const Mat3 J = R * model.inertia.asDiagonal() * R.transpose();
  const Vec3& w = body.angular_velocity;
  const Vec3 w_bar = J * state_bar.L;
  body_bar.angular_velocity += w_bar;
  // L_bar.(dtheta x Jw) = dtheta.(Jw x L_bar);  -w_bar.(dtheta x w) = -dtheta.(w x w_bar)
  body_bar.orientation += (J * w).cross(state_bar.L) - w.cross(w_bar);
  model_bar.inertia += (R.transpose() * state_bar.L).cwiseProduct(R.transpose() * w);
}

}  // namespace carom
