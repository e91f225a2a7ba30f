// SPDX-License-Identifier: MIT
#include "editing/sequence_changes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "adjoint/base/names.hpp"
#include "adjoint/impact/law.hpp"
#include "adjoint/motion/event_features.hpp"
#include "editing/detail/messages.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using Kind = SequenceChange::Kind;
using Bodies = std::vector<int>;

/// What it costs to take one impact for another. Two that differ in their features are still rather the same impact
/// than one that went and one that came.
constexpr int kOtherMode = 1;
constexpr int kOtherFeatures = 2;
constexpr int kAlone = 2;

/// Lists whose alignment would take a larger table than this are compared place by place.
constexpr std::size_t kLargestTable = 4'000'000;

/// The impacts of one motion that count, as indices, by the bodies that meet.
struct Sequence {
  const Motion& motion;
  std::size_t held;  ///< so many events can matter to constraints
  std::map<Bodies, std::vector<int>> of;
};

Bodies bodiesOf(const Event& event) {
  Bodies bodies;
  for (const Contact& c : event.contacts)
    if (!c.held) bodies.push_back(c.a), bodies.push_back(c.b);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

Sequence sequenceOf(const Motion& motion, std::size_t count, std::size_t held) {
  Sequence sequence{motion, held, {}};
  for (std::size_t e = 0; e < std::min(count, motion.events.size()); ++e) {
    if (motion.events[e].counts()) sequence.of[bodiesOf(motion.events[e])].push_back(static_cast<int>(e));
  }
  return sequence;
}

const Event& eventOf(const Motion& motion, int index) { return motion.events[static_cast<std::size_t>(index)]; }

bool sameFeatures(const Event& a, const Event& b) { return sortedFeatures(a) == sortedFeatures(b); }

int differenceOf(const Event& a, const Event& b) {
  return (sameFeatures(a, b) ? 0 : kOtherFeatures) + (branchOf(a.mode) == branchOf(b.mode) ? 0 : kOtherMode);
}

/// Places in two lists that belong together; -1 where an impact stands alone.
using Matches = std::vector<std::pair<int, int>>;

/// The cheapest alignment of two lists, by dynamic programming over their beginnings.
Matches align(const Sequence& before, const std::vector<int>& a, const Sequence& after, const std::vector<int>& b) {
  const std::size_t n = a.size(), m = b.size();
  Matches matches;
  if ((n + 1) * (m + 1) > kLargestTable) {
    for (std::size_t i = 0; i < std::max(n, m); ++i)
      matches.push_back({i < n ? static_cast<int>(i) : -1, i < m ? static_cast<int>(i) : -1});
    return matches;
  }
  std::vector<std::vector<int>> cost(n + 1, std::vector<int>(m + 1, 0));
  const auto together = [&](std::size_t i, std::size_t j) {
    return cost[i - 1][j - 1] + differenceOf(eventOf(before.motion, a[i - 1]), eventOf(after.motion, b[j - 1]));
  };
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; j <= m; ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = kAlone * static_cast<int>(i + j);
        continue;
      }
      cost[i][j] = std::min({together(i, j), cost[i - 1][j] + kAlone, cost[i][j - 1] + kAlone});
    }
  }
  for (std::size_t i = n, j = m; i > 0 || j > 0;) {
    // where several alignments cost the same, later impacts come and go rather than earlier ones
    if (i > 0 && cost[i][j] == cost[i - 1][j] + kAlone) {
      matches.push_back({static_cast<int>(--i), -1});
    } else if (j > 0 && cost[i][j] == cost[i][j - 1] + kAlone) {
      matches.push_back({-1, static_cast<int>(--j)});
    } else {
      matches.push_back({static_cast<int>(--i), static_cast<int>(--j)});
    }
  }
  std::reverse(matches.begin(), matches.end());
  return matches;
}

std::string ordinal(int n) {
  const bool teen = n % 100 >= 11 && n % 100 <= 13;
  const char* ending = teen ? "th" : n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
  return std::to_string(n) + ending;
}

std::string namesOf(const Motion& motion, const Bodies& bodies) {
  std::vector<std::string> names;
  for (int b : bodies) names.push_back("'" + motion.scene->bodies[static_cast<std::size_t>(b)].name + "'");
  return listOf(names);
}

