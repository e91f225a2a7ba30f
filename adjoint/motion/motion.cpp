// SPDX-License-Identifier: MIT
#include "adjoint/motion/motion.h"

#include <algorithm>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/base/names.hpp"
#include "adjoint/motion/event_features.hpp"
#include "adjoint/motion/time_argument.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(EventKind kind) { return nameIn({"impact", "capture", "transition", "placed"}, kind); }


const char* nameOf(ImpactMode mode) { return nameIn({"frictionless", "stick", "slide", "joint"}, mode); }

const char* nameOf(MotionStatus status) {
  return nameIn({"complete", "impact_limit", "cascade", "unresolved_impact", "unresolved_contact", "not_computable", "step_limit", "stopped"},
                status);
}

std::shared_ptr<const BodyModel> Motion::modelOf(int body) const {
  const std::size_t b = checkedIndex("Motion::modelOf", "body", body, models->size());
  return {models, &(*models)[b]};
}

const Participant* Event::find(int body) const {
  const auto p = std::ranges::find(participants, body, &Participant::body);
  return p == participants.end() ? nullptr : &*p;
}

bool Event::touches(int body, int with) const {
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const Contact& c) { return (c.a == body && c.b == with) || (c.a == with && c.b == body); });
}

bool Event::meets(int body, int with) const {
  return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return c.counted && !c.held && ((c.a == body && c.b == with) || (c.a == with && c.b == body));
  });
}

bool Event::counts() const { return std::ranges::any_of(participants, [](const Participant& p) { return p.impact > 0; }); }
bool Event::tooLow() const { return kind == EventKind::impact && !counts(); }

BodyState toBodyState(const BodyModel& model, const State& s) {
  BodyState out;
  out.position = s.x;
  out.orientation = model.has_offset ? Quat(s.q * Quat(model.R_BG)).normalized() : s.q;
  out.velocity = s.v;
  if (model.moving) {
    const Mat3 R = s.q.toRotationMatrix();
    out.position -= model.shapeToWorld(R) * model.center;
    out.angular_velocity = R * model.inverse_inertia.cwiseProduct(R.transpose() * s.L);
  }
  return out;
}

int Motion::arcAt(int body, double t) const {
  const auto& arcs = world_lines[checkedIndex("arcAt", "body", body, world_lines.size())].arcs;
  checkedNumber("arcAt", "the time", t);
  const auto next = std::upper_bound(arcs.begin(), arcs.end(), t, [](double x, const Arc& a) { return x < a.start(); });
  return std::max(0, static_cast<int>(next - arcs.begin()) - 1);
}

BodyState Motion::stateAt(const std::string& body, double t) const { return stateAt(bodyIndex(*scene, body), t); }

BodyState Motion::stateAt(int body, double t) const {
  const std::size_t b = checkedIndex("stateAt", "body", body, world_lines.size());
  checkTime("stateAt", *this, t);
  const Arc& arc = world_lines[b].arcs[static_cast<std::size_t>(arcAt(body, t))];
  return toBodyState((*models)[b], arc.stateAt(t));
}

BodyState Motion::stateBefore(int event, int body) const {
  const std::size_t b = checkedIndex("stateBefore", "body", body, world_lines.size());
  const Event& e = events[checkedIndex("stateBefore", "event", event, events.size())];
  const Participant* p = e.find(body);
  if (!p) return stateAt(body, e.time);
  return toBodyState((*models)[b], p->before);
}

BodyState Motion::stateAfter(int event, int body) const {
  const std::size_t b = checkedIndex("stateAfter", "body", body, world_lines.size());
  const Event& e = events[checkedIndex("stateAfter", "event", event, events.size())];
  const Participant* p = e.find(body);
  if (!p) return stateAt(body, e.time);
  return toBodyState((*models)[b], world_lines[b].arcs[static_cast<std::size_t>(p->next())].startState());
}

std::optional<int> Motion::findImpact(int body, int n, int with) const {
  if (!has_events) throw InputError("found a motion whose events were not recorded, expected one with them");
  const std::size_t b = checkedIndex("findImpact", "body", body, world_lines.size());
  if (with != -1) checkedIndex("findImpact", "the other body", with, world_lines.size());
  if (n < 1) refuseNumber("findImpact", "impact", n, "1 (the first) or more");
  int count = 0;
  for (int e : world_lines[b].events) {
    const Event& event = events[static_cast<std::size_t>(e)];
    if (event.find(body)->impact == 0 || (with >= 0 && !event.meets(body, with))) continue;
    if (++count == n) return e;
  }
  return std::nullopt;
}

std::vector<std::array<int, 6>> adjoint_detail::sortedFeatures(const Event& event) {
  std::vector<std::array<int, 6>> features;
  for (const Contact& c : event.contacts)
    features.push_back({c.a, c.b, c.features.kind, c.features.a, c.features.b, c.features.sign});
  std::sort(features.begin(), features.end());
  return features;
}

std::string Motion::signature(std::size_t count) const {
  std::string text;
  for (std::size_t i = 0; i < std::min(count, events.size()); ++i) {
    const Event& event = events[i];
    if (event.tooLow()) continue;
    for (const std::array<int, 6>& features : sortedFeatures(event))
      for (int part : features) text += std::to_string(part) + ",";
    text += nameOf(branchOf(event.mode));
    if (event.kind != EventKind::impact) text += nameOf(event.kind);
    text += ';';
  }
  return text;
}

}  // namespace carom
