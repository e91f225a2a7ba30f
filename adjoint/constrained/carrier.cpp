// SPDX-License-Identifier: MIT
#include "adjoint/constrained/carrier.hpp"

#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {
namespace {

// Velocities of a belt at several contacts that differ by less than this share are one.
constexpr double kSameVelocity = 1e-12;
// A place that goes with a body but for this share does.
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

}  // namespace

Carrier::Instant Carrier::at(double t) const {
  Instant now;
  if (isBelt()) {
    now.v = alongFaceOf(normal, Vec3(support.pose.R * support.surface_velocity));
    now.x = (t - start) * now.v;
    return now;
  }
  const Kinematics k = support.arc->kinematicsAt(t);
  now.x = k.x, now.v = k.v, now.w = k.w;
  now.turned = k.R * support.pose.R.transpose();
  return now;
}

Carrier::Derivative Carrier::tangent(const Motion& motion, const SceneTangent& dscene) const {
  const BodyDerivative& d = dscene.bodies[static_cast<std::size_t>(body)];
  Derivative out;
  if (isBelt()) {  // its normal turns with the body
    out.v = d.orientation.cross(at(start).v) + alongFaceOf(normal, Vec3(support.pose.R * d.surface_velocity));
    return out;
  }
  const StateDerivative of = fromSceneStart(motion, body, support, start).tangent(d);
  out.x = of.x, out.v = of.v, out.w = of.L;
  return out;
}

void Carrier::pullback(const Motion& motion, const Derivative& bar, SceneGradient& scene_bar) const {
  BodyDerivative& d = scene_bar.bodies[static_cast<std::size_t>(body)];
  if (isBelt()) {
    d.orientation += at(start).v.cross(bar.v);
    d.surface_velocity += support.pose.R.transpose() * alongFaceOf(normal, bar.v);
    return;
  }
  StateDerivative of;
  of.x = bar.x, of.v = bar.v, of.L = bar.w;
  fromSceneStart(motion, body, support, start).pullback(of, d);
}

Carried carriedBy(const Motion& motion, const std::vector<const Contact*>& outer, double time) {
  Carried carried;
  bool stands = false;
  for (const Contact* c : outer) {
    const auto isMoved = [&](int body) { return !bodyOf(motion, body).immovable(); };
    const int body = isMoved(c->a) ? c->b : c->a;
    if (!drivesContacts(motion, body)) {
      stands = true;
      continue;
    }
    if (carried.by && carried.by->body != body) return {false, std::nullopt};
    const Support support = carried.by ? carried.by->support : supportOf(motion, body, time);
    const bool uniform = !support.isGiven() && !(support.moves() && support.has_belt) && support.surface_angular_velocity.isZero(0);
    if (!uniform || (!support.moves() && !liesOnFaceOf(motion, *c, body, time))) return {false, std::nullopt};
    const Carrier here{body, time, support, c->at.normal};
    if (!carried.by) {
      carried.by = here;
    } else if (here.isBelt()) {
      const Vec3 v = carried.by->at(time).v;
      if (!((here.at(time).v - v).norm() <= kSameVelocity * v.norm())) return {false, std::nullopt};
    }
  }
  if (stands && carried.by) return {false, std::nullopt};
  return carried;
}

}  // namespace carom::adjoint_detail
