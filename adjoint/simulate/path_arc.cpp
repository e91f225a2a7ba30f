// SPDX-License-Identifier: MIT
#include "adjoint/simulate/path_arc.hpp"

#include <algorithm>

#include "adjoint/impact/complementarity.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
PathArc makePathArc(const Motion& motion, const ContactChoice& choice, double time) {
  const int body = choice.path->body;
  const double left = motion.duration - time;
  choice.path->start = time;
  const PathTransition transition = firstTransition(motion, choice, left);
  choice.path->bounds =
      pathBounds(choice.path->form, choice.path->inputs, 0, std::min(transition.elapsed, left));
  PathArc made{Arc((*motion.models)[asIndex(body)], motion.plan.bodies[asIndex(body)].tier, choice.path, time, choice.start),
               {},
               transition};
  for (const Contact* c : choice.contacts) made.held.push_back(*c);
  return made;
}

void closeGaps(const Motion& motion, int body, State& state, std::vector<Contact>& closed) {
  const BodyModel& model = (*motion.models)[asIndex(body)];
  const Mat3 A = model.mobilityWorld(state.q.toRotationMatrix());
  const auto n = static_cast<Eigen::Index>(closed.size());
  Eigen::MatrixXd K(n, n);
  Eigen::VectorXd gaps(n);
  const auto signOf = [&](const Contact& c) { return c.a == body ? 1.0 : -1.0; };
  const auto lever = [&](const Contact& c) { return Vec3((c.at.point - state.x).cross(signOf(c) * c.at.normal)); };
  for (Eigen::Index k = 0; k < n; ++k) {
    const Contact& c = closed[static_cast<std::size_t>(k)];
    gaps[k] = c.at.gap;
    for (Eigen::Index l = 0; l < n; ++l) {
      const Contact& d = closed[static_cast<std::size_t>(l)];
      K(k, l) = model.inverse_mass * signOf(c) * signOf(d) * c.at.normal.dot(d.at.normal) + lever(c).dot(A * lever(d));
    }
  }
  const LeastNormSolve shares(K, gaps);
  Vec3 moved = Vec3::Zero(), turned = Vec3::Zero();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Contact& c = closed[static_cast<std::size_t>(k)];
    moved += shares.y[k] * model.inverse_mass * signOf(c) * c.at.normal;
    turned += shares.y[k] * (A * lever(c));
  }
  state.x += moved;
  if (turned.norm() > 0)
    state.q = (expSO3(turned) * state.q).normalized();
  for (Contact& c : closed) {
    const auto pose = [&](int b) {
      const State& s = b == body ? state : motion.world_lines[asIndex(b)].arcs.back().startState();
      return Pose{s.x, (*motion.models)[asIndex(b)].shapeToWorld(s.q.toRotationMatrix())};
    };
    c.at = motion.geometry->contact(c.a, c.b, c.features, pose(c.a), pose(c.b));
  }
}

}  // namespace carom::adjoint_detail
