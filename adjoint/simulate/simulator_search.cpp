// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "adjoint/simulate/simulator.hpp"

// Who will meet whom next: searches of one body's future against its neighbours.

namespace carom::adjoint_detail {

// First impacts of one body with whoever may be near, each searched no further than the earliest one found: nothing of
// the body's arc beyond that will happen, unless the other body is struck before. In that case the search goes on when
// that time is reached with the arc still in force. Adds everything found to found_.
void Simulator::search(int body, double from, NextImpact& next_impact) {
  const bool known = reused_.has(body);
  if (pathOf(body).isIntegrated() && !known) followConstrained(body, from);
  double until = std::min({contacts_.window(body, from), motion_.duration, contactStateOf(body).transition});
  if (pathOf(body).isIntegrated()) until = std::min(until, pathOf(body).knownUntil());
  contacts_.neighbours(body, neighbours_);
  if (known) {  // of those that are known, and of what stands still, the known motion tells
    until = std::min(until, reused_.nextTimeOf(body));
    std::erase_if(neighbours_, [&](int other) { return reused_.has(other) || !arcOf(other).moving(); });
  }
  const std::size_t begin = found_.size();
  for (int other : neighbours_) {
    const bool is_first = body < other;
    std::optional<PredictedImpact> impact;
    try {
      impact = firstImpact(std::min(body, other), std::max(body, other), from, until);
    } catch (const NotComputable& error) {
      giveUp("approach", body, other, from, error);
    }
    if (!impact) continue;
    if (!std::isfinite(impact->time))
      giveUp("approach", body, other, from, NotComputable("the time at which they meet is beyond the range of doubles"));
    until = std::min(until, std::max(impact->time, from) + scaleOf(body, other, impact->time).instant());
    if (impact->features == kSearchedSoFar) continue;
    const int version = version_[index(other)] + (in_draft_[index(other)] >= 0 && isMoved(other) ? 1 : 0);
    found_.push_back({impact->time, body, is_first ? body : other, is_first ? other : body, version, impact->features});
  }
  next_impact.first = {};
  next_impact.of_instant.clear();
  next_impact.horizon = until;
  if (found_.size() == begin) return;
  const auto first = std::min_element(found_.begin() + static_cast<std::ptrdiff_t>(begin), found_.end());
  next_impact.first = *first;
  const double limit = first->time + (found_.size() > begin + 1 ? scaleOf(first->a, first->b, first->time).instant() : 0);
  for (std::size_t i = begin; i < found_.size(); ++i)
    if (found_[i].time <= limit && &found_[i] != &*first) next_impact.of_instant.push_back(found_[i]);
}

// Bounds of an integrated path hold as far as it is known.
void Simulator::setPath(int body, const Arc& arc, double from) {
  contacts_.setPath(body, arc, from, std::min(motion_.duration, arc.knownUntil()));
}

// An integrated path is followed a step further where the search has come to the end of what is known. A search may
// have followed it by itself, to find a root.
void Simulator::followConstrained(int body, double from) {
  if (in_draft_[index(body)] >= 0) return;
  Arc& arc = pathOf(body);
  if (std::isfinite(arc.availableUntil()) && !(from < arc.knownUntil())) {
    const GroupPath* group = arc.trajectory().group();
    work_.step(group ? group->workOfStep() : kConstrainedStep);
    try {
      arc.extendTo(std::nextafter(arc.knownUntil(), kInfinity));
    } catch (const NotComputable& error) {
      const Contact& c = contact_states_[index(body)].held.front();
      giveUp("contact", c.a, c.b, from, error);
    }
  }
  if (arc.trajectory().group()) return refreshGroup(body);
  BodyContactState& contact_state = contact_states_[index(body)];
  if (contact_state.steps == arc.series()) return;
  contact_state.steps = arc.series();
  contact_state.why = constrainedTransition(arc, arc.start());
  if (contact_state.why.cause != TransitionCause::none) contact_state.transition = arc.knownUntil();
  setPath(body, arc, from);
}

// Of bodies a < b; those that overlap from the start have to part first.
std::optional<PredictedImpact> Simulator::firstImpact(int a, int b, double from, double until) {
  Arc &arc_a = pathOf(a), &arc_b = pathOf(b);
  until = std::min({until, arc_a.knownUntil(), arc_b.knownUntil()});
  if (!(from <= until)) return std::nullopt;
  if (StartOverlap* overlap = overlapOf(a, b)) {
    const std::optional<double> parted = partingOf(*overlap, from, until);
    if (!parted) return std::nullopt;
    from = std::max(from, *parted);
  }
  refreshGroup(a), refreshGroup(b);
  const std::size_t before = workIn(arc_a) + workIn(arc_b);
  std::optional<PredictedImpact> impact;
  if (arc_a.inContact() || arc_b.inContact()) {
    if (goTogether(a, b)) return std::nullopt;
    impact = besideConstrained(a, b, from, until);
  } else {
    impact = contacts_.firstImpact(a, b, arc_a, arc_b, from, until);
  }
  work_.step(1 + workIn(arc_a) + workIn(arc_b) - before);
  return impact;
}

void Simulator::enter(int body, NextImpact& next_impact) {
  const bool impact = next_impact.first.a >= 0;
  const bool over = !impact && !(next_impact.horizon < motion_.duration);
  queue_.set(body, impact ? next_impact.first.time : over ? EventQueue::kNever : next_impact.horizon, !impact);
  std::swap(next_impacts_[index(body)], next_impact);
}

void Simulator::predictBody(int body, double from) {
  found_.clear();
  draft_.next_impacts.resize(1);
  search(body, from, draft_.next_impacts[0]);
  enter(body, draft_.next_impacts[0]);
}

// The same for the participants of the draft, on their arcs after the event.
void Simulator::predictDraft() {
  const Event& event = draft_.event;
  for (std::size_t i = 0; i < draft_.arcs.size(); ++i)
    setPath(event.participants[i].body, draft_.arcs[i], event.time);
  found_.clear();
  draft_.next_impacts.resize(draft_.arcs.size());
  for (std::size_t i = 0; i < draft_.arcs.size(); ++i)
    search(event.participants[i].body, event.time, draft_.next_impacts[i]);
}

// The earliest impact whose arcs are in force.
bool Simulator::takeNext(PredictedEvent& next) {
  for (;;) {
    const double known = reused_.nextTime(), time = std::min(known, queue_.time());
    if (time == EventQueue::kNever || time > last_asked_for_) return false;
    if (known <= queue_.time()) {
      next = {};
      next.time = now_ = std::max(now_, known);
      work_.reached(now_, motion_.impacts);
      return true;
    }
    const int body = queue_.body();
    now_ = std::max(now_, queue_.time());
    work_.reached(now_, motion_.impacts);
    work_.step();
    const PredictedEvent& first = next_impacts_[index(body)].first;
    if (first.a >= 0 && holds(first)) {
      next = first;
      return true;
    }
    if (const double due = contact_states_[index(body)].transition; first.a < 0 && !(queue_.time() < due)) {
      next = {due, body, body, -1, 0, {}};
      return true;
    }
    if (++searches_ > kMostSearches)
      throw NotComputable(textOf(6, "'", scene_.bodies[index(body)].name, "' flies so fast at t = ", now_,
                                 " s that its neighbour lists cannot be maintained: more than ", kMostSearches,
                                 " searches without an impact"));
    predictBody(body, queue_.time());
  }
}

}  // namespace carom::adjoint_detail
