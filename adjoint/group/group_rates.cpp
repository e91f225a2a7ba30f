// SPDX-License-Identifier: MIT
#include "adjoint/group/group_rates.hpp"

#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

GroupRates::GroupRates(const GroupScene& scene, const std::vector<GroupContact>& contacts, const GroupInputs& inputs, const std::vector<State>& states,
                       double t, std::vector<Vec3> slip)
    : scene_(scene), contacts_(contacts), inputs_(inputs), states_(states), slip_(std::move(slip)),
      now_(instantOf(scene, contacts, states, t, slip_)) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContact& c = contacts[k];
    flows_.push_back(SupportFlow::of(scene.with[k], scene.time, t));
    const Vec3 along = now_.contacts[k].slipVelocity();
    if (follows(k) && along.norm() > 0) now_.contacts[k].slip = along.normalized();
    const Pose a = poseOf(scene, contacts, states, k, true, t), b = poseOf(scene, contacts, states, k, false, t);
    jacobians_.push_back(scene.geometry->jacobian(c.a, c.b, c.features, a, b));
    PairTangent way;
    for (const bool of_a : {true, false}) {
      const int member = of_a ? c.member_a : c.member_b;
      auto part = way.pose.segment<6>(of_a ? 0 : 6);
      if (member >= 0) {
        const MemberInstant& m = now_.members[static_cast<std::size_t>(member)];
        part << m.v, m.w;
      } else {
        const SupportInstant<double> support = scene.with[k].at(t);
        part << support.v, support.w;
      }
    }
    jacobian_rates_.push_back(scene.geometry->jacobianRates(c.a, c.b, c.features, a, b, std::span(&way, 1)).front());
  }
}

GroupLanes GroupRates::lanes(int first, int count) const {
  GroupLanes out;
  out.members.resize(scene_.members.size()), out.contacts.resize(contacts_.size());
  for (std::size_t m = 0; m < out.members.size(); ++m) placeMember(m, first, count, out.members[m]);
  for (std::size_t k = 0; k < contacts_.size(); ++k) placeContact(k, first, count, out, out.contacts[k]);
  return out;
}

void GroupRates::placeMember(std::size_t m, int first, int count, GroupLanes::Member& out) const {
  const BodyModel& model = *scene_.members[m].model;
  const State& state = states_[m];
  const GroupInputs::Member& of = inputs_.members[m];
  const Mat3 R = state.q.toRotationMatrix();
  M3<Number> turned = R.cast<Number>(), inverse = Mat3(model.inverse_inertia.asDiagonal()).cast<Number>();
  out.x = state.x.cast<Number>(), out.v = state.v.cast<Number>(), out.L = state.L.cast<Number>();
  out.gravity = scene_.members[m].gravity.cast<Number>();
  out.inverse_mass = model.inverse_mass;
  const auto in = [](int column, int begin, int size) { return column >= begin && column < begin + size; };
  for (int lane = 0; lane < count; ++lane) {
    const auto at = static_cast<std::size_t>(lane);
    const int column = first + lane, own = column - 12 * static_cast<int>(m);
    if (in(own, 0, 3)) out.x[own].rate[at] = 1;
    if (in(own, 3, 3)) setRates(turned, Mat3(skew(Vec3(Vec3::Unit(own - 3))) * R), at);
    if (in(own, 6, 3)) out.v[own - 6].rate[at] = 1;
    if (in(own, 9, 3)) out.L[own - 9].rate[at] = 1;
    if (in(column, inputs_.gravity, 3)) out.gravity[column - inputs_.gravity].rate[at] = model.gravity_factor;
    if (column == of.mass) out.inverse_mass.rate[at] = -model.inverse_mass * model.inverse_mass;
    if (in(column, of.inertia(), 6)) {
      BodyModelDerivative by;
      (column < of.products() ? by.inertia[column - of.inertia()] : by.products[column - of.products()]) = 1;
      const Mat3 D = model.inverse_inertia.asDiagonal();
      setRates(inverse, Mat3(-D * by.inertiaTensor() * D), at);
    }
  }
  out.A = turned * inverse * turned.transpose();
  out.w = out.A * out.L;
  out.R = model.has_offset ? M3<Number>(turned * model.R_BG.cast<Number>()) : turned;
}

// How the pose of a side of a contact goes with a column.
std::optional<GroupRates::Vec6> GroupRates::poseBy(std::size_t k, bool of_a, int column) const {
  const int member = of_a ? contacts_[k].member_a : contacts_[k].member_b;
  if (member < 0) return inputs_.partners[static_cast<std::size_t>(inputs_.partner_of[k])].poseBy(column, flows_[k]);
  const int own = column - 12 * member;
  if (own < 0 || own >= 6) return std::nullopt;
  return Vec6::Unit(own);
}

