// SPDX-License-Identifier: MIT
// A body held by where it touches at an impact.
#include <algorithm>
#include <cmath>

#include "editing/problem/rows/contact_place.hpp"
#include "editing/session/session_state.hpp"

namespace carom {
using namespace editing_detail;

namespace {

/// A surface is where it is drawn to within this share of the radius of its body: 32 sides of a circle are off by
/// 0.5 % of its radius, along an axis that is at most 55 degrees from the normal by 0.9 %.
constexpr double kDrawn = 0.01;
/// The contact of a body that is much smaller is looked for no nearer than this share of its own radius.
constexpr double kOwn = 0.02;

double shareOfRadius(double share, const Body& body) {
  const double radius = kindOf(body.shape).boundingRadius(body.shape);
  return std::isfinite(radius) ? share * radius : 0;  // a plane is where it is drawn
}

}  // namespace

double editing_detail::sheetOf(const Scene& scene, const SessionGesture& record) {
  const auto named = [&](const std::string& name) -> const Body& {
    return scene.bodies[static_cast<std::size_t>(bodyIndex(scene, name))];
  };
  const double own = shareOfRadius(kOwn, named(record.body));
  return record.at.with.empty() ? own : own + shareOfRadius(kDrawn, named(record.at.with));
}

bool editing_detail::isOnSheet(const Grip& grip) { return grip.components.size() == 2; }

Target editing_detail::contactTarget(const Vec3& place, const Grip& grip, double sheet) {
  Target target{"contact", constrainedPlace(place, grip)};
  if (!(sheet > 0) || !isOnSheet(grip)) return target;
  target.min = target.max = {any, any, any};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!target.value[k].isFree()) continue;
    target.min[k] = place[static_cast<Eigen::Index>(k)] - sheet;
    target.max[k] = place[static_cast<Eigen::Index>(k)] + sheet;
  }
  return target;
}

void editing_detail::recentre(Target& target, const Vec3& place) {
  if (target.min.empty() || target.max.empty()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const double half = 0.5 * (target.max[k] - target.min[k]), at = place[static_cast<Eigen::Index>(k)];
    if (std::isfinite(half)) target.min[k] = at - half, target.max[k] = at + half;
  }
}

Vec3 editing_detail::placeConstrained(const Motion& motion, const SessionGesture& record, const std::string& where) {
  const BodyState state = stateAtMoment(motion, record.body, record.at, where);
  const Grip& grip = record.grip;
  if (!grip.contact) return state.position + state.orientation * grip.body_point.value_or(Vec3::Zero());
  const std::string& other = record.at.with;
  const int body = bodyIndex(*motion.scene, record.body), with = other.empty() ? -1 : bodyIndex(*motion.scene, other);
  return contactPlace(motion, *motion.findImpact(body, record.at.impact, with), body, with);
}

/// How far a place is from the target of the drag, m, in what is held; on which sheet of a surface counts as well.
Vec3 editing_detail::awayFrom(const SessionDrag& drag, const Vec3& place) {
  Vec3 away = place - drag.place;
  const Grip& grip = drag.held;
  if (!grip.place) return Vec3::Zero();
  for (int k = 0; k < 3 && !grip.components.empty(); ++k) {
    if (std::find(grip.components.begin(), grip.components.end(), std::string(1, "xyz"[k])) != grip.components.end())
      continue;
    const double beyond = std::max(0.0, std::abs(away[k]) - drag.sheet);
    away[k] = grip.contact && drag.sheet > 0 && isOnSheet(grip) ? std::copysign(beyond, away[k]) : 0;
  }
  return away;
}

}  // namespace carom
