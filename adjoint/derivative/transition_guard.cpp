// SPDX-License-Identifier: MIT
#include "adjoint/derivative/transition_guard.hpp"

#include <array>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/constrained/constrained_linearization.hpp"
#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/flat_disc.hpp"
#include "adjoint/simulate/support_polygon.hpp"

namespace carom::adjoint_detail {

Vec3 slipDirectionAtEnd(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const ContactPath& path =
      *motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)].closedForm();
  const Vec3 of_body = slipDirectionAt<double>(path.form, path.inputs, path.slip_end);
  return p.body == event.contacts[0].a ? of_body : Vec3(-of_body);
}

namespace {

// Where the force of the face comes to a side of the polygon of its contacts: with the contacts A and B at the ends of
// that side, the height h of the centre of mass above A, and the unit direction d of the slip there,
//   n . ((B - A) x (x + mu h d - A)).
ConstrainedLanes::Number tippingRate(const ConstrainedLanes& lanes) {
  using Number = ConstrainedLanes::Number;
  const ContactInstant<Number>&a = lanes.contacts[0], &b = lanes.contacts[1];
  const Number height = -a.n.dot(a.r);
  const V3<Number> side = b.r - a.r, force = a.slip * (a.friction * height) - a.r;
  return a.n.dot(side.cross(force));
}

// The side that the force comes to, of the contacts of the event.
std::array<int, 2> sideThatTips(const Motion& motion, const Event& event, const Participant& p, const ContactPath& path) {
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)];
  std::vector<const Contact*> contacts;
  for (const Contact& c : event.contacts)
    if (c.a == p.body || c.b == p.body) contacts.push_back(&c);
  const SupportPolygon support(contacts, path.inputs.normal);
  const Vec3 slip = slipDirectionAt<double>(path.form, path.inputs, event.time - arc.start());
  const Vec3 force = p.before.x + path.inputs.reach * path.inputs.friction * slip;
  double least = kInfinity;
  std::array<int, 2> ends = {-1, -1};
  for (const SupportPolygon::Side& side : support.sides()) {
    const double room = side.inward.dot(force - support.pointOf(side.from));
    if (!(std::abs(room) < least)) continue;
    least = std::abs(room);
    ends = {side.from, side.to};
  }
  if (ends[0] < 0) throw NotComputable("the side over which a body begins to tip is not known");
  return ends;
}

std::shared_ptr<const PathGuard> tippingGuard(const Motion& motion, const Event& event, const Participant& p,
                                              const ContactPath& path) {
  ConstrainedScene scene;
  scene.geometry = motion.geometry;
  scene.model = motion.modelOf(p.body);
  scene.body = p.body;
  scene.gravity = path.inputs.gravity;
  std::vector<PersistentContact> contacts;
  std::vector<Vec3> slip;
  std::vector<const Contact*> own;
  for (const Contact& c : event.contacts)
    if (c.a == p.body || c.b == p.body) own.push_back(&c);
  if (FlatDisc::of(motion, own)) throw NotComputable("the derivative of a body that begins to tip over a round rim is not known");
  for (const int k : sideThatTips(motion, event, p, path)) {
    const Contact& c = *own[static_cast<std::size_t>(k)];
    PersistentContact held;
    held.is_first = c.a == p.body;
    held.with = held.is_first ? c.b : c.a;
    held.features = c.features, held.friction = path.inputs.friction, held.mode = ContactMode::slides;
    contacts.push_back(held);
    scene.with.push_back({.pose = poseBefore(motion, event, held.with)});
    slip.push_back(Vec3::Zero());
  }
  const auto columns = std::make_shared<const ConstrainedColumns>(motion, scene, contacts, p.before);
  ConstrainedRates rates(scene, contacts, columns->inputs(), p.before, 0, slip);
  ConstrainedRow row(columns->inputs().count);
  rates.each([&](const ConstrainedLanes& lanes, int first, int count) {
    const ConstrainedLanes::Number value = tippingRate(lanes);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = value.rate[static_cast<std::size_t>(lane)];
  });
  return guardWith(columns, row, Eigen::VectorXd::Zero(row.size()));
}

}  // namespace

std::shared_ptr<const PathGuard> pathGuardOf(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)];
  if (event.cause == TransitionCause::tips) return tippingGuard(motion, event, p, *arc.closedForm());
  return arc.trajectory().guardOfEnd(motion, event);
}

FeatureLimit borderOf(const Motion& motion, const Event& event) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion.geometry.get());
  if (event.cause != TransitionCause::leaves || !bodies)
    throw NotComputable("this geometry has no derivative of the boundary of a feature");
  const Contact& c = event.contacts[0];
  return bodies->limits(c.a, c.b, c.features, poseBefore(motion, event, c.a),
                        poseBefore(motion, event, c.b))[static_cast<std::size_t>(event.border)];
}

}  // namespace carom::adjoint_detail
