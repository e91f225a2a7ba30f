// SPDX-License-Identifier: MIT
#include "adjoint/derivative/derivative_tape.h"

#include <algorithm>
#include <utility>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/refuse.hpp"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/derivative/event_linearization.hpp"
#include "adjoint/derivative/ground_seams.hpp"
#include "adjoint/derivative/single_impact.hpp"
#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/constrained/ride_path.hpp"
#include "adjoint/group/group_path.hpp"
#include "adjoint/impact/tilt.hpp"
#include "adjoint/motion/pair_rules.hpp"
#include "adjoint/motion/time_argument.hpp"
#include "adjoint/simulate/followed_path.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

constexpr double kReliableTilt = 1e-4;  // axes of a tilt turn by the inverse of this, as the normal does
constexpr std::size_t kRemembered = 10'000;  // sensitivities, of 288 bytes: what is read densely is not kept for good

double tiltMarginOf(const Event& event) {
  double least = 1;
  for (const Contact& c : event.contacts)
    least = std::min(least, tiltMargin(c.at.normal, c.tilt_a >= 0, c.tilt_b >= 0));
  return least;
}

std::string sentenceOf(const Motion& motion, int index) {
  return textOf(6, "the impact ", motion.describeEvent(index),
                " at t = ", motion.events[static_cast<std::size_t>(index)].time, " s ");
}

// Why the derivative through an event cannot be trusted; empty, and made of nothing, where it can.
std::string doubtOf(const Event& event, double tilt) {
  if (event.mode == ImpactMode::joint) return "joins several contacts: the derivative is that of the joint law";
  if (event.margins.grazing < kReliableMargin)
    return textOf(6, "is nearly grazing (margin ", event.margins.grazing, ")");
  if (event.margins.stick_slip < kReliableMargin)
    return textOf(6, "is at the boundary of stick and slide (margin ", event.margins.stick_slip,
                  "): one-sided derivative");
  if (tilt < kReliableTilt)
    return textOf(6, "has a normal near the direction in which tilt axes are undefined (margin ", tilt, ")");
  return {};
}

bool beginsToSlip(const Arc& arc) {
  const ConstrainedPath* constrained = arc.trajectory().constrained();
  if (!constrained) return arc.closedForm() && arc.closedForm()->inputs.begins;
  return std::ranges::any_of(constrained->contacts(), [](const PersistentContact& c) { return c.begins; });
}

bool beginsToSlip(const GroupPath& path, std::size_t slot) {
  const auto member = static_cast<int>(slot);
  return std::ranges::any_of(path.contacts(), [&](const GroupContact& c) { return c.begins && (c.member_a == member || c.member_b == member); });
}

std::string nearly(const Motion& motion, const PathNearMiss& miss, int a, int b) {
  const auto name = [&](int body) { return "'" + motion.scene->bodies[static_cast<std::size_t>(body)].name + "'"; };
  return textOf(6, "at t = ", miss.time, " s the contact of ", name(a), " with ", name(b), " nearly ", nameOf(miss.guard.cause), " (margin ", miss.margin, ")");
}

}  // namespace

DerivativeTape::DerivativeTape(const Motion& motion, std::function<void()> look)
    : motion_(motion), look_(std::move(look)), events_(motion.events.size()) {
  if (!motion.has_events)
    throw InputError("found a motion whose events were not recorded, expected one with them: derivatives need them");
  for (const WorldLine& line : motion.world_lines) arcs_.emplace_back(line.arcs.size());
}

DerivativeTape::~DerivativeTape() = default;

ArcSensitivity DerivativeTape::sensitivity(int body, int k, double t) {
  const auto b = static_cast<std::size_t>(body);
  const BodyPlan& plan = motion_.plan.bodies[b];
  const Arc& arc = motion_.world_lines[b].arcs[static_cast<std::size_t>(k)];
  if (auto trajectory = arc.trajectory().linearise(motion_, body, k, t)) return {{}, std::move(trajectory), nullptr};
  if (arc.isFlight()) return {arc.rotationSensitivity(t, plan.derivative_tier, plan.derivative_products), nullptr, nullptr};
  const auto [found, is_new] = shared_.try_emplace({&arc.trajectory(), t});
  if (is_new) found->second = arc.trajectory().lineariseShared(motion_, t);
  return {{}, nullptr, found->second};
}

