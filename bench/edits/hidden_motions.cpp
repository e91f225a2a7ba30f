// SPDX-License-Identifier: MIT
#include "bench/edits/hidden_motions.h"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "bench/edits/checks.h"
#include "bench/edits/goals.h"
#include "bench/edits/tables.h"
#include "bench/edits/throws.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace editing_detail;

namespace {

constexpr double kLongestThrow = 4;  // s
constexpr int kMostImpactsBefore = 4;

Motion play(const Scene& scene, double until) {
  OdeContacts contacts(scene);
  return simulate(scene, contacts, until, {.impact_limit = 60, .asked = {}});
}

Target coordinates(const std::string& quantity, const Vec3& v, const std::vector<int>& held) {
  Target target{quantity, {any, any, any}};
  for (int i : held) target.value[static_cast<std::size_t>(i)] = v[i];
  return target;
}

/// A number or two of a body just before an impact.
void holdAtImpact(Constraint& c, const Motion& motion, int event, bool planar, Dice& dice) {
  const BodyState s = motion.stateBefore(event, bodyIndex(*motion.scene, c.body));
  const double kind = dice.in(0, 1);
  const int axes = planar ? 2 : 3, axis = dice.integer(0, axes - 1);
  if (kind < 0.3) {
    c.targets = {{"time", {motion.events[static_cast<std::size_t>(event)].time}}};
  } else if (kind < 0.7) {
    c.targets = {coordinates("position", s.position, {axis})};
  } else if (kind < 0.85) {
    c.targets = {coordinates("velocity", s.velocity, {axis})};
  } else {
    c.targets = {coordinates("position", s.position, {axis}),
                 {"time", {motion.events[static_cast<std::size_t>(event)].time}}};
  }
}

std::vector<Control> controlsOfShot(Dice& dice) {
  std::vector<Control> controls = {velocity("cue").only({"x", "y"})};
  if (dice.chance(0.25)) controls.push_back(elasticity("resin"));
  if (dice.chance(0.15)) controls.push_back(elasticity("cushion"));
  if (dice.chance(0.2)) controls.push_back(position("cue").only({"x", "y"}));
  for (Control& c : controls)
    if (dice.chance(0.2)) c.weighted(dice.oneOf(std::vector<double>{0.25, 0.5, 2, 4}));
  return controls;
}

// Of a body on a table, at a time: one or two coordinates.
Constraint placeAt(const Motion& motion, const std::string& body, double t, Dice& dice) {
  const Vec3 place = motion.stateAt(body, t).position;
  const bool both = dice.chance(0.6);
  const std::vector<int> held = both ? std::vector<int>{0, 1} : std::vector<int>{dice.integer(0, 1)};
  return {body, t, {coordinates("position", place, held)}};
}

// The ball that moves last, at its last rail; where it touches none, the ball that strikes it, then.
std::optional<Constraint> placeAtLastImpact(const Shot& shot, const Motion& motion, bool touches_rail, Dice& dice) {
  const std::string body = touches_rail ? shot.mover : shot.striker;
  const double time = touches_rail ? shot.from : shot.struck_at;
  const int index = bodyIndex(*motion.scene, body);
  for (std::size_t i = 0; i < motion.events.size(); ++i) {
    const Event& e = motion.events[i];
    const Participant* p = e.find(index);
    if (!p || !e.counts() || std::abs(e.time - time) > 1e-6) continue;
    Constraint c{body, nthImpact(p->impact), {}};
    if (!touches_rail) c.at = nthImpact(1, shot.struck);
    holdAtImpact(c, motion, static_cast<int>(i), true, dice);
    return c;
  }
  return std::nullopt;
}

std::optional<HiddenMotion> chain(const Wanted& wanted, Dice& dice) {
  std::vector<Leg> legs(static_cast<std::size_t>(wanted.balls + 1));
  for (int rail = 0; rail < wanted.rails; ++rail) ++legs[static_cast<std::size_t>(dice.integer(0, wanted.balls))].rails;
  legs.front().cue = true;
  legs.back().strikes = false;
  const auto shot = drawShot(legs, dice);
  if (!shot) return std::nullopt;
  const Motion motion = play(shot->scene, shot->to);
  HiddenMotion hidden{shot->scene, controlsOfShot(dice), {}, {}, 0, true};
  const double t = shot->from + dice.in(0.3, 0.9) * (shot->to - shot->from);
  if (wanted.goal == Goal::at_a_time) {
    hidden.constraints = {placeAt(motion, shot->mover, t, dice)};
  } else if (const auto c = placeAtLastImpact(*shot, motion, legs.back().rails > 0, dice)) {
    hidden.constraints = {*c};
  } else {
    return std::nullopt;
  }
  hidden.duration = durationFor(hidden.constraints, wanted.goal == Goal::at_a_time ? t : shot->from);
  return hidden;
}

// The n-th impact of a body with another, and something of it.
std::optional<HiddenMotion> hitsIn(HiddenMotion hidden, const std::string& body, const std::string& other, int n,
                                   Goal goal, Dice& dice) {
  const Motion motion = play(hidden.scene, kLongestThrow + 8);
  const auto event = motion.findImpact(bodyIndex(hidden.scene, body), n, bodyIndex(hidden.scene, other));
  if (!event) return std::nullopt;
  const double time = motion.events[static_cast<std::size_t>(*event)].time;
  hidden.duration = 1.2 * time + 0.05;
  Constraint c{body, nthImpact(n, other), {}};
  if (goal == Goal::impact_comes) {
    c = {body, 0.0, {}};
    c.hits = Hit{other};
  } else {
    holdAtImpact(c, motion, *event, hidden.planar, dice);
  }
  hidden.constraints = {c};
  hidden.missed_at_start = true;
  return hidden;
}

std::optional<HiddenMotion> hitOnTable(const Wanted& wanted, Dice& dice) {
  const bool by_red = dice.chance(0.3), first_red = by_red || dice.chance(0.3);
  std::vector<Leg> legs;
  if (first_red) legs.push_back({true, dice.integer(0, 1)});
  legs.push_back({!by_red, dice.integer(0, 2)});
  const auto shot = drawShot(legs, dice);
  if (!shot) return std::nullopt;
  return hitsIn({shot->scene, controlsOfShot(dice), {}, {}, 0, true}, shot->striker, shot->struck, 1, wanted.goal,
                dice);
}

Body targetAt(const Vec3& place, const Vec3& velocity, double reach, Dice& dice) {
  Body target;
  target.name = "target";
  target.fixed = true;
  target.material = "ground";
  const double size = dice.in(0.08, 0.3);
  if (dice.chance(0.5)) {
    target.shape = Sphere{size / 2};
  } else {
    target.shape = Box{size * dice.inBox(Vec3::Constant(0.5), Vec3::Ones())};
    target.orientation = dice.rotation();
  }
  target.position = place + (reach + 0.4 * size) * (velocity.normalized() + 0.4 * dice.inCube(1)).normalized();
  return target;
}

std::vector<Control> controlsOfThrow(const Scene& scene, Dice& dice) {
  std::vector<Control> controls = {velocity("thrown")};
  if (dice.chance(0.4)) controls.push_back(angularVelocity("thrown"));
  if (dice.chance(0.3)) controls.push_back(position("thrown"));
  if (dice.chance(0.3)) controls.push_back(elasticity(dice.oneOf(scene.materials).name));
  if (dice.chance(0.2) && scene.bodies.back().mass) controls.push_back(mass(scene.bodies.back().name));
  for (Control& c : controls)
    if (dice.chance(0.2)) c.weighted(dice.oneOf(std::vector<double>{0.25, 0.5, 2, 4}));
  return controls;
}

// A throw over a floor, and a body that stands where it passes, after up to two impacts.
std::optional<HiddenMotion> hitInFlight(const Wanted& wanted, Dice& dice) {
  Scene scene = drawThrow(static_cast<Family>(dice.integer(0, 2)), dice);
  const Motion motion = play(scene, kLongestThrow);
  const std::size_t impacts = static_cast<std::size_t>(dice.integer(0, 2));
  if (motion.events.size() < impacts) return std::nullopt;
  const double from = impacts > 0 ? motion.events[impacts - 1].time : 0;
  const double to = std::min(motion.events.size() > impacts ? motion.events[impacts].time : motion.end, from + 0.6);
  if (to - from < 0.1) return std::nullopt;
  const BodyState s = motion.stateAt("thrown", from + dice.in(0.4, 0.9) * (to - from));
  const Shape& shape = scene.bodies[static_cast<std::size_t>(bodyIndex(scene, "thrown"))].shape;
  scene.bodies.insert(scene.bodies.begin(),
                      targetAt(s.position, s.velocity, 0.6 * kindOf(shape).boundingRadius(shape), dice));
  return hitsIn({scene, controlsOfThrow(scene, dice), {}, {}, 0, false}, "thrown", "target", 1, wanted.goal, dice);
}

std::optional<HiddenMotion> encounter(const Wanted& wanted, Dice& dice) {
  HiddenMotion hidden{drawThrow(Family::meeting, dice), {}, {}, {}, 0, false};
  const Motion motion = play(hidden.scene, kLongestThrow);
  const auto met = motion.findImpact(bodyIndex(hidden.scene, "thrown"), 1, bodyIndex(hidden.scene, "other"));
  if (!met || *met >= kMostImpactsBefore) return std::nullopt;
  hidden.controls = controlsOfThrow(hidden.scene, dice);
  if (dice.chance(0.6)) hidden.controls.push_back(velocity("other"));
  Wanted then = wanted;
  then.impacts = *met + 1 + dice.integer(0, 2);
  if (wanted.goal == Goal::at_an_impact) {
    Constraint c{"thrown", nthImpact(1, "other"), {}};
    holdAtImpact(c, motion, *met, false, dice);
    hidden.constraints = {c};
    hidden.missed_at_start = true;
  } else {
    hidden.constraints = drawGoal(motion, then, dice);
    if (hidden.constraints.empty()) return std::nullopt;
  }
  hidden.duration = durationFor(hidden.constraints, wanted.goal == Goal::at_an_impact
                                                        ? motion.events[static_cast<std::size_t>(*met)].time
                                                        : double(hidden.constraints[0].at.time));
  return hidden;
}

// What the cue ball touches before the last ball, and in which order.
std::optional<HiddenMotion> required(const Wanted& wanted, Dice& dice) {
  const std::vector<std::vector<Leg>> kinds = {
      {{true, 0}, {true, 3}},          // three cushions
      {{true, 1}},                     // off a rail
      {{true, 0}, {true, 0}},          // two balls
      {{true, 0}, {true, 1}},          // with a rail between
      {{true, 2}},                     // off two rails
      {{true, 1}, {true, 2}},          // three cushions, one of them first
      {{true, 0}, {true, 2}},          // two cushions
      {{true, 3}},                     // off three rails
      {{true, 0}, {true, 1}, {true}},  // three balls
      {{true, 1}, {true, 0}},          // a rail first
  };
  const auto shot = drawShot(kinds[static_cast<std::size_t>(wanted.kind) % kinds.size()], dice);
  if (!shot) return std::nullopt;
  HiddenMotion hidden{shot->scene, controlsOfShot(dice), {}, shot->sequence, 0, true};
  hidden.duration = 1.2 * shot->struck_at + 0.05;
  hidden.constraints = {{"", 0.0, {}}};
  hidden.constraints[0].sequence = shot->sequence;
  hidden.missed_at_start = true;
  return hidden;
}

std::optional<HiddenMotion> rack(const Wanted& wanted, Dice& dice) {
  HiddenMotion hidden{drawRack(wanted.balls, dice), {}, {}, {}, 0, true};
  hidden.controls = {velocity("cue").only({"x", "y"})};
  if (dice.chance(0.5)) hidden.controls.push_back(position("cue").only({"x", "y"}));
  const Motion motion = play(hidden.scene, 3);
  const auto moves = motion.findImpact(bodyIndex(hidden.scene, "corner"), 1);
  if (!moves) return std::nullopt;
  const double t = motion.events[static_cast<std::size_t>(*moves)].time + dice.in(0.2, 0.8);
  if (t > motion.end) return std::nullopt;
  hidden.constraints = {placeAt(motion, "corner", t, dice)};
  hidden.duration = t + 0.01;
  return hidden;
}

// A target holds what the motion has there.
void holdAsRead(const HiddenMotion& hidden, const Motion& motion, Constraint& c) {
  const ConstraintSet set(hidden.scene, {c});
  const RowValues rows = set.evaluate(motion);
  for (std::size_t i = 0; i < set.rows().size(); ++i) {
    const Row& row = set.rows()[i];
    c.targets[static_cast<std::size_t>(row.target_index)].value[static_cast<std::size_t>(row.component)] =
        rows.values[static_cast<Eigen::Index>(i)];
  }
}

// A throw after up to three impacts, or at one: how fast it is, how high, or how hard it strikes.
std::optional<HiddenMotion> speed(const Wanted& wanted, Dice& dice) {
  HiddenMotion hidden{drawThrow(static_cast<Family>(dice.integer(0, 2)), dice), {}, {}, {}, 0, false};
  const Motion motion = play(hidden.scene, kLongestThrow);
  const std::size_t impacts = static_cast<std::size_t>(dice.integer(1, 3));
  if (motion.events.size() < impacts + 1) return std::nullopt;
  const double from = motion.events[impacts - 1].time, to = motion.events[impacts].time;
  if (to - from < 0.1) return std::nullopt;
  hidden.controls = controlsOfThrow(hidden.scene, dice);
  const double t = from + dice.in(0.2, 0.8) * (to - from);
  constexpr const char* kWords[] = {"speed", "kinetic_energy", "height", "impulse"};
  const bool at_impact = wanted.goal == Goal::at_an_impact;
  Constraint c{"thrown", at_impact ? nthImpact(static_cast<int>(impacts)) : When(t), {{kWords[wanted.kind % 4], {1}}}};
  if (dice.chance(0.5)) c.targets.push_back(coordinates("position", Vec3::Ones(), {dice.integer(0, 1)}));
  holdAsRead(hidden, motion, c);
  hidden.constraints = {c};
  hidden.duration = durationFor(hidden.constraints, at_impact ? from : t);
  return hidden;
}

// Two flights, or a throw past a body that stands there: how far they are from each other at a time.
std::optional<HiddenMotion> distance(const Wanted& wanted, Dice& dice) {
  const bool both_fly = wanted.kind % 2 == 0;
  HiddenMotion hidden{
      drawThrow(both_fly ? Family::meeting : static_cast<Family>(dice.integer(0, 2)), dice), {}, {}, {}, 0, false};
  if (!both_fly)
    hidden.scene.bodies.insert(hidden.scene.bodies.begin(),
                               targetAt(0.5 * dice.inCube(1) + Vec3(0.3, 0, 0.5), Vec3::UnitX(), 0, dice));
  const Motion motion = play(hidden.scene, kLongestThrow);
  const double t = dice.in(0.2, 0.9);
  if (t > motion.end) return std::nullopt;
  hidden.controls = controlsOfThrow(hidden.scene, dice);
  Target far{"distance", {1}};
  far.to = both_fly ? "other" : "target";
  Constraint c{"thrown", t, {far}};
  if (dice.chance(0.5)) c.targets.push_back(coordinates("position", Vec3::Ones(), {dice.integer(0, 2)}));
  holdAsRead(hidden, motion, c);
  if (!(c.targets[0].value[0] > 0.02)) return std::nullopt;
  hidden.constraints = {c};
  hidden.duration = t + 0.01;
  return hidden;
}

}  // namespace

std::optional<HiddenMotion> drawHiddenMotion(const Wanted& wanted, Dice& dice) {
  switch (wanted.family) {
    case Family::chain:
      return chain(wanted, dice);
    case Family::encounter:
      return encounter(wanted, dice);
    case Family::hit:
      return wanted.kind % 2 == 0 ? hitOnTable(wanted, dice) : hitInFlight(wanted, dice);
    case Family::required:
      return required(wanted, dice);
    case Family::rack:
      return rack(wanted, dice);
    case Family::speed:
      return speed(wanted, dice);
    case Family::distance:
      return distance(wanted, dice);
    default:
      return std::nullopt;
  }
}

}  // namespace carom::bench
