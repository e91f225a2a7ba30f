// SPDX-License-Identifier: MIT
#include "adjoint/simulate/path_arc.hpp"

#include <algorithm>

#include "adjoint/contact/closed_path.hpp"
#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/impact/complementarity.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/simulate/normal_contacts.hpp"

namespace carom::adjoint_detail {

PathArc makeConstrainedArc(const Motion& motion, const ContactChoice& choice, double time, std::vector<ConstrainedGuard> guards) {
  const int body = choice.path->body;
  choice.path->start = time;
  auto path = std::make_shared<ConstrainedPath>(choice.scene, choice.modes.contacts, choice.modes.redundant, std::move(guards),
                                         choice.start, time, motion.duration, choice.stopped);
  PathArc made{Arc(motion.modelOf(body), motion.plan.bodies[asIndex(body)].tier, std::move(path), time, choice.start), {}, {}};
  for (const Contact* c : choice.contacts) made.held.push_back(*c);
  made.transition = constrainedTransition(made.arc, time);
  return made;
}

Arc rideArc(const Motion& motion, int body, const State& state, const Carrier& carrier, bool loose) {
  auto path = std::make_shared<RidePath>(carrier, loose);
  const State start = path->carried(*motion.modelOf(body), state, carrier.start);
  return Arc(motion.modelOf(body), motion.plan.bodies[asIndex(body)].tier, std::move(path), carrier.start, start);
}

PathTransition constrainedTransition(const Arc& arc, double start) {
  const TrajectoryEnd end = arc.trajectory().end();
  if (end.cause == TransitionCause::none) return {};
  return {end.time - start, end.cause, end.contact, end.limit};
}

PathArc makePathArc(const Motion& motion, const ContactChoice& choice, double time) {
  const int body = choice.path->body;
  if (choice.path->form == PathForm::held)
    return makeConstrainedArc(motion, choice, time, guardsOf(choice.scene, choice.modes.contacts, choice.start, time));
  const double left = motion.duration - time;
  choice.path->start = time;
  const PathTransition transition = firstTransition(motion, choice, left);
  choice.path->bounds =
      pathBounds(choice.path->form, choice.path->inputs, 0, std::min(transition.elapsed, left));
  PathArc made{Arc(motion.modelOf(body), motion.plan.bodies[asIndex(body)].tier, std::make_shared<ClosedPath>(*choice.path),
                   time, choice.start),
               {},
               transition};
  for (const Contact* c : choice.contacts) made.held.push_back(*c);
  return made;
}

void closeGaps(const Motion& motion, int body, State& state, std::vector<Contact>& closed) {
  const std::vector<const Contact*> contacts = pointersTo(closed);
  const NormalContacts along((*motion.models)[asIndex(body)], state, body, contacts);
  Eigen::VectorXd gaps(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) gaps[static_cast<Eigen::Index>(k)] = contacts[k]->at.gap;
  const Eigen::Matrix<double, 6, 1> move = along.moved * LeastNormSolve(along.mobility(), gaps).y;
  const Vec3 turn = move.tail<3>();
  state.x += move.head<3>();
  if (turn.norm() > 0) state.q = (expSO3(turn) * state.q).normalized();
  for (Contact& c : closed) {
    const auto pose = [&](int b) {
      return shapePose(motion, b, b == body ? state : motion.world_lines[asIndex(b)].arcs.back().startState());
    };
    c.at = motion.geometry->contact(c.a, c.b, c.features, pose(c.a), pose(c.b));
  }
}

}  // namespace carom::adjoint_detail
