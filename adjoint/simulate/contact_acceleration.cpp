// SPDX-License-Identifier: MIT
#include "adjoint/simulate/contact_acceleration.hpp"

#include <span>

namespace carom::adjoint_detail {

FreeAcceleration freeAcceleration(const BodyModel& model, const State& state, const Vec3& gravity) {
  const Mat3 A = model.inverseInertiaWorld(state.q.toRotationMatrix());
  return {model.gravity_factor * gravity, -(A * (A * state.L).cross(state.L))};
}

double gapAcceleration(const ContactGeometry& geometry, const BodyModel& model_a, const BodyModel& model_b,
                       const Contact& contact, const State& a, const State& b, const FreeAcceleration* accelerates_a,
                       const FreeAcceleration* accelerates_b) {
  Eigen::Matrix<double, 12, 1> velocity = Eigen::Matrix<double, 12, 1>::Zero(), acceleration = velocity;
  Pose A, B;
  const auto place = [&](const BodyModel& model, const State& s, const FreeAcceleration* accelerates, Eigen::Index at) {
    const Mat3 R = s.q.toRotationMatrix();
    if (accelerates) {
      velocity.segment<6>(at) << s.v, model.inverseInertiaWorld(R) * s.L;
      acceleration.segment<6>(at) << accelerates->v, accelerates->w;
    }
    return Pose{s.x, model.shapeToWorld(R)};
  };
  A = place(model_a, a, accelerates_a, 0);
  B = place(model_b, b, accelerates_b, 6);
  const ContactJacobian J = geometry.jacobian(contact.a, contact.b, contact.features, A, B);
  double alpha = J.pose.row(0).dot(acceleration);
  if (velocity.isZero(0)) return alpha;
  PairTangent along;
  along.pose = velocity;
  along.size_a = Eigen::VectorXd::Zero(J.size_a.cols());
  along.size_b = Eigen::VectorXd::Zero(J.size_b.cols());
  const auto rates =
      geometry.jacobianRates(contact.a, contact.b, contact.features, A, B, std::span<const PairTangent>(&along, 1));
  return alpha + rates[0].pose.row(0).dot(velocity);
}

std::optional<double> settlesAt(const Motion& motion, const Event& event, const std::vector<State>& after) {
  const Contact& c = event.contacts[0];
  if (event.contacts.size() > 1 || !c.captured || !(c.approach < 0)) return std::nullopt;
  const Scene& scene = *motion.scene;
  const double e = combine(materialOf(scene, scene.bodies[asIndex(c.a)]), materialOf(scene, scene.bodies[asIndex(c.b)])).elasticity;
  std::vector<FreeAcceleration> accelerations(2);
  const auto accelerate = [&](int body, std::size_t slot) -> const FreeAcceleration* {
    const Participant* p = event.find(body);
    if (!p) return nullptr;
    accelerations[slot] = freeAcceleration((*motion.models)[asIndex(body)],
                                           after[static_cast<std::size_t>(p - event.participants.data())], scene.gravity);
    return &accelerations[slot];
  };
  const auto stateOf = [&](int body) -> const State& {
    const Participant* p = event.find(body);
    return p ? after[static_cast<std::size_t>(p - event.participants.data())]
             : motion.world_lines[asIndex(body)].arcs.back().startState();
  };
  const FreeAcceleration *a = accelerate(c.a, 0), *b = accelerate(c.b, 1);
  const double alpha = gapAcceleration(*motion.geometry, (*motion.models)[asIndex(c.a)], (*motion.models)[asIndex(c.b)], c,
                                       stateOf(c.a), stateOf(c.b), a, b);
  if (!(alpha < 0 && e < 1)) return std::nullopt;
  return event.time + 2 * e * c.approach / (alpha * (1 - e));
}

}  // namespace carom::adjoint_detail
