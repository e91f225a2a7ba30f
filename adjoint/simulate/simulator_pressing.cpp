// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/motion/body_geometry.h"
#include "adjoint/simulate/contact_acceleration.hpp"
#include "adjoint/simulate/simulator.hpp"

// Contacts after which a motion cannot go on, though velocities and forces along normals do not tell.

namespace carom::adjoint_detail {
namespace {

// Accelerations towards each other above this share of the largest one press.
constexpr double kPressing = 1e-9;
// What parts at such a share of the speed of the lowest bounce does so without speed.
constexpr double kNoSpeed = 1e-4;
// Contacts nearer than this share of the size of positions are at one point.
constexpr double kOnePoint = 1e-9;
// The sine by which normals differ, or a way along one face goes below another one.
constexpr double kDiffers = 1e-6;

}  // namespace

// What friction slows down may press on what touches it, which forces along the normals do not tell: contacts of the draft that
// close although none holds their bodies. In groups those count, too, that forces on a body by itself would let part, where they
// do so without speed.
std::vector<Contact*> Simulator::closingContacts() {
  const double time = draft_.event.time;
  double pull = 0;
  const auto sideOf = [&](int body) -> ContactSide {
    const State& s = stateAfter(body);
    Arc& arc = pathOf(body);
    arc.extendTo(time);
    const StateDerivative rate = arc.rateAt(time, s);
    const Mat3 A = (*motion_.models)[index(body)].inverseInertiaWorld(s.q.toRotationMatrix());
    pull = std::max(pull, rate.v.norm());
    return {s, FreeAcceleration{rate.v, A * (rate.L - (A * s.L).cross(s.L))}};
  };
  const auto rubs = [&](int body) { return !pathOf(body).isFlight() && pathOf(body).kind() != ArcKind::rest; };
  const auto speedOf = [&](int body, const Contact& c) {
    const Kinematics now = arcOf(body).kinematicsOf(stateAfter(body));
    return c.at.normal.dot(now.v + now.w.cross(c.at.point - now.x));
  };
  const double no_speed = kNoSpeed * std::sqrt(2 * motion_.lowest_bounce * scene_.gravity.norm());
  std::vector<Contact*> closing;
  for (Contact& c : draft_.event.contacts) {
    if (!joinsMoved(c) || !(rubs(c.a) || rubs(c.b)) || !draft_.beyond.empty()) continue;
    if (!c.lasts && !(groups_ && !c.held && std::abs(speedOf(c.a, c) - speedOf(c.b, c)) <= no_speed)) continue;
    const ContactSide a = sideOf(c.a), b = sideOf(c.b);
    if (gapAcceleration(motion_, c, a, b) < -kPressing * std::max(pull, scene_.gravity.norm())) closing.push_back(&c);
  }
  return closing;
}

// Whether a body is on edges that lie along each other, and would move. One that rests there would not stay, were it a little aside.
bool Simulator::wouldMoveOnEdges(ContactChoice& choice) {
  if (!lieAlongEdges(choice.contacts, draft_.event.contacts) && !lieAlongEdges(choice.contacts, draft_.touching)) return false;
  if (choice.path->form == PathForm::rest) {
    choice.path->loose = true;
    return false;
  }
  endBeyond(*choice.contacts.front(), "it would move on edges that lie along each other, which have no one normal");
  return true;
}

// Whether edges lie along each other at some of these contacts, and of others. Each such contact is one with a face at the border
// of it: where that face goes on, it goes below the face of the other contact at the same point (docs/collision.md).
bool Simulator::lieAlongEdges(const std::vector<const Contact*>& contacts, const std::vector<Contact>& others) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
  if (!bodies) return false;
  const double time = draft_.event.time;
  const auto goesBelow = [&](const Contact& c, const Contact& other) {
    const Pose A = poseAt(c.a, time), B = poseAt(c.b, time);
    const double near = kOnePoint * std::max(1.0, c.at.point.norm());
    return std::ranges::any_of(bodies->limits(c.a, c.b, c.features, A, B), [&](const FeatureLimit& limit) {
      const Pose& pose = limit.body == c.a ? A : B;
      const bool at_border = std::abs(limit.point_weight.dot(pose.R.transpose() * (c.at.point - pose.x) - limit.border)) <= near;
      const double on = other.at.normal.dot(pose.R * limit.point_weight);
      return at_border && (limit.body == c.a ? -on : on) < -kDiffers;
    });
  };
  for (const Contact* c : contacts)
    for (const Contact& other : others) {
      if (c->a != other.a || c->b != other.b || (c->at.normal - other.at.normal).norm() <= kDiffers) continue;
      if ((c->at.point - other.at.point).norm() > kOnePoint * std::max(1.0, c->at.point.norm())) continue;
      if (goesBelow(*c, other)) return true;
    }
  return false;
}

}  // namespace carom::adjoint_detail
