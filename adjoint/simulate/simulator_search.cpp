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
void Simulator::search(int body, double from, Outlook& outlook) {
  const bool known = known_.has(body);
  if (pathOf(body).integrated() && !known) followHeld(body, from);
  double until = std::min({contacts_.window(body, from), motion_.duration, onwardOf(body).transition});
  if (pathOf(body).integrated()) until = std::min(until, pathOf(body).knownUntil());
  contacts_.neighbours(body, neighbours_);
  if (known) {  // of those that are known, and of what stands still, the known motion tells
    until = std::min(until, known_.nextTimeOf(body));
    std::erase_if(neighbours_, [&](int other) { return known_.has(other) || !arcOf(other).moving(); });
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
  outlook.first = {};
  outlook.of_instant.clear();
  outlook.horizon = until;
  if (found_.size() == begin) return;
  const auto first = std::min_element(found_.begin() + static_cast<std::ptrdiff_t>(begin), found_.end());
  outlook.first = *first;
  const double limit = first->time + (found_.size() > begin + 1 ? scaleOf(first->a, first->b, first->time).instant() : 0);
  for (std::size_t i = begin; i < found_.size(); ++i)
    if (found_[i].time <= limit && &found_[i] != &*first) outlook.of_instant.push_back(found_[i]);
}

// Bounds of an integrated path hold as far as it is known.
void Simulator::setPath(int body, const Arc& arc, double from) {
  contacts_.setPath(body, arc, from, std::min(motion_.duration, arc.knownUntil()));
}

// An integrated path is followed a step further where the search has come to the end of what is known. A search may
// have followed it by itself, to find a root.
void Simulator::followHeld(int body, double from) {
  if (in_draft_[index(body)] >= 0) return;
  Arc& arc = pathOf(body);
  if (!arc.integrated()->ended() && !(from < arc.knownUntil())) {
    work_.step(kHeldStep);
    try {
      arc.extendTo(std::nextafter(arc.knownUntil(), kInfinity));
    } catch (const NotComputable& error) {
      const Contact& c = onward_[index(body)].held.front();
      giveUp("contact", c.a, c.b, from, error);
    }
  }
  Onward& onward = onward_[index(body)];
  if (onward.steps == arc.series()) return;
  onward.steps = arc.series();
  onward.why = heldTransition(arc, arc.start());
  if (onward.why.cause != TransitionCause::none) onward.transition = arc.knownUntil();
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
  const std::size_t before = workIn(arc_a) + workIn(arc_b);
  std::optional<PredictedImpact> impact;
  if (arc_a.path() || arc_b.path()) {
    const auto stays = [](const Arc& arc) { return !arc.moving() || arc.kind() == ArcKind::rest; };
    if (stays(arc_a) && stays(arc_b)) return std::nullopt;
    impact = besideHeld(a, b, from, until);
  } else {
    impact = contacts_.firstImpact(a, b, arc_a, arc_b, from, until);
  }
  work_.step(1 + workIn(arc_a) + workIn(arc_b) - before);
  return impact;
}

void Simulator::enter(int body, Outlook& outlook) {
  const bool impact = outlook.first.a >= 0;
  const bool over = !impact && !(outlook.horizon < motion_.duration);
  queue_.set(body, impact ? outlook.first.time : over ? EventQueue::kNever : outlook.horizon, !impact);
  std::swap(outlook_[index(body)], outlook);
}

void Simulator::predictBody(int body, double from) {
  found_.clear();
  draft_.outlooks.resize(1);
  search(body, from, draft_.outlooks[0]);
  enter(body, draft_.outlooks[0]);
}

// The same for the participants of the draft, on their arcs after the event.
void Simulator::predictDraft() {
  const Event& event = draft_.event;
  for (std::size_t i = 0; i < draft_.arcs.size(); ++i)
    setPath(event.participants[i].body, draft_.arcs[i], event.time);
  found_.clear();
  draft_.outlooks.resize(draft_.arcs.size());
  for (std::size_t i = 0; i < draft_.arcs.size(); ++i)
    search(event.participants[i].body, event.time, draft_.outlooks[i]);
}

// The earliest impact whose arcs are in force.
bool Simulator::takeNext(Prediction& next) {
  for (;;) {
    const double known = known_.nextTime(), time = std::min(known, queue_.time());
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
    const Prediction& first = outlook_[index(body)].first;
    if (first.a >= 0 && holds(first)) {
      next = first;
      return true;
    }
    if (const double due = onward_[index(body)].transition; first.a < 0 && !(queue_.time() < due)) {
      next = {due, body, body, -1, 0, {}};
      return true;
    }
    if (++searches_ > kMostSearches)
      throw NotComputable(textOf(6, "'", scene_.bodies[index(body)].name, "' flies so fast at t = ", now_,
                                 " s that its neighbours cannot be kept: more than ", kMostSearches,
                                 " searches without an impact"));
    predictBody(body, queue_.time());
  }
}

}  // namespace carom::adjoint_detail
