// SPDX-License-Identifier: MIT
#include "bench/edits/goals.h"

#include <algorithm>

#include "adjoint/scene/scene.h"

namespace carom::bench {
namespace {

constexpr double kShortestFlight = 0.02;  // s, between the impacts around a target
constexpr double kLongestFlight = 0.4;    // s, from an impact to a target after it

std::vector<TargetNumber> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Target positionOf(const BodyState& s) { return {"position", numbers(s.position)}; }
Target velocityOf(const BodyState& s) { return {"velocity", numbers(s.velocity)}; }
Target orientationOf(const BodyState& s) {
  const Quat& q = s.orientation;
  return {"orientation", {q.w(), q.x(), q.y(), q.z()}};
}
// A point on the body, in shape axes, and where it is.
Target pointOf(const BodyState& s, const Body& body, Dice& dice) {
  const Vec3 b = 0.7 * kindOf(body.shape).boundingRadius(body.shape) * dice.direction();
  return {"point", numbers(s.position + s.orientation * b), b};
}
Target without(Target target, int component) {
  target.value[static_cast<std::size_t>(component)] = any;
  return target;
}

/// A time in the flight after the first `impacts` impacts; 0 where there is none long enough.
double timeAfter(const Motion& motion, int impacts, Dice& dice) {
  const std::size_t n = static_cast<std::size_t>(impacts);
  if (motion.events.size() < n) return 0;
  const double from = n > 0 ? motion.events[n - 1].time : 0;
  const double next = motion.events.size() > n ? motion.events[n].time : motion.end;
  const double to = std::min(next, from + kLongestFlight);
  return to - from < kShortestFlight ? 0 : from + dice.in(0.2, 0.8) * (to - from);
}

std::vector<std::string> movingBodies(const Scene& scene) {
  std::vector<std::string> names;
  for (const Body& body : scene.bodies)
    if (!body.fixed) names.push_back(body.name);
  return names;
}

/// The impact `event` as the n-th one of a body that takes part in it; sometimes counted with its partner alone.
Constraint atImpact(const Motion& motion, int event, Dice& dice) {
  const Event& e = motion.events[static_cast<std::size_t>(event)];
  const Participant& p = dice.oneOf(e.participants);
  const std::string name = motion.scene->bodies[static_cast<std::size_t>(p.body)].name;
  if (!dice.chance(0.4)) return {name, nthImpact(p.impact), {}};
  const Contact& c = e.contacts.front();
  const int partner = c.a == p.body ? c.b : c.a;
  int count = 0;
  for (int i = 0; i <= event; ++i) count += motion.events[static_cast<std::size_t>(i)].touches(p.body, partner);
  return {name, nthImpact(count, motion.scene->bodies[static_cast<std::size_t>(partner)].name), {}};
}

BodyState stateAtImpact(const Motion& motion, const Constraint& constraint, int event) {
  return motion.stateBefore(event, bodyIndex(*motion.scene, constraint.body));
}

std::vector<Constraint> goalAtATime(const Motion& motion, const Wanted& wanted, Dice& dice) {
  const double t = timeAfter(motion, wanted.impacts, dice);
  if (t == 0) return {};
  Constraint c{dice.oneOf(movingBodies(*motion.scene)), t, {}};
  const int index = bodyIndex(*motion.scene, c.body);
  const BodyState s = motion.stateAt(index, t);
  const double kind = dice.in(0, 1);
  if (kind < 0.35) {
    c.targets = {positionOf(s)};
  } else if (kind < 0.6) {
    c.targets = {without(positionOf(s), dice.integer(0, 2))};
  } else if (kind < 0.8) {
    c.targets = {pointOf(s, motion.scene->bodies[static_cast<std::size_t>(index)], dice)};
  } else if (kind < 0.9) {
    c.targets = {velocityOf(s)};
  } else {
    c.targets = {positionOf(s), without(velocityOf(s), dice.integer(0, 2))};
  }
  return {c};
}

// Floor and ball leave the height of an impact no freedom: it is not held.
std::vector<Constraint> goalAtAnImpact(const Motion& motion, const Wanted& wanted, Dice& dice) {
  const int event = wanted.impacts - 1;
  if (static_cast<int>(motion.events.size()) < wanted.impacts) return {};
  Constraint c = atImpact(motion, event, dice);
  const BodyState s = stateAtImpact(motion, c, event);
  const Event& e = motion.events[static_cast<std::size_t>(event)];
  const bool between_moving = e.participants.size() == 2;
  const double kind = dice.in(0, 1);
  if (between_moving && kind < 0.6) {
    c.targets = {positionOf(s)};
  } else {
    c.targets = {without(
        positionOf(s),
        e.contacts.front().at.normal.cwiseAbs().maxCoeff() == std::abs(e.contacts.front().at.normal.x()) ? 0 : 2)};
  }
  if (kind > 0.6 && kind < 0.85) c.targets.push_back({"time", {e.time}});
  if (kind > 0.85) c.targets.push_back(without(without(velocityOf(s), dice.integer(0, 1)), 2));
  return {c};
}

std::vector<Constraint> goalPose(const Motion& motion, const Wanted& wanted, Dice& dice) {
  if (dice.chance(0.4)) {
    const int event = wanted.impacts - 1;
    if (static_cast<int>(motion.events.size()) < wanted.impacts) return {};
    Constraint c = atImpact(motion, event, dice);
    const BodyState s = stateAtImpact(motion, c, event);
    c.targets = {orientationOf(s)};
    if (dice.chance(0.5)) c.targets.push_back(without(positionOf(s), 2));
    return {c};
  }
  const double t = timeAfter(motion, wanted.impacts, dice);
  if (t == 0) return {};
  Constraint c{dice.oneOf(movingBodies(*motion.scene)), t, {}};
  const BodyState s = motion.stateAt(c.body, t);
  c.targets = {orientationOf(s)};
  if (dice.chance(0.7)) c.targets.push_back(positionOf(s));
  return {c};
}

std::vector<Constraint> goalTwoNails(const Motion& motion, const Wanted& wanted, Dice& dice) {
  const double t = timeAfter(motion, wanted.impacts, dice);
  if (t == 0) return {};
  const std::vector<std::string> bodies = movingBodies(*motion.scene);
  Constraint last{dice.oneOf(bodies), t, {}};
  last.targets = {positionOf(motion.stateAt(last.body, t))};
  if (dice.chance(0.4)) last.targets[0] = without(last.targets[0], dice.integer(0, 2));
  if (wanted.impacts > 1 && dice.chance(0.3)) {
    const int event = dice.integer(0, wanted.impacts - 2);
    Constraint first = atImpact(motion, event, dice);
    first.targets = {without(positionOf(stateAtImpact(motion, first, event)), 2)};
    return {first, last};
  }
  const double before = timeAfter(motion, dice.integer(0, wanted.impacts - 1), dice);
  if (before == 0) return {};
  Constraint first{dice.oneOf(bodies), before, {}};
  first.targets = {positionOf(motion.stateAt(first.body, before))};
  if (dice.chance(0.5)) first.targets[0] = without(first.targets[0], dice.integer(0, 2));
  return {first, last};
}

}  // namespace

std::vector<Constraint> drawGoal(const Motion& hidden, const Wanted& wanted, Dice& dice) {
  switch (wanted.goal) {
    case Goal::at_a_time:
      return goalAtATime(hidden, wanted, dice);
    case Goal::at_an_impact:
      return goalAtAnImpact(hidden, wanted, dice);
    case Goal::pose:
      return goalPose(hidden, wanted, dice);
    case Goal::two_nails:
      return goalTwoNails(hidden, wanted, dice);
    case Goal::impact_comes:
      break;  // of other families
  }
  return {};
}

}  // namespace carom::bench
