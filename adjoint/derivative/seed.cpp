// SPDX-License-Identifier: MIT
#include "adjoint/derivative/seed.hpp"

#include "adjoint/base/arguments.hpp"
#include "adjoint/derivative/derivative_arguments.hpp"
#include "adjoint/derivative/seed_pass.hpp"
#include "adjoint/motion/time_argument.hpp"

namespace carom {

StateSeed& StateSeed::operator*=(double factor) {
  for (Vec3* weights : {&position, &orientation, &velocity, &angular_velocity, &center_of_mass, &gravity})
    *weights *= factor;
  time *= factor, mass *= factor;
  inertia *= factor;
  size *= factor;
  return *this;
}

}  // namespace carom

namespace carom::adjoint_detail {

StateDerivative seedPullback(const BodyModel& model, const State& state, const StateSeed& seed,
                             BodyModelDerivative& model_bar) {
  return seedPullbackOf<double>(model, state.q.toRotationMatrix(), state.L, seed, model_bar);
}

Vec3 originTangent(const BodyModel& model, const State& state, const StateDerivative& ds,
                   const BodyModelDerivative& dmodel) {
  if (!model.moving) return ds.x;
  const Mat3 R_WG = model.shapeToWorld(state.q.toRotationMatrix());
  return ds.x - ds.theta.cross(R_WG * model.center) - R_WG * dmodel.center;
}

Vec3 angularVelocityTangent(const BodyModel& model, const State& state, const StateDerivative& ds,
                            const BodyModelDerivative& dmodel) {
  if (!model.moving) return Vec3::Zero();
  const Mat3 R = state.q.toRotationMatrix(), A = model.inverseInertiaWorld(R);
  const Vec3 omega = A * state.L;
  const Vec3 dJ_omega = R * (dmodel.inertiaTensor() * (R.transpose() * omega));
  return A * (ds.L - ds.theta.cross(state.L) - dJ_omega) + ds.theta.cross(omega);
}

ReadPlace readPlace(const Motion& motion, int body, const Instant& instant) {
  const std::size_t b = checkedIndex("an instant that is read", "body", body, motion.world_lines.size());
  if (instant.event != -1) {
    const Event& event =
        motion.events[checkedIndex("an instant that is read", "event", instant.event, motion.events.size())];
    const Participant* p = event.find(body);
    if (!p) return readPlace(motion, body, Instant::at(event.time));
    if (!instant.follows) return {event.time, p->arc, p->before};
    return {event.time, p->next(), motion.world_lines[b].arcs[static_cast<std::size_t>(p->next())].startState()};
  }
  checkTime("an instant that is read", motion, instant.time);
  const int k = motion.arcAt(body, instant.time);
  return {instant.time, k, motion.world_lines[b].arcs[static_cast<std::size_t>(k)].stateAt(instant.time)};
}

bool startsArc(const Motion& motion, int body, const Instant& instant) {
  if (!instant.follows || instant.event < 0) return false;
  const Participant* p = motion.events[static_cast<std::size_t>(instant.event)].find(body);
  return p && !p->stays;
}

double timeDerivative(const Motion& motion, const StateSeed& seed) {
  checkSeed("timeDerivative", motion, seed);
  const auto b = static_cast<std::size_t>(seed.body);
  const ReadPlace place = readPlace(motion, seed.body, seed.at);
  const StateDerivative F = motion.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rateAt(place.time, place.state);
  BodyModelDerivative unused;
  return seedPullback((*motion.models)[b], place.state, seed, unused).dot(F) + (seed.at.event >= 0 ? seed.time : 0);
}

}  // namespace carom::adjoint_detail
