// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_rates.hpp"

namespace carom::adjoint_detail {

ConstrainedRates::ConstrainedRates(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const ConstrainedInputs& inputs,
                     const State& state, double t, std::vector<Vec3> slip, bool may_be_flat)
    : scene_(scene), contacts_(contacts), inputs_(inputs), state_(state), slip_(std::move(slip)),
      now_(instantOf(scene, contacts, state, t, slip_)),
      own_{state.x, scene.model->shapeToWorld(state.q.toRotationMatrix())} {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PersistentContact& c = contacts[k];
    flows_.push_back(SupportFlow::of(scene.with[k], scene.time, t));
    if (const double speed = now_.slipAt(k).norm(); follows(k) && speed > 0) now_.contacts[k].slip = now_.slipAt(k) / speed;
    if (may_be_flat) flat_.push_back(FlatRim::of(scene, c, k, own_, now_.body.omega));
    if (may_be_flat && flat_.back()) {  // it has no derivatives there by the pose alone
      jacobians_.emplace_back(), jacobian_rates_.emplace_back();
      continue;
    }
    const int a = c.is_first ? scene.body : c.with, b = c.is_first ? c.with : scene.body;
    const SupportInstant<double> support = scene.with[k].at(t);
    const Pose other{support.x, support.R}, &A = c.is_first ? own_ : other, &B = c.is_first ? other : own_;
    jacobians_.push_back(scene.geometry->jacobian(a, b, c.features, A, B));
    PairTangent way;
    way.pose.segment<6>(c.is_first ? 0 : 6) << state.v, now_.body.omega;
    way.pose.segment<6>(c.is_first ? 6 : 0) << support.v, support.w;
    jacobian_rates_.push_back(scene.geometry->jacobianRates(a, b, c.features, A, B, std::span(&way, 1)).front());
  }
}

ConstrainedLanes ConstrainedRates::lanes(int first, int count) const {
  ConstrainedLanes out;
  fillBody(out, first, count);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    ConstrainedLanes::Number gap = 0;
    out.contacts.push_back(contactLanes(out, k, first, count, gap));
    out.gap.push_back(gap);
  }
  return out;
}

void ConstrainedRates::fillBody(ConstrainedLanes& out, int first, int count) const {
  using Number = ConstrainedLanes::Number;
  using I = ConstrainedInputs;
  const BodyModel& model = *scene_.model;
  BodyInstant<Number>& body = out.body;
  out.x = state_.x.cast<Number>();
  const Mat3 R = state_.q.toRotationMatrix();
  M3<Number> turned = R.cast<Number>(), inverse = Mat3(model.inverse_inertia.asDiagonal()).cast<Number>();
  body.v = state_.v.cast<Number>(), body.L = state_.L.cast<Number>(), body.gravity = scene_.gravity.cast<Number>();
  body.inverse_mass = model.inverse_mass;
  const auto in = [](int column, int begin, int size) { return column >= begin && column < begin + size; };
  for (int lane = 0; lane < count; ++lane) {
    const int column = first + lane;
    const auto at = static_cast<std::size_t>(lane);
    if (in(column, 0, 3)) out.x[column].rate[at] = 1;
    if (in(column, 3, 3)) setRates(turned, Mat3(skew(Vec3(Vec3::Unit(column - 3))) * R), at);
    if (in(column, 6, 3)) body.v[column - 6].rate[at] = 1;
    if (in(column, 9, 3)) body.L[column - 9].rate[at] = 1;
    if (in(column, I::kGravity, 3)) body.gravity[column - I::kGravity].rate[at] = model.gravity_factor;
    if (column == I::kMass) body.inverse_mass.rate[at] = -model.inverse_mass * model.inverse_mass;
    if (in(column, I::kInertia, 6)) {
      Mat3 dJ = Mat3::Zero();
      if (column < I::kProducts) {
        const int i = column - I::kInertia;
        dJ(i, i) = 1;
      } else {
        const int of = column - I::kProducts, row = (of + 1) % 3, other = (of + 2) % 3;
        dJ(row, other) = dJ(other, row) = 1;
      }
      const Mat3 D = model.inverse_inertia.asDiagonal();
      setRates(inverse, Mat3(-D * dJ * D), at);
    }
  }
  body.A = turned * inverse * turned.transpose();
  body.omega = body.A * body.L;
  out.R = model.has_offset ? M3<Number>(turned * model.R_BG.cast<Number>()) : turned;
}