const ArcSensitivity& DerivativeTape::arc(int body, int k) {
  const std::size_t b = checkedIndex("DerivativeTape::arc", "body", body, arcs_.size());
  const WorldLine& line = motion_.world_lines[b];
  const std::size_t kk = checkedIndex("DerivativeTape::arc", "an arc that ends in an event,", k, line.events.size());
  auto& slot = arcs_[b][kk];
  if (look_) look_();
  if (!slot) {
    slot = std::make_unique<ArcSensitivity>(
        sensitivity(body, k, motion_.events[static_cast<std::size_t>(line.events[kk])].time));
  }
  return *slot;
}

const ArcSensitivity& DerivativeTape::until(const Participant& p, double time) {
  if (!p.stays) return arc(p.body, p.arc);
  arcUntil(p.body, p.arc, time);
  return until_.at({p.body, p.arc, time});
}

ArcSensitivity DerivativeTape::arcUntil(int body, int k, double t) {
  const std::size_t b = checkedIndex("DerivativeTape::arcUntil", "body", body, arcs_.size());
  checkedIndex("DerivativeTape::arcUntil", "arc", k, arcs_[b].size());
  checkTime("DerivativeTape::arcUntil", motion_, t);
  const auto found = until_.find({body, k, t});
  if (look_) look_();
  if (found != until_.end()) return found->second;
  if (until_.size() == kRemembered) until_.clear(), shared_.clear();
  return until_[{body, k, t}] = sensitivity(body, k, t);
}

const SingleImpact* DerivativeTape::singleImpact(int event) {
  const std::size_t e = checkedIndex("DerivativeTape::singleImpact", "event", event, motion_.events.size());
  if (!SingleImpact::is(motion_.events[e])) return nullptr;
  if (look_) look_();
  if (single_impacts_.empty()) {
    single_impacts_.resize(motion_.events.size());
    for (std::size_t b = 0; b < arcs_.size(); ++b)
      materials_.push_back(materialIndexOf(*motion_.scene, static_cast<int>(b)));
  }
  auto& slot = single_impacts_[e];
  if (!slot) slot = std::make_unique<SingleImpact>(motion_, motion_.events[e], materials_);
  return slot.get();
}

const EventLinearization& DerivativeTape::event(int event) {
  auto& slot = events_[checkedIndex("DerivativeTape::event", "event", event, events_.size())];
  if (look_) look_();
  if (!slot) {
    slot = std::make_unique<EventLinearization>(motion_, event);
  }
  return *slot;
}

void Reliability::pass(const Motion& motion, int index) {
  const Event& event = motion.events[checkedIndex("Reliability::pass", "event", index, motion.events.size())];
  ++events;
  passSeams(motion, index);
  if (reliable && landsFlat(motion, event)) {
    reliable = false, smallest_margin = 0;
    message = sentenceOf(motion, index) + "is that of a rim that comes to lie flat: the derivative holds for motions that do so as well; "
                                          "beside them the rim goes round";
  }
  if (!event.counts()) return;
  const double tilt = tiltMarginOf(event);
  smallest_margin = std::min({smallest_margin, event.margins.smallest(), tilt});
  if (!reliable) return;
  const std::string doubt = doubtOf(event, tilt);
  if (doubt.empty()) return;
  reliable = false;
  message = sentenceOf(motion, index) + doubt;
}

void Reliability::passSeams(const Motion& motion, int index) {
  const Event& event = motion.events[static_cast<std::size_t>(index)];
  for (const int body : flushBodiesOf(motion, event)) {
    if (std::find(seams.begin(), seams.end(), body) != seams.end()) continue;
    seams.push_back(body);
    if (seam_message.empty())
      seam_message = textOf(6, "at t = ", event.time, " s a contact with '", motion.scene->bodies[static_cast<std::size_t>(body)].name,
                            "' is at a seam between flush fixed bodies: moving one of them alone makes it a step");
  }
}

void Reliability::passFriction(const Motion& motion, int index, double margin, bool shared) {
  if (!shared && !(margin < kReliableMargin)) return;
  const Event& event = motion.events[checkedIndex("Reliability::passFriction", "event", index, motion.events.size())];
  const Scene& scene = *motion.scene;
  for (const Contact& c : event.contacts) {
    if (c.pair.friction != 0) continue;
    const Body &a = scene.bodies[static_cast<std::size_t>(c.a)], &b = scene.bodies[static_cast<std::size_t>(c.b)];
    const Rule<double> friction = rulesOf(materialOf(scene, a), materialOf(scene, b)).friction;
    for (const auto& [body, by] : {std::pair(c.a, friction.by_a), std::pair(c.b, friction.by_b)}) {
      const int material = materialIndexOf(scene, body);
      if (material < 0 || by == 0) continue;
      if (std::find(frictions.begin(), frictions.end(), material) == frictions.end()) frictions.push_back(material);
    }
  }
  if (frictions.empty() || !friction_message.empty()) return;
  friction_message = sentenceOf(motion, index);
  if (shared) {
    friction_message += "is without friction at redundant contacts, whose load the least friction selects: there is no "
                        "derivative with respect to friction at 0";
    return;
  }
  friction_message += textOf(6, "is without friction and does not slip (margin ", margin,
                             "): the derivative with respect to its friction is one-sided, and jumps there");
}

