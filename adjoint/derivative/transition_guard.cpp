// SPDX-License-Identifier: MIT
#include "adjoint/derivative/transition_guard.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/derivative/held_pass.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {

Vec3 slipDirectionAtEnd(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const ContactPath& path =
      *motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)].path();
  const Vec3 of_body = slipDirectionAt<double>(path.form, path.inputs, path.slip_end);
  return p.body == event.contacts[0].a ? of_body : Vec3(-of_body);
}

std::shared_ptr<const PathGuard> pathGuardOf(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)];
  const HeldPath* path = heldPathOf(arc);
  if (!path) return nullptr;
  HeldGuard guard{event.cause, -1, event.border, {}};
  const Contact& first = event.contacts[0];
  for (std::size_t k = 0; k < path->contacts().size(); ++k) {
    const HeldContact& c = path->contacts()[k];
    if (c.features == first.features && c.with == (first.a == p.body ? first.b : first.a)) guard.contact = static_cast<int>(k);
  }
  const auto columns = std::make_shared<const HeldColumns>(motion, *path);
  const Eigen::VectorXd row = guardRow(*path, columns->inputs(), guard, event.time).transpose();
  auto made = std::make_shared<PathGuard>();
  made->by_state = asState(row.head<12>());
  Eigen::VectorXd others = row;
  others.head<12>().setZero();
  made->tangent = [columns, others](const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
    return others.dot(columns->tangent({}, dscene, dmodel));
  };
  made->pullback = [columns, others](double sigma, SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
    columns->pullback(sigma * others, scene_bar, model_bar);
  };
  return made;
}

FeatureLimit borderOf(const Motion& motion, const Event& event) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion.geometry.get());
  if (event.cause != TransitionCause::leaves || !bodies)
    throw NotComputable("the derivative by when a body begins to tip is not modelled yet");
  const Contact& c = event.contacts[0];
  return bodies->limits(c.a, c.b, c.features, poseBefore(motion, event, c.a),
                        poseBefore(motion, event, c.b))[static_cast<std::size_t>(event.border)];
}

}  // namespace carom::adjoint_detail
