// SPDX-License-Identifier: MIT
#include "editing/problem/rows/required_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"

namespace carom::editing_detail {
namespace {

/// Pairs that may meet next of which the nearest is looked for, at most.
constexpr std::size_t kMostLackingPairs = 16;
/// Between the two features of a contact, in words.
constexpr std::string_view kOn = " on ";

/// A pattern with * (any text) and ? (any letter).
bool matches(const char* pattern, const char* text) {
  if (*pattern == 0) return *text == 0;
  if (*pattern == '*') return matches(pattern + 1, text) || (*text != 0 && matches(pattern, text + 1));
  return *text != 0 && (*pattern == '?' || *pattern == *text) && matches(pattern + 1, text + 1);
}

// The features of a contact as the lists of impacts have them, "face -z on face +z", seen from either of its bodies.
std::string featuresOf(const Motion& motion, const Contact& contact, bool from_b) {
  const std::string text = motion.geometry->describe(contact.a, contact.b, contact.features);
  const std::size_t on = text.find(kOn);
  return from_b ? text.substr(on + kOn.size()) + std::string(kOn) + text.substr(0, on) : text;
}

std::vector<bool> bodiesLike(const Scene& scene, const std::string& pattern) {
  std::vector<bool> like;
  for (const Body& body : scene.bodies) like.push_back(matches(pattern.c_str(), body.name.c_str()));
  return like;
}

bool any_of(const std::vector<bool>& set) { return std::find(set.begin(), set.end(), true) != set.end(); }

bool isImpactOf(const Event& event, int body) {
  const Participant* p = event.find(body);
  return p && p->impact > 0;
}

}  // namespace

BoundHit::Other BoundHit::bind(const Scene& scene, const ImpactOf& impact, const std::string& where) {
  Other other;
  other.body = findAt(where + "/body", [&] { return bodyIndex(scene, impact.body); });
  other.n = impact.n;
  if (impact.n < 1)
    throw InputError(where + "/impact", "found " + std::to_string(impact.n) + ", expected 1 or more");
  if (!impact.with.empty()) other.with = findAt(where + "/with", [&] { return bodyIndex(scene, impact.with); });
  return other;
}

BoundHit::BoundHit(const Scene& scene, const std::string& body, const Hit& hit, const std::string& where)
    : body_(findAt(where + "/body", [&] { return bodyIndex(scene, body); })),
      with_(findAt(where + "/hits", [&] { return bodyIndex(scene, hit.with); })) {
  if (body_ == with_) throw InputError(where + "/hits", "found '" + body + "' itself, expected another body");
  words_ = "'" + body + "' hits '" + hit.with + "'";
  if (hit.during) {
    checkSpan(*hit.during, where + "/during");
    std::tie(from_, to_) = *hit.during;
    words_ += " between " + number(from_) + " s and " + number(to_) + " s";
  }
  if (hit.after) after_ = bind(scene, *hit.after, where + "/after");
  if (hit.before) before_ = bind(scene, *hit.before, where + "/before");
}

std::optional<double> BoundHit::timeOf(const Motion& motion, const Other& other) {
  const std::optional<int> event = motion.findImpact(other.body, other.n, other.with);
  if (!event) return std::nullopt;
  return motion.events[static_cast<std::size_t>(*event)].time;
}

std::optional<int> BoundHit::find(const Motion& motion) const {
  const std::optional<double> after = after_ ? timeOf(motion, *after_) : std::nullopt,
                              before = before_ ? timeOf(motion, *before_) : std::nullopt;
  if (after_ && !after) return std::nullopt;
  std::optional<int> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int e : motion.world_lines[static_cast<std::size_t>(body_)].events) {
    const Event& event = motion.events[static_cast<std::size_t>(e)];
    if (!isImpactOf(event, body_) || !event.meets(body_, with_)) continue;
    if ((after && !(event.time > *after)) || (before && !(event.time < *before))) continue;
    const double off = event.time < from_ ? from_ - event.time : event.time > to_ ? event.time - to_ : 0;
    if (off < least) least = off, nearest = e;
  }
  return nearest;
}

bool BoundHit::isSettled(const Motion& motion) const {
  const std::optional<int> event = find(motion);
  return event && motion.events[static_cast<std::size_t>(*event)].time >= from_;
}

LackingImpact BoundHit::lacking(const Motion& motion) const {
  LackingImpact lacking;
  const std::optional<double> after = after_ ? timeOf(motion, *after_) : std::optional(0.0);
  lacking.from = std::min(std::max(from_, after.value_or(0)), motion.end);
  lacking.to = std::min(to_, motion.end);
  if (before_)
    if (const std::optional<double> before = timeOf(motion, *before_)) lacking.to = std::min(lacking.to, *before);
  if (!(lacking.from < lacking.to)) lacking.from = 0, lacking.to = motion.end;
  if (after) {
    lacking.pairs = {{body_, with_}};
  } else if (after_->with >= 0) {
    lacking.pairs = {{after_->body, after_->with}};
  }
  lacking.share = after_ && after ? 0.5 : 0;
  lacking.sentence = "It does not happen that " + words_ + (after ? "." : ": the impact that must happen before it does not happen.");
  return lacking;
}

