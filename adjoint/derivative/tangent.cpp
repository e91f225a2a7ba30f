// SPDX-License-Identifier: MIT
#include "adjoint/derivative/tangent.h"

#include <algorithm>

#include "adjoint/base/arguments.hpp"
#include "adjoint/derivative/arc_pass.hpp"
#include "adjoint/derivative/derivative_arguments.hpp"
#include "adjoint/derivative/event_linearization.hpp"
#include "adjoint/derivative/influence.hpp"
#include "adjoint/derivative/seed.hpp"

namespace carom {

using namespace adjoint_detail;

double BodyStateRate::dot(const StateSeed& s) const {
  return position.dot(s.position) + orientation.dot(s.orientation) + velocity.dot(s.velocity) +
         angular_velocity.dot(s.angular_velocity) + center_of_mass.dot(s.center_of_mass) + time * s.time +
         mass * s.mass + inertia.cwiseProduct(s.inertia).sum() + gravity.dot(s.gravity) +
         (size.size() > 0 && s.size.size() > 0 ? size.dot(s.size) : 0);
}

StateDerivative MotionTangent::stateTangent(int body, int k, double t) const {
  const auto start_of = [&](int of, int arc) { return starts_[static_cast<std::size_t>(of)][static_cast<std::size_t>(arc)]; };
  const auto model_of = [&](int of) { return dmodels_[static_cast<std::size_t>(of)]; };
  return arcTangent(tape_->motion(), body, k, t, tape_->arcUntil(body, k, t), start_of, direction_, model_of);
}

BodyStateRate MotionTangent::at(int body, const Instant& instant) const {
  const Motion& motion = tape_->motion();
  const auto b = static_cast<std::size_t>(body);
  const ReadPlace place = readPlace(motion, body, instant);
  BodyStateRate rate;
  const bool starts = startsArc(motion, body, instant);
  StateDerivative ds =
      starts ? starts_[b][static_cast<std::size_t>(place.arc)] : stateTangent(body, place.arc, place.time);
  if (instant.event >= 0) {  // the instant moves along
    rate.time = eventTime(instant.event);
    ds.addScaled(rate.time, motion.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rateAt(place.time, place.state));
  }
  const BodyModel& model = (*motion.models)[b];
  rate.position = originTangent(model, place.state, ds, dmodels_[b]);
  rate.center_of_mass = ds.x;
  rate.orientation = ds.theta;
  rate.velocity = ds.v;
  rate.angular_velocity = angularVelocityTangent(model, place.state, ds, dmodels_[b]);
  rate.mass = dmodels_[b].mass;
  rate.inertia = model.R_BG.transpose() * dmodels_[b].inertiaTensor() * model.R_BG;
  if (!sizes_.empty()) rate.size = sizes_[b];
  rate.gravity = direction_.gravity;
  return rate;
}

const StateDerivative& MotionTangent::start(int body, int arc) const {
  const auto& of_body = starts_[checkedIndex("MotionTangent::start", "body", body, starts_.size())];
  return of_body[checkedIndex("MotionTangent::start", "arc", arc, of_body.size())];
}

const BodyModelDerivative& MotionTangent::model(int body) const {
  return dmodels_[checkedIndex("MotionTangent::model", "body", body, dmodels_.size())];
}

double MotionTangent::eventTime(int event) const {
  return event_time_[checkedIndex("MotionTangent::eventTime", "event", event, event_time_.size())];
}

MotionTangent tangent(DerivativeTape& tape, const SceneTangent& direction) {
  checkDirection("tangent", *tape.motion().scene, direction);
  return tangent(tape, direction, nullptr);
}

MotionTangent tangent(DerivativeTape& tape, const SceneTangent& direction, const Influence* influence) {
  const Motion& motion = tape.motion();
  MotionTangent t;
  t.tape_ = &tape;
  t.direction_.gravity = direction.gravity;
  const auto is_impact = [](const Event& event) { return event.kind == EventKind::impact; };
  if (!std::ranges::all_of(motion.events, is_impact)) t.direction_ = direction;
  if (!std::ranges::all_of(direction.bodies, [](const BodyDerivative& d) { return d.size.isZero(0); }))
    for (const BodyDerivative& d : direction.bodies) t.sizes_.push_back(d.size);
  t.starts_.resize(motion.world_lines.size());
  for (std::size_t b = 0; b < motion.world_lines.size(); ++b) {
    const Body& body = motion.scene->bodies[b];
    t.dmodels_.push_back(modelTangent(body, (*motion.models)[b], direction.bodies[b]));
    t.starts_[b].push_back(startTangent(body, (*motion.models)[b], direction.bodies[b], t.dmodels_[b]));
  }
  const auto start_of = [&](int body, int arc) { return t.starts_[static_cast<std::size_t>(body)][static_cast<std::size_t>(arc)]; };
  const auto model_of = [&](int body) { return t.dmodels_[static_cast<std::size_t>(body)]; };
  for (std::size_t e = 0; e < motion.events.size(); ++e) {
    const Event& event = motion.events[e];
    if (influence && !influence->event(static_cast<int>(e))) {
      t.event_time_.push_back(0);
      for (const Participant& p : event.participants)
        if (!p.stays) t.starts_[static_cast<std::size_t>(p.body)].emplace_back();
      continue;
    }
    std::vector<StateDerivative> before;
    for (const Participant& p : event.participants) {
      before.push_back(arcTangent(motion, p.body, p.arc, event.time, tape.until(p, event.time), start_of, direction, model_of));
    }
    const EventLinearization::Tangent d = tape.event(static_cast<int>(e)).tangent(before, direction, t.dmodels_);
    t.event_time_.push_back(d.time);
    for (std::size_t i = 0; i < d.after.size(); ++i)
      if (!event.participants[i].stays) t.starts_[static_cast<std::size_t>(event.participants[i].body)].push_back(d.after[i]);
  }
  return t;
}

}  // namespace carom