void Reliability::passArc(const Motion& motion, int body, int k) {
  const std::size_t b = checkedIndex("Reliability::passArc", "body", body, motion.world_lines.size());
  const std::vector<Arc>& arcs = motion.world_lines[b].arcs;
  const Arc& arc = arcs[checkedIndex("Reliability::passArc", "arc", k, arcs.size())];
  const double until = &arc == &arcs.back() ? motion.end : (&arc + 1)->start();
  if (arc.trajectory().constrained()) passConstrained(motion, body, arc, until);
  if (const GroupPath* group = arc.trajectory().group()) passGroup(motion, *group, until);
  if (beginsToSlip(arc)) passBeginning(motion, body, k);
  passStill(motion, body, arc);
  if (arc.trajectory().isLoose()) passLoose(motion, body, k);
}

namespace {

// Of the derivative with respect to the velocity and spin with which the scene places a body.
void doubtStart(Reliability& reliability, int body, const std::string& why) {
  if (std::find(reliability.beginning.begin(), reliability.beginning.end(), body) != reliability.beginning.end()) return;
  reliability.beginning.push_back(body);
  if (reliability.beginning_message.empty()) reliability.beginning_message = why;
}

// What several bodies carry goes with them as long as they move alike.
void doubtSeveral(Reliability& reliability, const Motion& motion, int body, const RidePath& ride) {
  const std::vector<Body>& bodies = motion.scene->bodies;
  for (const Carrier::Part& part : ride.carrier().parts) {
    const std::string why = "'" + bodies[static_cast<std::size_t>(body)].name + "' rests on '" + bodies[static_cast<std::size_t>(part.body)].name +
                            "' and on others that move alike: the derivative with respect to the velocity of one of them is not known there";
    if (part.support.moves()) doubtStart(reliability, part.body, why);
    if (!part.support.has_belt || std::find(reliability.surfaces.begin(), reliability.surfaces.end(), part.body) != reliability.surfaces.end()) continue;
    reliability.surfaces.push_back(part.body);
    if (reliability.surface_message.empty()) reliability.surface_message = why;
  }
}

}  // namespace

// On a kinematic body at rest paths are those on fixed ground: they have no derivative by its velocities.
void Reliability::passStill(const Motion& motion, int body, const Arc& arc) {
  const std::vector<Body>& bodies = motion.scene->bodies;
  const auto stays = [&](int with, bool stands, bool surface_stands) {
    const Body& ground = bodies[static_cast<std::size_t>(with)];
    const std::string what = "'" + bodies[static_cast<std::size_t>(body)].name + "' stays in contact with '" + ground.name + "', ";
    if (surface_stands && ground.immovable() && std::find(surfaces.begin(), surfaces.end(), with) == surfaces.end()) {
      surfaces.push_back(with);
      if (surface_message.empty())
        surface_message = what + "whose surface does not move: the derivative with respect to its velocity is not known there";
    }
    if (stands && ground.kinematic)
      doubtStart(*this, with, what + "a kinematic body at rest: the derivative with respect to its velocities is not known there");
  };
  if (const ConstrainedPath* path = arc.trajectory().constrained()) {
    for (std::size_t k = 0; k < path->contacts().size(); ++k)
      stays(path->contacts()[k].with, !path->scene().with[k].moves(), !path->scene().with[k].has_belt);
  } else if (const GroupPath* group = arc.trajectory().group()) {
    for (std::size_t c = 0; c < group->contacts().size(); ++c)
      for (const auto& [member, with] : {std::pair(group->contacts()[c].member_a, group->contacts()[c].a), std::pair(group->contacts()[c].member_b, group->contacts()[c].b)})
        if (member < 0) stays(with, !group->scene().with[c].moves(), !group->scene().with[c].has_belt);
  } else if (arc.closedForm()) {
    stays(arc.closedForm()->face, true, true);
  } else if (const RidePath* ride = arc.trajectory().ride()) {
    const std::vector<Carrier::Part>& parts = ride->carrier().parts;
    for (const Carrier::Part& part : parts) stays(part.body, !part.support.moves(), !part.support.has_belt);
    if (parts.size() > 1) doubtSeveral(*this, motion, body, *ride);
  }
}

