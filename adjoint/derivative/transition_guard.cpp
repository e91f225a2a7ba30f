// SPDX-License-Identifier: MIT
#include "adjoint/derivative/transition_guard.hpp"

#include <array>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/derivative/held_pass.hpp"
#include "adjoint/held/held_rates.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/support_polygon.hpp"

namespace carom::adjoint_detail {

Vec3 slipDirectionAtEnd(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const ContactPath& path =
      *motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)].path();
  const Vec3 of_body = slipDirectionAt<double>(path.form, path.inputs, path.slip_end);
  return p.body == event.contacts[0].a ? of_body : Vec3(-of_body);
}

namespace {

std::shared_ptr<const PathGuard> guardWith(std::shared_ptr<const HeldColumns> columns, const HeldRow& row) {
  auto made = std::make_shared<PathGuard>();
  made->by_state = asState(row.head<12>().transpose());
  Eigen::VectorXd others = row.transpose();
  others.head<12>().setZero();
  made->tangent = [columns, others](const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
    return others.dot(columns->tangent({}, dscene, dmodel));
  };
  made->pullback = [columns, others](double sigma, SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
    columns->pullback(sigma * others, scene_bar, model_bar);
  };
  return made;
}

// Where the force of the face comes to a side of the polygon of its contacts: with the contacts A and B at the ends of
// that side, the height h of the centre of mass above A, and the unit direction d of the slip there,
//   n . ((B - A) x (x + mu h d - A)).
HeldLanes::Number tippingRate(const HeldLanes& lanes) {
  using Number = HeldLanes::Number;
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
  HeldScene scene;
  scene.geometry = motion.geometry;
  scene.model = &(*motion.models)[static_cast<std::size_t>(p.body)];
  scene.body = p.body;
  scene.gravity = path.inputs.gravity;
  std::vector<HeldContact> contacts;
  std::vector<Vec3> slip;
  std::vector<const Contact*> own;
  for (const Contact& c : event.contacts)
    if (c.a == p.body || c.b == p.body) own.push_back(&c);
  for (const int k : sideThatTips(motion, event, p, path)) {
    const Contact& c = *own[static_cast<std::size_t>(k)];
    HeldContact held;
    held.is_first = c.a == p.body;
    held.with = held.is_first ? c.b : c.a;
    held.features = c.features, held.friction = path.inputs.friction, held.mode = HeldMode::slides;
    contacts.push_back(held);
    scene.with.push_back(poseBefore(motion, event, held.with));
    slip.push_back(Vec3::Zero());
  }
  const auto columns = std::make_shared<const HeldColumns>(motion, scene, contacts, p.before);
  HeldRates rates(scene, contacts, columns->inputs(), p.before, slip);
  HeldRow row(columns->inputs().count);
  rates.each([&](const HeldLanes& lanes, int first, int count) {
    const HeldLanes::Number value = tippingRate(lanes);
    for (int lane = 0; lane < count; ++lane) row[first + lane] = value.rate[static_cast<std::size_t>(lane)];
  });
  return guardWith(columns, row);
}

}  // namespace

std::shared_ptr<const PathGuard> pathGuardOf(const Motion& motion, const Event& event) {
  const Participant& p = event.participants[0];
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)];
  if (event.cause == TransitionCause::tips) return tippingGuard(motion, event, p, *arc.path());
  const HeldPath* path = heldPathOf(arc);
  if (!path) return nullptr;
  HeldGuard guard{event.cause, -1, event.border, {}};
  const Contact& first = event.contacts[0];
  for (std::size_t k = 0; k < path->contacts().size(); ++k) {
    const HeldContact& c = path->contacts()[k];
    if (c.features == first.features && c.with == (first.a == p.body ? first.b : first.a)) guard.contact = static_cast<int>(k);
  }
  const auto columns = std::make_shared<const HeldColumns>(motion, *path);
  return guardWith(columns, guardRow(*path, columns->inputs(), guard, event.time));
}

FeatureLimit borderOf(const Motion& motion, const Event& event) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion.geometry.get());
  if (event.cause != TransitionCause::leaves || !bodies)
    throw NotComputable("the derivative by the border of a feature is not known of this geometry");
  const Contact& c = event.contacts[0];
  return bodies->limits(c.a, c.b, c.features, poseBefore(motion, event, c.a),
                        poseBefore(motion, event, c.b))[static_cast<std::size_t>(event.border)];
}

}  // namespace carom::adjoint_detail
