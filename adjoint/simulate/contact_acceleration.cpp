// SPDX-License-Identifier: MIT
#include "adjoint/simulate/contact_acceleration.hpp"

#include <algorithm>
#include <span>
#include <tuple>

namespace carom::adjoint_detail {
namespace {

// A rim whose heights differ by less lies flat, m for bodies of 1 m.
constexpr double kFlatRim = 1e-13;

}  // namespace

FreeAcceleration freeAcceleration(const BodyModel& model, const State& state, const Vec3& gravity) {
  const Mat3 A = model.inverseInertiaWorld(state.q.toRotationMatrix());
  return {model.gravity_factor * gravity, -(A * (A * state.L).cross(state.L))};
}

ContactSide freeSide(const Motion& motion, int body, const State& state, double time) {
  const BodyModel& model = (*motion.models)[asIndex(body)];
  if (!model.moving) return {state, std::nullopt};
  if (model.kinematic) return givenSide(motion, body, time);
  return {state, freeAcceleration(model, state, motion.scene->gravity)};
}

// The angular momentum of a kinematic body is its angular velocity (BodyModel).
ContactSide givenSide(const Motion& motion, int body, double time) {
  const Arc& arc = motion.world_lines[asIndex(body)].arcs.back();
  if (arc.stays()) return {arc.startState(), std::nullopt};
  const State state = arc.stateAt(time);
  const StateDerivative rate = arc.rateAt(time, state);
  return {state, FreeAcceleration{rate.v, rate.L}};
}

namespace {

// Between balls, and of a ball and a plane that stands still, as most contacts are; nothing for others.
std::optional<double> ofABall(const Motion& motion, const Contact& contact, const ContactSide& a, const ContactSide& b) {
  const auto isBall = [&](int body) {
    return std::holds_alternative<Sphere>(motion.scene->bodies[asIndex(body)].shape) &&
           (*motion.models)[asIndex(body)].center.isZero(0);
  };
  const auto stands = [&](int body, const ContactSide& side) {
    return !side.acceleration && std::holds_alternative<Plane>(motion.scene->bodies[asIndex(body)].shape);
  };
  const Vec3& n = contact.at.normal;
  const bool first = isBall(contact.a), second = isBall(contact.b);
  if (first && a.acceleration && stands(contact.b, b)) return n.dot(a.acceleration->v);
  if (second && b.acceleration && stands(contact.a, a)) return -n.dot(b.acceleration->v);
  if (!first || !second) return std::nullopt;
  const auto speed = [](const ContactSide& side) { return side.acceleration ? side.state.v : Vec3(Vec3::Zero()); };
  const auto pull = [](const ContactSide& side) { return side.acceleration ? side.acceleration->v : Vec3(Vec3::Zero()); };
  const Vec3 apart = a.state.x - b.state.x, u = speed(a) - speed(b);
  const double distance = apart.norm();
  if (!(distance > 0)) return std::nullopt;
  return n.dot(pull(a) - pull(b)) + n.cross(u).squaredNorm() / distance;
}

}  // namespace

std::optional<RimOnFace> rimOf(const Motion& motion, const Contact& c) {
  const auto mayHaveRim = [&](int body) {
    const Shape& shape = motion.scene->bodies[asIndex(body)].shape;
    return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape) || std::holds_alternative<Compound>(shape);
  };
  if (!mayHaveRim(c.a) && !mayHaveRim(c.b)) return std::nullopt;  // far most often
  const auto* rims = dynamic_cast<const RimGeometry*>(motion.geometry.get());
  return rims ? rims->rimOnFace(c.a, c.b, c.features) : std::nullopt;
}

bool rimLiesFlat(const Motion& motion, const Contact& contact, const Pose& A, const Pose& B) {
  const auto rim = rimOf(motion, contact);
  if (!rim || !(rim->features == contact.features)) return false;
  const Vec3 d = (rim->of_first ? A : B).R * rim->axis, N = (rim->of_first ? B : A).R * rim->normal;
  return 2 * rim->radius * RimOnFace::tilt(d, N).norm() <= kFlatRim * std::max(1.0, A.x.cwiseAbs().maxCoeff());
}

double gapAcceleration(const Motion& motion, const Contact& contact, const ContactSide& a, const ContactSide& b) {
  if (const auto alpha = ofABall(motion, contact, a, b)) return *alpha;
  Eigen::Matrix<double, 12, 1> velocity = Eigen::Matrix<double, 12, 1>::Zero(), acceleration = velocity;
  const auto place = [&](int body, const ContactSide& side, Eigen::Index at) {
    const BodyModel& model = (*motion.models)[asIndex(body)];
    const Mat3 R = side.state.q.toRotationMatrix();
    if (side.acceleration) {
      velocity.segment<6>(at) << side.state.v, model.inverseInertiaWorld(R) * side.state.L;
      acceleration.segment<6>(at) << side.acceleration->v, side.acceleration->w;
    }
    return Pose{side.state.x, model.shapeToWorld(R)};
  };
  const Pose A = place(contact.a, a, 0), B = place(contact.b, b, 6);
  const ContactGeometry& geometry = *motion.geometry;
  if (rimLiesFlat(motion, contact, A, B)) {  // as of the point of the body there
    double of_points = 0;
    for (const auto& [side, at, sign] : {std::tuple{&a, 0, 1.0}, std::tuple{&b, 6, -1.0}}) {
      const Vec3 arm = contact.at.point - side->state.x, w = velocity.segment<3>(at + 3);
      of_points += sign * contact.at.normal.dot(Vec3(acceleration.segment<3>(at)) + Vec3(acceleration.segment<3>(at + 3)).cross(arm) +
                                                w.cross(w.cross(arm)));
    }
    return of_points;
  }
  const ContactJacobian J = geometry.jacobian(contact.a, contact.b, contact.features, A, B);
  double alpha = J.pose.row(0).dot(acceleration);
  if (velocity.isZero(0)) return alpha;
  PairTangent along;
  along.pose = velocity;
  along.size_a = Eigen::VectorXd::Zero(J.size_a.cols());
  along.size_b = Eigen::VectorXd::Zero(J.size_b.cols());
  const auto rates =
      geometry.jacobianRates(contact.a, contact.b, contact.features, A, B, std::span<const PairTangent>(&along, 1));
  return alpha + rates[0].pose.row(0).dot(velocity);
}

std::optional<double> settlesAt(const Motion& motion, const Event& event, const std::vector<State>& after) {
  const Contact& c = event.contacts[0];
  if (event.contacts.size() > 1 || !c.captured || !(c.approach < 0)) return std::nullopt;
  const Scene& scene = *motion.scene;
  const auto material = [&](int body) { return materialOf(scene, scene.bodies[asIndex(body)]); };
  const double e = combine(material(c.a), material(c.b)).elasticity;
  const auto sideOf = [&](int body) {
    const Participant* p = event.find(body);
    return freeSide(motion, body, p ? after[static_cast<std::size_t>(p - event.participants.data())]
                                    : motion.world_lines[asIndex(body)].arcs.back().startState(), event.time);
  };
  const double alpha = gapAcceleration(motion, c, sideOf(c.a), sideOf(c.b));
  if (!(alpha < 0 && e < 1)) return std::nullopt;
  return event.time + 2 * e * c.approach / (alpha * (1 - e));
}

}  // namespace carom::adjoint_detail