BoundSequence::Entry BoundSequence::parse(const Scene& scene, const std::string& text, const std::string& where) {
  Entry entry{text, text == "...", {}, {}};
  if (entry.anything) return entry;
  // names may have spaces and parentheses: the first space that leaves bodies on both sides, at best without features
  const auto findBodies = [&](const std::string& names) {
    for (std::size_t space = names.find(' '); space != std::string::npos; space = names.find(' ', space + 1)) {
      entry.a = bodiesLike(scene, names.substr(0, space)), entry.b = bodiesLike(scene, names.substr(space + 1));
      if (any_of(entry.a) && any_of(entry.b)) return true;
    }
    return false;
  };
  if (findBodies(text)) return entry;
  const std::size_t open = text.rfind(" (");
  if (open != std::string::npos && text.back() == ')' && findBodies(text.substr(0, open))) {
    entry.features = text.substr(open + 2, text.size() - open - 3);
    if (entry.features.find(kOn) != std::string::npos) return entry;
    throw InputError(where, "found the features '" + entry.features + "', expected two such as 'face -z on *'");
  }
  throw InputError(where, "found '" + text + "', expected names or patterns of two bodies with a space between, " +
                              "features that meet behind them in parentheses, or ...");
}

BoundSequence::BoundSequence(const Scene& scene, const std::vector<std::string>& impacts, const std::string& where)
    : subjects_(scene.bodies.size(), false), named_(scene.bodies.size(), false) {
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    entries_.push_back(parse(scene, impacts[i], where + "/" + std::to_string(i)));
    const Entry& entry = entries_.back();
    for (std::size_t b = 0; b < entry.a.size(); ++b) {
      if (entry.a[b]) subjects_[b] = true;
      if (entry.a[b] || entry.b[b]) named_[b] = true;
    }
  }
  if (!any_of(subjects_)) throw InputError(where, "found no impact, expected at least one such as \"cue red\"");
}

int BoundSequence::body() const {
  return static_cast<int>(std::find(subjects_.begin(), subjects_.end(), true) - subjects_.begin());
}

// Impacts of a subject with a body that is named, or that moves: floors that nobody speaks of do not count.
bool BoundSequence::isAbout(const Motion& motion, const Event& event) const {
  if (!event.counts()) return false;
  return std::any_of(event.contacts.begin(), event.contacts.end(), [&](const Contact& c) {
    if (!c.counted || c.held) return false;
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const auto matters = [&](std::size_t subject, std::size_t other) {
      return subjects_[subject] && (named_[other] || !motion.scene->bodies[other].fixed);
    };
    return matters(a, b) || matters(b, a);
  });
}

bool BoundSequence::fits(const Motion& motion, const Event& event, const Entry& entry) {
  return std::any_of(event.contacts.begin(), event.contacts.end(), [&](const Contact& c) {
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const auto meet = [&](std::size_t first, std::size_t second) {
      return entry.a[first] && entry.b[second] &&
             (entry.features.empty() ||
              matches(entry.features.c_str(), featuresOf(motion, c, first != a).c_str()));
    };
    return c.counted && !c.held && (meet(a, b) || meet(b, a));
  });
}

// Every entry that may come next is kept in mind, as "..." stands for as few impacts as for many.
BoundSequence::Match BoundSequence::match(const Motion& motion) const {
  Match best;
  std::vector<bool> next(entries_.size() + 1, false);
  const auto reach = [&](std::vector<bool>& places, std::size_t place) {
    places[place] = true;
    for (; place < entries_.size() && entries_[place].anything; ++place) places[place + 1] = true;
  };
  reach(next, 0);
  for (std::size_t e = 0; e < motion.events.size() && !next[entries_.size()]; ++e) {
    const Event& event = motion.events[e];
    if (!isAbout(motion, event)) continue;
    std::vector<bool> after(next.size(), false);
    for (std::size_t place = 0; place < entries_.size(); ++place) {
      if (!next[place]) continue;
      if (entries_[place].anything) reach(after, place);
      if (!entries_[place].anything && fits(motion, event, entries_[place])) {
        reach(after, place + 1);
        if (place + 1 > best.entries) best.entries = place + 1, best.last = static_cast<int>(e), best.against = -1;
      }
    }
    if (best.against < 0 && best.last != static_cast<int>(e)) best.against = static_cast<int>(e);
    next = std::move(after);
  }
  best.complete = next[entries_.size()];
  return best;
}

std::optional<int> BoundSequence::find(const Motion& motion) const {
  const Match match = this->match(motion);
  if (!match.complete) return std::nullopt;
  return match.last;
}

LackingImpact BoundSequence::lacking(const Motion& motion) const {
  const Match match = this->match(motion);
  LackingImpact lacking;
  std::size_t next = match.entries;
  while (next < entries_.size() && entries_[next].anything) ++next;
  if (next == entries_.size()) return lacking;
  const Entry& entry = entries_[next];
  for (std::size_t a = 0; a < entry.a.size(); ++a)
    for (std::size_t b = 0; b < entry.b.size() && lacking.pairs.size() < kMostLackingPairs; ++b)
      if (entry.a[a] && entry.b[b] && a != b) lacking.pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
  const auto timeOf = [&](int event) { return motion.events[static_cast<std::size_t>(event)].time; };
  lacking.from = match.last >= 0 ? timeOf(match.last) : 0;
  lacking.to = match.against >= 0 ? timeOf(match.against) : motion.end;
  lacking.share = static_cast<double>(match.entries) / static_cast<double>(entries_.size());
  lacking.sentence = "Of the required sequence the impact \"" + entry.text + "\" does not come" +
                     (match.entries > 0 ? " after \"" + entries_[match.entries - 1].text + "\"" : " first") +
                     (match.against >= 0 ? ": " + motion.describeEvent(match.against) + " does." : ".");
  return lacking;
}

}  // namespace carom::editing_detail