// Which dimension of it a column is; -1: none.
int GroupRates::sizeOf(std::size_t k, bool of_a, int column) const {
  const int member = of_a ? contacts_[k].member_a : contacts_[k].member_b;
  if (member >= 0) {
    const GroupInputs::Member& m = inputs_.members[static_cast<std::size_t>(member)];
    return m.hasSize(column) ? column - m.sizes : -1;
  }
  const SupportColumns& p = inputs_.partners[static_cast<std::size_t>(inputs_.partner_of[k])];
  return p.hasSize(column) ? column - p.sizes : -1;
}

// Of one side, whose body goes at v and w: what it makes of gap, normal and point, and of J q', where q' and J change. Second derivatives are
// symmetric, so that the change of J along a column is that of the column along the ways of both, but for turns: as a body turns by a, that of
// J q' is J' a + J (w x a).
void GroupRates::placeSide(std::size_t k, bool of_a, int first, int count, const V3<Number>& v, const V3<Number>& w, GroupLanes::Contact& out) const {
  const Eigen::Index side = of_a ? 0 : 6;
  const auto J = jacobians_[k].pose.middleCols<6>(side), bends = jacobian_rates_[k].pose.middleCols<6>(side);
  const auto &J_size = of_a ? jacobians_[k].size_a : jacobians_[k].size_b, &bends_size = of_a ? jacobian_rates_[k].size_a : jacobian_rates_[k].size_b;
  const Vec3 turning = valuesOf(w);
  for (int lane = 0; lane < count; ++lane) {
    const auto at = static_cast<std::size_t>(lane);
    Vec6 velocity;
    for (int i = 0; i < 3; ++i) velocity[i] = v[i].rate[at], velocity[3 + i] = w[i].rate[at];
    Eigen::Matrix<double, 7, 1> moved = Eigen::Matrix<double, 7, 1>::Zero(), bent = moved;
    if (!velocity.isZero(0)) bent += J * velocity;
    if (const auto by = poseBy(k, of_a, first + lane)) {
      moved += J * *by;
      bent += bends * *by + J.rightCols<3>() * turning.cross(Vec3(by->tail<3>()));
    }
    if (const int size = sizeOf(k, of_a, first + lane); size >= 0) moved += J_size.col(size), bent += bends_size.col(size);
    out.gap.rate[at] += moved[0];
    for (int i = 0; i < 3; ++i) {
      out.n[i].rate[at] += moved[1 + i], out.point[i].rate[at] += moved[4 + i];
      out.normal_rate[i].rate[at] += bent[1 + i], out.point_rate[i].rate[at] += bent[4 + i];
    }
  }
}

void GroupRates::placeContact(std::size_t k, int first, int count, const GroupLanes& of, GroupLanes::Contact& out) const {
  const GroupContact& held = contacts_[k];
  const GroupContactInstant& now = now_.contacts[k];
  out.n = now.n.cast<Number>(), out.point = now.point.cast<Number>();
  out.normal_rate = now.normal_rate.cast<Number>(), out.point_rate = now.point_rate.cast<Number>();
  out.gap = now.gap, out.friction = held.friction;
  if (const int lane = inputs_.friction + static_cast<int>(k) - first; lane >= 0 && lane < count) out.friction.rate[static_cast<std::size_t>(lane)] = 1;
  std::optional<SupportInstant<Number>> beside;
  if (inputs_.partner_of[k] >= 0) beside = support(k, first, count);
  for (const bool of_a : {true, false}) {
    const int member = of_a ? held.member_a : held.member_b;
    if (member >= 0) placeSide(k, of_a, first, count, of.members[static_cast<std::size_t>(member)].v, of.members[static_cast<std::size_t>(member)].w, out);
    else placeSide(k, of_a, first, count, beside->v, beside->w, out);
  }
  out.u.setZero(), out.driven_a.setZero(), out.driven_b.setZero();
  for (const bool of_a : {true, false}) {
    const int member = of_a ? held.member_a : held.member_b;
    V3<Number> material = V3<Number>::Zero();
    if (member >= 0) {
      material = of.members[static_cast<std::size_t>(member)].velocityAt(out.point);
    } else if (scene_.with[k].drives()) {
      material = beside->velocityAt(out.point, out.n);
      (of_a ? out.driven_a : out.driven_b) = beside->accelerationAt(out.point, out.n, out.point_rate, out.normal_rate);
    }
    if (of_a) out.u += material;
    else out.u -= material;
  }
  out.slip = now.slip.cast<Number>();
  if (follows(k)) {
    const V3<Number> along_face = out.u - out.n * out.n.dot(out.u);
    const Number speed = sqrt(along_face.squaredNorm());
    if (speed.value > 0) out.slip = along_face / speed;
  }
}

}  // namespace carom::adjoint_detail