ContactInstant<ConstrainedLanes::Number> ConstrainedRates::contactLanes(const ConstrainedLanes& of, std::size_t k, int first, int count,
                                                          ConstrainedLanes::Number& gap) const {
  using Number = ConstrainedLanes::Number;
  const PersistentContact& held = contacts_[k];
  const ContactInstant<double>& now = now_.contacts[k];
  ContactInstant<Number> c;
  c.mode = held.mode;
  c.n = now.n.cast<Number>(), c.normal_rate = now.normal_rate.cast<Number>();
  c.point_rate = now.point_rate.cast<Number>();
  c.friction = held.friction;
  if (const int lane = inputs_.friction + static_cast<int>(k) - first; lane >= 0 && lane < count)
    c.friction.rate[static_cast<std::size_t>(lane)] = 1;
  if (!flat_.empty() && flat_[k]) {
    flat_[k]->place(of, inputs_, k, first, count, c, gap);
  } else {
    placeLanes(of, k, first, count, c, gap);
  }
  if (scene_.with[k].drives()) {
    const auto support = inputs_.supportOf<Number>(scene_.with[k], k, first, count, flows_[k]);
    const V3<Number> point = of.x + c.r;
    c.support_velocity = support.velocityAt(point, c.n);
    c.support_acceleration = support.accelerationAt(point, c.n, c.point_rate, c.normal_rate);
  }
  c.slip = slip_[k].cast<Number>();
  if (follows(k)) {
    const V3<Number> u = of.body.relativeVelocity(c), along_face = u - c.n * c.n.dot(u);
    const Number speed = sqrt(along_face.squaredNorm());
    if (speed.value > 0) c.slip = along_face / speed;
  }
  return c;
}

void ConstrainedRates::placeLanes(const ConstrainedLanes& of, std::size_t k, int first, int count, ContactInstant<ConstrainedLanes::Number>& c,
                           ConstrainedLanes::Number& gap) const {
  using Number = ConstrainedLanes::Number;
  const PersistentContact& held = contacts_[k];
  const double sign = held.is_first ? 1 : -1;
  const int own = held.is_first ? 0 : 6;
  V3<Number> point = Vec3(now_.contacts[k].r + state_.x).cast<Number>();
  // J q', where q' changes
  for (int i = 0; i < 3; ++i) {
    Number normal = 0, place = 0;
    for (int j = 0; j < 6; ++j) {
      const Number& rate = j < 3 ? of.body.v[j] : of.body.omega[j - 3];
      normal += rate * (sign * jacobians_[k].pose(1 + i, own + j));
      place += rate * jacobians_[k].pose(4 + i, own + j);
    }
    if (flows_[k].moves) addSupportRate(k, first, count, i, normal, place);
    c.normal_rate[i].rate = normal.rate, c.point_rate[i].rate = place.rate;
  }
  addGeometry(c, point, gap, k, first, count);
  c.r = point - of.x;
}

// J q' of the support, where its velocities change.
void ConstrainedRates::addSupportRate(std::size_t k, int first, int count, int i, ConstrainedLanes::Number& normal,
                                      ConstrainedLanes::Number& place) const {
  const ConstrainedInputs::Partner& p = inputs_.partners[inputs_.partner_of[k]];
  const double sign = contacts_[k].is_first ? 1 : -1;
  const int other = contacts_[k].is_first ? 6 : 0;
  for (int lane = 0; lane < count; ++lane) {
    const int j = first + lane - p.velocity;
    if (j < 0 || j >= 6) continue;
    normal.rate[static_cast<std::size_t>(lane)] += sign * jacobians_[k].pose(1 + i, other + j);
    place.rate[static_cast<std::size_t>(lane)] += jacobians_[k].pose(4 + i, other + j);
  }
}

// Of J q' of the support as that turns by a: J (W x a).
Eigen::Matrix<double, 7, 1> ConstrainedRates::bentBySupport(std::size_t k, int column) const {
  const auto by = inputs_.partners[inputs_.partner_of[k]].poseBy(column, flows_[k]);
  if (!by) return Eigen::Matrix<double, 7, 1>::Zero();
  const Vec3 turn = by->tail<3>();
  const Vec3 W = scene_.with[k].at(flows_[k].now).w;
  return jacobians_[k].pose.middleCols<3>(contacts_[k].is_first ? 9 : 3) * W.cross(turn);
}

// Where columns move the pair: the gap, the normal and the point, and J q', where J changes. Second derivatives are
// symmetric, so that is J' along each column, with J' along the way of the body; but for turns: the change of J q' as the
// body turns by a is J' a + J (omega x a).
void ConstrainedRates::addGeometry(ContactInstant<ConstrainedLanes::Number>& c, V3<ConstrainedLanes::Number>& point, ConstrainedLanes::Number& gap,
                            std::size_t k, int first, int count) const {
  const PersistentContact& held = contacts_[k];
  const double sign = held.is_first ? 1 : -1;
  const int own_turn = held.is_first ? 3 : 9;
  for (int lane = 0; lane < count; ++lane) {
    const int column = first + lane;
    const auto d = inputs_.columnOf(jacobians_[k], held, k, column, flows_[k]);
    if (!d) continue;
    const auto at = static_cast<std::size_t>(lane);
    gap.rate[at] = (*d)[0];
    setRates(c.n, Vec3(sign * d->segment<3>(1)), at);
    setRates(point, Vec3(d->tail<3>()), at);
    Eigen::Matrix<double, 7, 1> bent = *inputs_.columnOf(jacobian_rates_[k], held, k, column, flows_[k]);
    if (column >= 3 && column < 6)
      bent += jacobians_[k].pose.middleCols<3>(own_turn) * now_.body.omega.cross(Vec3(Vec3::Unit(column - 3)));
    if (flows_[k].moves && column >= ConstrainedInputs::kSizes) bent += bentBySupport(k, column);
    for (int j = 0; j < 3; ++j) {
      c.normal_rate[j].rate[at] += sign * bent[1 + j];
      c.point_rate[j].rate[at] += bent[4 + j];
    }
  }
}

}  // namespace carom::adjoint_detail
