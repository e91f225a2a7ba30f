// SPDX-License-Identifier: MIT
#include "adjoint/constrained/carrier.hpp"

#include <algorithm>

#include "adjoint/motion/guard.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

// Velocities of carriers that differ by less than this share are one.
constexpr double kSameVelocity = 1e-12;
// A place that goes with a body but for this share does; a spin of a surface about the normal but for it is.
constexpr double kGoesAlong = 1e-12;

const Body& bodyOf(const Motion& motion, int body) { return motion.scene->bodies[static_cast<std::size_t>(body)]; }

Vec3 alongFaceOf(const Vec3& n, const Vec3& v) { return v - n * n.dot(v); }

// Whether a contact lies on the face of a support, whatever the body on it does, and its place goes with that body.
bool liesOnFaceOf(const Motion& motion, const Contact& c, int support, double time) {
  const auto pose = [&](int body) {
    const Arc& arc = motion.world_lines[static_cast<std::size_t>(body)].arcs.back();
    return shapePose(motion, body, arc.stateAt(time));
  };
  const ContactJacobian J = motion.geometry->jacobian(c.a, c.b, c.features, pose(c.a), pose(c.b));
  const Eigen::Index own = support == c.a ? 6 : 0;
  const Mat3 across = Mat3::Identity() - c.at.normal * c.at.normal.transpose();
  return J.pose.block<3, 6>(1, own).isZero(0) && (across * J.pose.block<3, 3>(4, own) - across).norm() <= kGoesAlong;
}

// A body with the face that a contact is on.
Carrier::Part partAt(const Motion& motion, const Contact& c, int body, double time) {
  Carrier::Part part{body, supportOf(motion, body, time), {}, 0};
  part.normal = part.support.pose.R.transpose() * (c.a == body ? Vec3(-c.at.normal) : c.at.normal);
  part.height = part.normalInWorld().dot(c.at.point - part.origin());
  return part;
}

// Whether its material goes uniformly, or turns about one axis.
bool isUniform(const Carrier::Part& part, double time) {
  const Support& s = part.support;
  if (s.isGiven()) return false;
  if (!s.has_belt) return true;
  if (s.moves() && !s.at(time).w.isZero(0)) return false;
  return part.normal.cross(s.surface_angular_velocity).norm() <= kGoesAlong * s.surface_angular_velocity.norm();
}

}  // namespace

Vec3 Carrier::Part::surfaceVelocity() const {
  if (!support.has_belt) return Vec3::Zero();
  return alongFaceOf(normalInWorld(), Vec3(support.pose.R * support.surface_velocity));
}

Vec3 Carrier::Part::surfaceSpin() const {
  if (!support.has_belt) return Vec3::Zero();
  return normalInWorld() * normal.dot(support.surface_angular_velocity);
}

Carrier::Instant Carrier::at(double t) const {
  const Part& part = parts.front();
  Instant now;
  const double elapsed = t - start;
  Vec3 velocity = Vec3::Zero();
  if (part.support.moves()) {
    const Kinematics k = part.support.arc->kinematicsAt(t);
    now.x = k.x, now.moved = elapsed * k.v, now.v = velocity = k.v, now.w = k.w;
    now.turned = k.R * part.support.pose.R.transpose();
  }
  if (!part.support.has_belt) return now;
  const Vec3 u = part.surfaceVelocity(), w = part.surfaceSpin();
  now.w = w;
  now.turned = w.isZero(0) ? Mat3(Mat3::Identity()) : expSO3(elapsed * w).toRotationMatrix();
  now.moved = elapsed * (velocity + leftJacobian(Vec3(elapsed * w)) * u);
  now.x = part.origin() + now.moved;
  now.v = velocity + now.turned * u;
  now.a = w.cross(Vec3(now.turned * u));
  return now;
}

Carrier Carrier::from(const Motion& motion, double t) const {
  Carrier same{t, parts};
  for (Part& part : same.parts) part.support = supportOf(motion, part.body, t);
  return same;
}

bool Carrier::has(int body) const { return std::ranges::find(parts, body, &Part::body) != parts.end(); }

bool Carrier::isBelt() const {
  return std::ranges::any_of(parts, [](const Part& part) { return part.support.has_belt; });
}

std::string namesOf(const Motion& motion, const Carrier& carrier) {
  std::string names;
  for (const Carrier::Part& part : carrier.parts) names += (names.empty() ? "'" : " and '") + bodyOf(motion, part.body).name + "'";
  return names;
}

Carried carriedBy(const Motion& motion, const std::vector<const Contact*>& outer, double time) {
  Carried carried;
  bool stands = false;
  for (const Contact* c : outer) {
    const int body = bodyOf(motion, c->a).immovable() ? c->a : c->b;
    if (!drivesContacts(motion, body)) {
      stands = true;
      continue;
    }
    const Carrier here{time, {partAt(motion, *c, body, time)}};
    const Carrier::Part& part = here.parts.front();
    if (!isUniform(part, time)) return {false, std::nullopt, {}};
    if (part.support.has_belt && !liesOnFaceOf(motion, *c, body, time)) {
      carried.passing.push_back(c);
      continue;
    }
    if (!carried.by) {
      carried.by = here;
      continue;
    }
    const bool known = carried.by->has(body);
    if (known && !part.support.has_belt) continue;
    const Carrier::Instant one = carried.by->at(time), other = here.at(time);
    const double size = std::max(one.v.norm(), one.w.norm() * (c->at.point - one.x).norm());
    const bool same = (one.w - other.w).norm() <= kSameVelocity * one.w.norm() && (known || one.w.isZero(0)) &&
                      (one.velocityAt(c->at.point) - other.velocityAt(c->at.point)).norm() <= kSameVelocity * size;
    if (!same) return {false, std::nullopt, {}};
    if (!known) carried.by->parts.push_back(part);
  }
  const bool moves = carried.by || !carried.passing.empty();
  if (moves && (stands || !carried.by)) return {false, std::nullopt, {}};
  return carried;
}

}  // namespace carom::adjoint_detail
