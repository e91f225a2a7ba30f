// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/refuse.hpp"
#include "adjoint/impact/impact.hpp"
#include "adjoint/simulate/simulator.hpp"

// Where a motion begins.

namespace carom::adjoint_detail {
namespace {

double checkedBounce(double lowest) {
  if (!(lowest >= 0 && lowest <= 1e9)) refuseNumber("simulate", "lowest bounce", lowest, "a height from 0 to 1e9 m");
  return lowest;
}

}  // namespace

Simulator::Simulator(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options,
                     const Attempts& before)
    : scene_(scene), contacts_(contacts), impact_limit_(options.impact_limit), steps_before_(before.steps),
      stop_when_(options.stop_when), least_duration_(options.least_duration),
      groups_(options.groups), refuse_overlaps_(options.refuse_overlaps), work_(options.step_limit, options.stop, options.progress),
      builder_(scene, duration), motion_(builder_.motion),
      scales_(scene, *motion_.models), queue_(scene.bodies.size()) {
  contacts_.countIn(&work_);
  const std::size_t n = scene.bodies.size();
  motion_.plan = makePlan(scene, options.asked);
  motion_.has_events = options.record_events;
  motion_.lowest_bounce =
      options.lowest_bounce ? checkedBounce(*options.lowest_bounce) : scales_.leastHeight();
  groups_ = groups_ && contactsLast();
  arc_.assign(n, nullptr);
  version_.assign(n, 0);
  impacts_.assign(n, 0);
  in_draft_.assign(n, -1);
  for (const Body& body : scene.bodies)
    simple_.push_back(std::holds_alternative<Sphere>(body.shape) || std::holds_alternative<Plane>(body.shape));
  next_impacts_.resize(n);
  contact_states_.resize(n);
  for (std::size_t i = 0; i < scene.tilts.size(); ++i)
    tilts_.try_emplace({bodyIndex(scene, scene.tilts[i].body), scene.tilts[i].impact}, static_cast<int>(i));
  builder_.give(options.given);
  if (options.baseline && options.given.empty()) reused_ = ReusedBodies(*options.baseline, motion_, duration, before.met);
  motion_.taken_over = reused_.count();
}

// False where a contact at the start is beyond what is known of.
bool Simulator::start() {
  const int n = static_cast<int>(scene_.bodies.size());
  builder_.start();
  setSpeedsOfContact();
  for (int b = 0; b < n; ++b) arc_[index(b)] = &motion_.world_lines[index(b)].arcs.back();
  startReused();
  contacts_.begin(scene_);
  motion_.geometry = contacts_.geometry();
  startOverlaps();
  for (const StartOverlap& overlap : motion_.overlaps)
    if (invalidatesReuse(overlap.a) || invalidatesReuse(overlap.b)) return false;
  for (int b = 0; b < n; ++b) {
    requireFlight(b, arcOf(b));
    contacts_.setPath(b, arcOf(b), 0, motion_.duration);
  }
  if (!placeAtStart()) return false;
  for (int b = 0; b < n; ++b)
    if (arcOf(b).moving()) predictBody(b, 0);
  return true;
}

// The first arcs of known bodies, of which more is worked out than of new ones.
void Simulator::startReused() {
  for (int body = 0; body < static_cast<int>(scene_.bodies.size()); ++body)
    if (reused_.has(body)) arcOf(body) = takenArcOf(body);
}

// Bodies that the scene starts in contact: those that neither part nor approach go on from an event of their own, those that
// lie on each other from one that they share.
bool Simulator::placeAtStart() {
  if (!contactsLast()) return true;
  const std::vector<PlacedContact> placed = contacts_.placed();
  std::vector<char> is_placed(scene_.bodies.size());
  for (auto& [bodies, contacts] : placedParts(placed)) {
    if (std::ranges::all_of(bodies, [&](int body) { return reused_.has(body); })) continue;
    for (int body : bodies) {
      if (invalidatesReuse(body)) return false;
      is_placed[index(body)] = true;
    }
    if (!placeBodies(bodies, std::move(contacts))) return false;
  }
  std::vector<std::vector<const PlacedContact*>> on_given(scene_.bodies.size());
  for (const PlacedContact& p : placed)
    if (isMoved(p.a) != isMoved(p.b) && !overlapOf(p.a, p.b)) on_given[index(isMoved(p.a) ? p.a : p.b)].push_back(&p);
  for (int body = 0; body < static_cast<int>(scene_.bodies.size()); ++body) {
    if (!isMoved(body) || reused_.has(body) || is_placed[index(body)]) continue;
    beginDraft(0);
    std::vector<Contact> contacts, touching;
    for (const PlacedContact* p : on_given[index(body)])
      for (const FeaturePair& f : p->features) {
        Contact c = makeContact(0, p->a, p->b, f);
        const double alpha = accelerationOf(c);
        touching.push_back(c);
        if (alpha < 0 && c.approach * c.approach < -2 * motion_.lowest_bounce * alpha) contacts.push_back(std::move(c));
      }
    if (!contacts.empty() && !placeBodies({body}, std::move(contacts), std::move(touching))) return false;
  }
  return true;
}

// False where these contacts last in a way that is beyond what is known of.
bool Simulator::placeBodies(const std::vector<int>& bodies, std::vector<Contact> contacts, std::vector<Contact> touching) {
  Event& event = draft_.event;
  beginDraft(0);
  draft_.touching = std::move(touching);
  event.kind = EventKind::placed;
  event.contacts = std::move(contacts);
  for (Contact& c : event.contacts) {
    c.counted = false;
    c.kept = true;
    c.pair.elasticity = c.pair.friction = 0;
  }
  dropDoubles();
  solvePlaced(bodies);
  if (draft_.beyond.empty()) return true;
  finish(MotionStatus::unresolved_contact, 0, draft_.beyond);
  return false;
}

// Velocities along the normals, which are 0 but for rounding, are 0.
void Simulator::solvePlaced(const std::vector<int>& bodies) {
  Event& event = draft_.event;
  bodies_ = bodies;
  for (int body : bodies_)
    event.participants.push_back({body, static_cast<int>(motion_.world_lines[index(body)].arcs.size()) - 1, 0,
                                  snapshots_[snapshot(body, 0)].state, false});
  addCarriers();
  try {
    solveImpact(event, *motion_.models, draft_.after);
  } catch (const NotComputable& error) {
    giveUp("contact", event.contacts[0].a, event.contacts[0].b, 0, error);
  }
  chooseArcs();
  for (std::size_t i = 0; i < bodies_.size(); ++i) setPath(bodies_[i], draft_.arcs[i], 0);
  draft_.next_impacts.assign(bodies_.size(), {});
  commit();
}

}  // namespace carom::adjoint_detail