// Where it came to rest, what varies has moved it. Where it was put there, nothing does but by its own velocity and spin.
void Reliability::passLoose(const Motion& motion, int body, int k) {
  const std::size_t b = static_cast<std::size_t>(body);
  const std::string rests = "'" + motion.scene->bodies[b].name + "' rests on contacts that do not hold it against every motion";
  if (k == 0 || motion.events[static_cast<std::size_t>(motion.world_lines[b].events[static_cast<std::size_t>(k) - 1])].kind == EventKind::placed) {
    return doubtStart(*this, body, rests + ": by its velocity and spin it would not stay");
  }
  smallest_margin = 0;
  if (!reliable) return;
  reliable = false;
  message = textOf(6, "from t = ", motion.world_lines[b].arcs[static_cast<std::size_t>(k)].start(), " s on ", rests, ": a little change would not let it stay");
}

// What has no slip goes on along the slope. There is a derivative only as long as it has none, whatever varies: after an
// impact that sticks, or where it stuck before.
void Reliability::passBeginning(const Motion& motion, int body, int k) {
  const std::size_t b = static_cast<std::size_t>(body);
  const int index = motion.world_lines[b].events[static_cast<std::size_t>(k) - 1];
  const Event& event = motion.events[static_cast<std::size_t>(index)];
  if (event.kind == EventKind::transition) return;
  const std::string& name = motion.scene->bodies[b].name;
  if (event.kind == EventKind::placed) {
    return doubtStart(*this, body, "'" + name + "' starts to slip from zero slip: the derivative with respect to its velocity and spin is one-sided");
  }
  if (event.mode == ImpactMode::joint) return;  // says so itself
  if (!reliable || (event.mode == ImpactMode::stick && event.contacts[0].pair.tangential_elasticity == 0)) return;
  reliable = false, smallest_margin = 0;
  message = sentenceOf(motion, index) + "leaves '" + name + "' no slip, though it does not stick: one-sided derivative";
}

void Reliability::passConstrained(const Motion& motion, int body, const Arc& arc, double until) {
  const ConstrainedPath& path = *arc.trajectory().constrained();
  const PathNearMiss miss = path.nearestMiss(until);
  passNearMiss(motion, miss, body, path.contacts().empty() ? body : path.contacts()[static_cast<std::size_t>(std::max(0, miss.guard.contact))].with);
}

// Of all bodies that share the path: the derivative goes back to what each of them starts from.
void Reliability::passGroup(const Motion& motion, const GroupPath& path, double until) {
  const PathNearMiss miss = path.nearestMiss(until);
  const GroupContact& at = path.contacts()[static_cast<std::size_t>(std::max(0, miss.guard.contact))];
  passNearMiss(motion, miss, at.a, at.b);
  const std::vector<SharedLinearization::Member> members = path.membersIn(motion);
  for (std::size_t slot = 0; slot < members.size(); ++slot)
    if (beginsToSlip(path, slot)) passBeginning(motion, members[slot].body, members[slot].arc);
}

void Reliability::passNearMiss(const Motion& motion, const PathNearMiss& miss, int a, int b) {
  smallest_margin = std::min(smallest_margin, miss.margin);
  if (!reliable || !(miss.margin < kReliableMargin)) return;
  reliable = false;
  message = nearly(motion, miss, a, b);
}

namespace {

void doubt(Reliability& reliability, const std::vector<int>& doubtful, int asked, const std::string& why) {
  if (std::find(doubtful.begin(), doubtful.end(), asked) == doubtful.end()) return;
  reliability.smallest_margin = 0;
  if (!reliability.reliable) return;
  reliability.reliable = false;
  reliability.message = why;
}

}  // namespace

void Reliability::askFriction(int material) { doubt(*this, frictions, material, friction_message); }
void Reliability::askSurface(int body) { doubt(*this, surfaces, body, surface_message); }
void Reliability::askVelocity(int body) { doubt(*this, beginning, body, beginning_message); }
void Reliability::askPlace(int body) { doubt(*this, seams, body, seam_message); }

}  // namespace carom
