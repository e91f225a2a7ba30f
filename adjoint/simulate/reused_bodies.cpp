// SPDX-License-Identifier: MIT
#include "adjoint/simulate/reused_bodies.hpp"

#include <algorithm>

namespace carom::adjoint_detail {
namespace {

bool samePlan(const BodyPlan& a, const BodyPlan& b) {
  return a.tier == b.tier && a.derivative_tier == b.derivative_tier && a.derivative_products == b.derivative_products;
}

bool sameImpact(const Tilt& a, const Tilt& b) { return a.body == b.body && a.impact == b.impact; }

// Whether bodies can go alike in both at all.
bool isComparable(const Motion& known, const Motion& motion, double duration) {
  const Scene &was = *known.scene, &scene = *motion.scene;
  return known.has_events && known.status == MotionStatus::complete && known.duration >= duration &&
         known.lowest_bounce == motion.lowest_bounce && was.gravity == scene.gravity &&
         was.bodies.size() == scene.bodies.size() && std::ranges::equal(was.tilts, scene.tilts, sameImpact);
}

bool sameBody(const Motion& known, const Motion& motion, std::size_t body) {
  const Body &was = known.scene->bodies[body], &is = motion.scene->bodies[body];
  return was == is && materialOf(*known.scene, was) == materialOf(*motion.scene, is) &&
         samePlan(known.plan.bodies[body], motion.plan.bodies[body]);
}

}  // namespace

ReusedBodies::ReusedBodies(const Motion& known, const Motion& motion, double duration, const std::vector<int>& met) {
  if (!isComparable(known, motion, duration)) return;
  const std::vector<Body>& bodies = motion.scene->bodies;
  std::vector<char> same(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    same[b] = sameBody(known, motion, b);
    if (!bodies[b].fixed) continue;
    if (!same[b]) return;  // anything may meet it
    same[b] = false;
  }
  for (std::size_t i = 0; i < motion.scene->tilts.size(); ++i)
    if (!(motion.scene->tilts[i] == known.scene->tilts[i]))
      same[index(bodyIndex(*motion.scene, motion.scene->tilts[i].body))] = false;
  for (const StartOverlap& overlap : known.overlaps) same[index(overlap.a)] = same[index(overlap.b)] = false;
  for (int body : met) same[index(body)] = false;
  baseline_ = &known;
  is_known_ = std::move(same);
  passed_.assign(bodies.size(), 0);
  forgetThoseThatMeet();
  const auto beyond = std::ranges::find_if(known.events, [&](const Event& event) { return event.time > duration; });
  last_ = static_cast<std::size_t>(beyond - known.events.begin());
  skip();
}

std::size_t ReusedBodies::count() const { return static_cast<std::size_t>(std::ranges::count(is_known_, true)); }

// Of the participants of an event all are known, or none.
void ReusedBodies::forgetThoseThatMeet() {
  const auto isKnown = [&](const Participant& p) { return has(p.body); };
  for (bool again = true; again;) {
    again = false;
    for (const Event& event : baseline_->events) {
      if (std::ranges::all_of(event.participants, isKnown) || std::ranges::none_of(event.participants, isKnown)) continue;
      for (const Participant& p : event.participants) is_known_[index(p.body)] = false;
      again = true;
    }
  }
}

double ReusedBodies::nextTimeOf(int body) const {
  const std::vector<int>& events = line(body).events;
  const std::size_t passed = passed_[index(body)];
  return passed < events.size() ? baseline_->events[index(events[passed])].time : EventQueue::kNever;
}

void ReusedBodies::pass() {
  for (const Participant& p : next().participants)
    if (!p.stays) ++passed_[index(p.body)];
  ++next_;
  skip();
}

void ReusedBodies::skip() {
  while (next_ < last_ && !has(baseline_->events[next_].participants.front().body)) ++next_;
}

}  // namespace carom::adjoint_detail
