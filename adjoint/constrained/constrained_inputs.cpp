// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_inputs.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

SupportFlow SupportFlow::of(const Support& support, double start, double t) {
  SupportFlow flow;
  flow.now = t;
  if (!support.moves()) return flow;
  flow.moves = true, flow.elapsed = t - start;
  const Kinematics k = support.arc->kinematicsAt(t);
  flow.turned = k.R * support.pose.R.transpose();
  flow.by_spin = flow.elapsed * leftJacobian(Vec3(flow.elapsed * k.w));
  return flow;
}

Eigen::Matrix<double, 6, 1> SupportFlow::poseBy(int column) const {
  Eigen::Matrix<double, 6, 1> by = Eigen::Matrix<double, 6, 1>::Zero();
  if (column < 3) by[column] = 1;
  else if (column < 6) by.tail<3>() = turned.col(column - 3);
  else if (column < 9) by[column - 6] = elapsed;
  else by.tail<3>() = by_spin.col(column - 9);
  return by;
}

// It comes there uniformly.
StateDerivative SupportStart::tangent(const BodyDerivative& dbody) const {
  StateDerivative d = startTangent(body_, model_, dbody, modelTangent(body_, model_, dbody));
  d.x += flow_.elapsed * d.v;
  d.theta = flow_.turned * d.theta + flow_.by_spin * d.L;
  return d;
}

void SupportStart::pullback(StateDerivative bar, BodyDerivative& body_bar) const {
  bar.v += flow_.elapsed * bar.x;
  bar.L += flow_.by_spin.transpose() * bar.theta;
  bar.theta = flow_.turned.transpose() * bar.theta;
  BodyModelDerivative model_bar;
  startPullback(body_, model_, bar, body_bar, model_bar);
  modelPullback(body_, model_, model_bar, body_bar);
}

SupportStart fromSceneStart(const Motion& motion, int body, const Support& support, double t) {
  Support from_start = support;
  from_start.pose = from_start.poseAt(0);
  const auto b = static_cast<std::size_t>(body);
  return {motion.scene->bodies[b], (*motion.models)[b], SupportFlow::of(from_start, 0, t)};
}

void shiftSupport(const Support& support, const SupportColumns& columns, double t, Eigen::VectorXd& shift) {
  if (!support.moves()) return;
  if (support.isGiven())
    throw NotComputable("the derivative of a time at which contact changes on a support with a given trajectory is not known");
  const Kinematics now = support.arc->kinematicsAt(t);
  shift.segment<6>(columns.pose) << now.v, now.w;
}

Eigen::VectorXd timeShift(const ConstrainedScene& scene, const ConstrainedInputs& inputs, double t) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(inputs.count);
  for (std::size_t k = 0; k < scene.with.size(); ++k) shiftSupport(scene.with[k], inputs.partners[inputs.partner_of[k]], t, shift);
  return shift;
}

ConstrainedInputs::ConstrainedInputs(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& start) {
  const Pose own{start.x, scene.model->shapeToWorld(start.q.toRotationMatrix())};
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PersistentContact& c = contacts[k];
    const ContactJacobian J = scene.jacobian(c, k, own, scene.time);
    size_count = static_cast<int>((c.is_first ? J.size_a : J.size_b).cols());
    std::size_t p = 0;
    while (p < partners.size() && partners[p].body != c.with) ++p;
    if (p == partners.size()) {
      partners.push_back({c.with, 0, 0, static_cast<int>((c.is_first ? J.size_b : J.size_a).cols())});
      if (scene.with[k].moves()) partners.back().velocity = 0;
      if (scene.with[k].has_belt) partners.back().surface = 0;
    }
    partner_of.push_back(p);
  }
  count = kSizes + size_count;
  for (Partner& p : partners) count = p.place(count);
  friction = count;
  count += static_cast<int>(contacts.size());
}

std::optional<Eigen::Matrix<double, 7, 1>> ConstrainedInputs::columnOf(const ContactJacobian& J, const PersistentContact& contact,
                                                                std::size_t k, int column, const SupportFlow& flow) const {
  const Partner& p = partners[partner_of[k]];
  const int own = contact.is_first ? 0 : 6, other = 6 - own;
  const auto &own_sizes = contact.is_first ? J.size_a : J.size_b, &other_sizes = contact.is_first ? J.size_b : J.size_a;
  if (column < 6) return J.pose.col(own + column);
  if (column >= kSizes && column < kSizes + size_count) return own_sizes.col(column - kSizes);
  if (!flow.moves && column >= p.pose && column < p.pose + 6) return J.pose.col(other + column - p.pose);
  if (const auto by = p.poseBy(column, flow)) return J.pose.middleCols<6>(other) * *by;
  if (p.hasSize(column)) return other_sizes.col(column - p.sizes);
  return std::nullopt;
}

}  // namespace carom::adjoint_detail
