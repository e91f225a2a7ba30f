// SPDX-License-Identifier: MIT
#include "adjoint/simulate/motion_builder.hpp"

#include <tuple>
#include <utility>

#include "adjoint/base/arguments.hpp"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/impact/tilt.hpp"
#include "adjoint/motion/contact_surface.hpp"

namespace carom::adjoint_detail {

MotionBuilder::MotionBuilder(const Scene& scene, double duration) {
  motion.scene = std::make_shared<const Scene>(scene);
  auto models = std::make_shared<std::vector<BodyModel>>();
  models->reserve(scene.bodies.size());
  for (const Body& body : motion.scene->bodies) {
    models->push_back(modelOf(body));
    material_.push_back(&materialOf(*motion.scene, body));
  }
  motion.models = std::move(models);
  motion.duration = duration;
  motion.world_lines.resize(scene.bodies.size());
}

void MotionBuilder::give(const std::map<int, std::shared_ptr<Trajectory>>& trajectories) {
  for (const auto& [body, trajectory] : trajectories) {
    const std::size_t b = checkedIndex("simulate", "body with a given trajectory", body, motion.scene->bodies.size());
    if (!trajectory || !trajectory->isGiven() || !(*motion.models)[b].kinematic)
      throw InputError("found a trajectory for '" + motion.scene->bodies[b].name + "', expected one that is given, of a kinematic body");
    given_.insert_or_assign(body, trajectory);
  }
}

void MotionBuilder::giveAs(const Motion& like) {
  for (std::size_t b = 0; b < like.world_lines.size(); ++b)
    if (const Arc& first = like.world_lines[b].arcs.front(); first.trajectory().isGiven())
      given_.insert_or_assign(static_cast<int>(b), first.shared());
}

Arc MotionBuilder::flight(int body, double time, const State& state) const {
  if (const auto given = given_.find(body); given != given_.end())
    return {motion.modelOf(body), motion.plan.bodies[index(body)].tier, given->second, time, state};
  return {motion.modelOf(body), motion.plan.bodies[index(body)].tier, motion.scene->gravity, time, state};
}

void MotionBuilder::start() {
  for (std::size_t b = 0; b < motion.world_lines.size(); ++b) {
    const int body = static_cast<int>(b);
    const Arc arc = flight(body, 0, startState(motion.scene->bodies[b], (*motion.models)[b]));
    motion.world_lines[b].arcs.push_back(given_.contains(body) ? flight(body, 0, arc.stateAt(0)) : arc);
  }
}

void MotionBuilder::place(Contact& c, const Kinematics& a, const Kinematics& b) const {
  c.at = motion.geometry->contact(c.a, c.b, c.features, {a.x, a.R}, {b.x, b.R});
  c.impulse_normal = c.tilt_a < 0 && c.tilt_b < 0 ? c.at.normal
                                                  : tiltedNormal(c.at.normal, tiltOf(*motion.scene, c.tilt_a),
                                                                 tiltOf(*motion.scene, c.tilt_b));
  setVelocities(c, a, b);
}

void MotionBuilder::setVelocities(Contact& c, const Kinematics& a, const Kinematics& b) const {
  c.approach = c.at.normal.dot(a.v + a.w.cross(c.at.point - a.x) - b.v - b.w.cross(c.at.point - b.x));
  c.surface_velocity.setZero();
  for (const auto& [body, of, sign] : {std::tuple{c.a, &a, 1.0}, std::tuple{c.b, &b, -1.0}}) {
    if (!motion.scene->bodies[index(body)].surfaceMoves()) continue;
    const SurfaceMotion<double> surface = surfaceMotionOf(motion, body, {of->x, of->R});
    c.surface_velocity += sign * surface.at(c.at.point, c.at.normal);
  }
}

void MotionBuilder::placeMoving(Contact& c, const Kinematics& a, const Kinematics& b) const {
  c.at = motion.geometry->motion(c.a, c.b, c.features, {a.x, a.R}, {b.x, b.R}, {a.v, a.w}, {b.v, b.w}).at;
  c.impulse_normal = c.at.normal;
  setVelocities(c, a, b);
}

const Contact* MotionBuilder::notParted(const Event& event, const std::vector<State>& after) const {
  for (const Contact& c : event.contacts) {
    if (c.tilt_a < 0 && c.tilt_b < 0) continue;
    Vec3 u = Vec3::Zero();
    for (std::size_t i = 0; i < after.size(); ++i) {
      const int body = event.participants[i].body;
      if (body != c.a && body != c.b) continue;
      const Kinematics k = motion.world_lines[index(body)].arcs.back().kinematicsOf(after[i]);
      u += (body == c.a ? 1.0 : -1.0) * (k.v + k.w.cross(c.at.point - k.x));
    }
    if (!(c.at.normal.dot(u) >= 0 && c.impulse.dot(c.impulse_normal) > 0)) return &c;
  }
  return nullptr;
}

void MotionBuilder::add(Event&& event, std::vector<Arc>&& arcs) {
  const int number = static_cast<int>(motion.event_count++);
  if (event.counts()) ++motion.impacts;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (event.participants[i].stays) continue;
    WorldLine& line = motion.world_lines[index(event.participants[i].body)];
    line.arcs.push_back(std::move(arcs[i]));
    if (motion.has_events) line.events.push_back(number);
  }
  if (motion.has_events) motion.events.push_back(std::move(event));
}

void MotionBuilder::endFlight(std::size_t body, const NotComputable& why) {
  motion.status = MotionStatus::not_computable;
  motion.message = "the flight of '" + motion.scene->bodies[body].name + "' cannot be computed: " + why.what();
}

}  // namespace carom::adjoint_detail
