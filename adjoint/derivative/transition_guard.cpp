// SPDX-License-Identifier: MIT
#include "adjoint/derivative/transition_guard.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {

Vec3 slipDirectionAtEnd(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const ContactPath& path =
      *motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)].path();
  const Vec3 of_body = slipDirectionAt<double>(path.form, path.inputs, path.slip_end);
  return p.body == event.contacts[0].a ? of_body : Vec3(-of_body);
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