std::string featuresOf(const Motion& motion, int index) {
  std::vector<std::string> features;
  for (const Contact& c : eventOf(motion, index).contacts) {
    features.push_back(motion.geometry->describe(c.a, c.b, c.features));
  }
  return listOf(features);
}

std::string timeOf(const Motion& motion, int index) { return brief(eventOf(motion, index).time) + " s"; }

bool isConstrained(const Sequence& sequence, int index) { return static_cast<std::size_t>(index) < sequence.held; }

/// Of one pair of matched impacts; nothing where they are alike.
void compare(const Sequence& before, int e, const Sequence& after, int f, const std::string& impact,
             std::vector<SequenceChange>& changes) {
  const Event &a = eventOf(before.motion, e), &b = eventOf(after.motion, f);
  const bool was_held = isConstrained(before, e), is_held = isConstrained(after, f);
  if (was_held != is_held) {
    const std::string side = is_held ? "before" : "after";
    changes.push_back({Kind::passed, e, f, true,
                       "The " + impact + ", which was at " + briefBeside(a.time, b.time) + " s, now comes " + side +
                           " the last constraint, at " + briefBeside(b.time, a.time) + " s."});
  }
  const bool matters = was_held || is_held;
  if (!sameFeatures(a, b)) {
    changes.push_back(
        {Kind::moved, e, f, matters,
         "The " + impact + ", at " + brief(b.time) + " s, moved from " + featuresOf(before.motion, e) + " to " +
             featuresOf(after.motion, f) + "."});
  } else if (branchOf(a.mode) != branchOf(b.mode)) {
    changes.push_back({Kind::mode, e, f, matters,
                       "The " + impact + ", at " + brief(b.time) + " s, changed from " + nameOf(a.mode) + " to " + nameOf(b.mode) + "."});
  }
}

void compareBodies(const Sequence& before, const Sequence& after, const Bodies& bodies,
                   std::vector<SequenceChange>& changes) {
  const auto listFor = [&](const Sequence& s) {
    const auto at = s.of.find(bodies);
    return at == s.of.end() ? std::vector<int>{} : at->second;
  };
  const std::vector<int> a = listFor(before), b = listFor(after);
  const std::string names = namesOf(before.motion, bodies);
  for (const auto& [i, j] : align(before, a, after, b)) {
    std::string impact = ordinal((j >= 0 ? j : i) + 1) + " impact of " + names;
    if (i >= 0 && j >= 0 && i != j) impact += " (the " + ordinal(i + 1) + " before)";
    if (j < 0) {
      const int e = a[static_cast<std::size_t>(i)];
      changes.push_back(
          {Kind::went, e, -1, isConstrained(before, e),
           "The " + impact + ", which was at " + timeOf(before.motion, e) + ", no longer happens."});
    } else if (i < 0) {
      const int f = b[static_cast<std::size_t>(j)];
      changes.push_back({Kind::came, -1, f, isConstrained(after, f),
                         "The " + impact + ", at " + timeOf(after.motion, f) + ", is new."});
    } else {
      compare(before, a[static_cast<std::size_t>(i)], after, b[static_cast<std::size_t>(j)], impact, changes);
    }
  }
}

// Those that count, or those that begin, change or end a persistent contact.
std::vector<int> eventsOf(const Motion& motion, std::size_t count, bool lasting) {
  std::vector<int> events;
  for (std::size_t e = 0; e < std::min(count, motion.events.size()); ++e)
    if (lasting ? motion.events[e].kind != EventKind::impact : motion.events[e].counts())
      events.push_back(static_cast<int>(e));
  return events;
}

/// The first place at which the same impacts come in another order; nothing where they do not.
std::optional<SequenceChange> otherOrder(const Motion& before, std::size_t count_before, const Motion& after,
                                         std::size_t count_after) {
  const std::vector<int> a = eventsOf(before, count_before, false), b = eventsOf(after, count_after, false);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const Bodies was = bodiesOf(eventOf(before, a[i])), is = bodiesOf(eventOf(after, b[i]));
    if (was == is) continue;
    return SequenceChange{Kind::order, a[i], b[i], true,
                          "The impacts have another order: that of " + namesOf(after, is) + " is the " +
                              ordinal(static_cast<int>(i) + 1) + " one, instead of that of " + namesOf(before, was) + "."};
  }
  return std::nullopt;
}

/// The first difference in persistent contact.
SequenceChange otherContact(const Motion& before, std::size_t count_before, const Motion& after,
                            std::size_t count_after) {
  const std::vector<int> a = eventsOf(before, count_before, true), b = eventsOf(after, count_after, true);
  const auto alike = [](const Event& x, const Event& y) {
    return x.kind == y.kind && x.cause == y.cause && branchOf(x.mode) == branchOf(y.mode) && sameFeatures(x, y);
  };
  std::size_t i = 0;
  while (i < std::min(a.size(), b.size()) && alike(eventOf(before, a[i]), eventOf(after, b[i]))) ++i;
  const int was = i < a.size() ? a[i] : -1, is = i < b.size() ? b[i] : -1;
  if (was < 0 && is < 0)
    return {Kind::contact, was, is, true, "Persistent contact has changed: it begins or ends between other impacts."};
  std::string what = "Persistent contact has changed: ";
  if (is < 0) return {Kind::contact, was, is, true, what + before.describeEvent(was) + " no longer happens."};
  what += after.describeEvent(is);
  if (was < 0) return {Kind::contact, was, is, true, what + " is new."};
  return {Kind::contact, was, is, true, what + ", where it was " + before.describeEvent(was) + "."};
}

std::vector<SequenceChange> changesByBodies(const Sequence& before, const Sequence& after) {
  std::map<Bodies, int> all;
  for (const Sequence* s : {&before, &after}) {
    for (const auto& [bodies, events] : s->of) all[bodies];
  }
  std::vector<SequenceChange> changes;
  for (const auto& [bodies, unused] : all) compareBodies(before, after, bodies, changes);
  return changes;
}

SequenceChange otherOrderOrContact(const Motion& before, std::size_t count_before, const Motion& after,
                                   std::size_t count_after) {
  const auto order = otherOrder(before, count_before, after, count_after);
  return order ? *order : otherContact(before, count_before, after, count_after);
}

void sortByTime(const Motion& before, const Motion& after, std::vector<SequenceChange>& changes) {
  const auto timeAt = [&](const SequenceChange& c) {
    if (c.before < 0 && c.after < 0) return kInfinity;
    return c.before >= 0 ? eventOf(before, c.before).time : eventOf(after, c.after).time;
  };
  std::stable_sort(changes.begin(), changes.end(),
                   [&](const SequenceChange& x, const SequenceChange& y) { return timeAt(x) < timeAt(y); });
}

}  // namespace

const char* nameOf(SequenceChange::Kind kind) {
  return nameIn({"went", "came", "moved", "mode", "order", "contact", "passed"}, kind);
}

std::vector<SequenceChange> sequenceChanges(const Motion& before, std::size_t count_before, const Motion& after,
                                            std::size_t count_after) {
  std::vector<SequenceChange> changes;
  if (before.signature(count_before) == after.signature(count_after)) return changes;
  changes = changesByBodies(sequenceOf(before, count_before, count_before), sequenceOf(after, count_after, count_after));
  if (changes.empty()) changes.push_back(otherOrderOrContact(before, count_before, after, count_after));
  sortByTime(before, after, changes);
  return changes;
}

std::vector<SequenceChange> wholeSequenceChanges(const Motion& before, std::size_t held_before, const Motion& after,
                                                 std::size_t held_after) {
  const std::size_t all_before = before.events.size(), all_after = after.events.size();
  const bool same_held = before.signature(held_before) == after.signature(held_after);
  std::vector<SequenceChange> changes;
  if (same_held && before.signature(all_before) == after.signature(all_after)) return changes;
  changes = changesByBodies(sequenceOf(before, all_before, held_before), sequenceOf(after, all_after, held_after));
  if (same_held) {
    // the same number of impacts of each bodies is held in both: none has passed, and what differs comes later
    for (SequenceChange& change : changes) change.matters = false;
    if (changes.empty()) {
      changes.push_back(otherOrderOrContact(before, all_before, after, all_after));
      changes.back().matters = false;
    }
  } else if (std::none_of(changes.begin(), changes.end(), [](const SequenceChange& c) { return c.matters; })) {
    changes.push_back(otherOrderOrContact(before, held_before, after, held_after));
  }
  sortByTime(before, after, changes);
  return changes;
}

}  // namespace carom
