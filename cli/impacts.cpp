// SPDX-License-Identifier: MIT
#include "cli/impacts.h"

#include <algorithm>
#include <map>
#include <vector>

#include "adjoint/motion/lasting_contact.h"
#include "cli/table.h"
#include "formats/base/short_text.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr std::size_t kMostRows = 10;  // of pairs, and of bodies
constexpr std::size_t kMostShown = 5;  // impacts after two sequences part

const std::string& nameOfBody(const Motion& motion, int body) {
  return motion.scene->bodies[static_cast<std::size_t>(body)].name;
}

std::string pairName(const Motion& motion, const std::pair<int, int>& pair) {
  return nameOfBody(motion, pair.first) + "-" + nameOfBody(motion, pair.second);
}

/// Of every event: which impact it is, 1 = the motion's first; nothing where it is not reported.
std::vector<std::string> impactNumbers(const Motion& motion) {
  std::vector<std::string> numbers;
  std::size_t impacts = 0;
  for (const Event& event : motion.events) numbers.push_back(event.counts() ? std::to_string(++impacts) : "");
  return numbers;
}

/// "ball-floor + box-floor (4 contacts)"
std::string pairNames(const Motion& motion, const Event& event) {
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> counts;
  for (const Contact& contact : event.contacts) {
    const auto at = std::ranges::find(pairs, std::pair(contact.a, contact.b)) - pairs.begin();
    if (at == std::ssize(pairs)) pairs.emplace_back(contact.a, contact.b), counts.push_back(0);
    ++counts[static_cast<std::size_t>(at)];
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    names.push_back(pairName(motion, pairs[i]));
    if (counts[i] > 1) names.back() += " (" + std::to_string(counts[i]) + " contacts)";
  }
  return joined(names, " + ");
}

/// One row an event. How bodies go on in contact has a column where any does.
void printRows(Output& out, const Motion& motion, const std::vector<std::size_t>& events) {
  const std::vector<std::string> numbers = impactNumbers(motion);
  std::vector<std::string> changes;
  for (const std::size_t index : events) changes.push_back(describeChanges(motion, static_cast<int>(index)));
  const bool any = std::ranges::any_of(changes, [](const std::string& text) { return !text.empty(); });
  std::vector<std::string> headings{">",         ">time [s]", "bodies",      "mode",
                                    "point [m]", "normal",    ">elasticity", ">margin"};
  if (any) headings.emplace_back("then");
  Table table(headings);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = motion.events[events[i]];
    const Contact& first = event.contacts.front();
    const bool law = event.kind == EventKind::impact || event.kind == EventKind::capture;
    std::vector<std::string> cells{numbers[events[i]],
                                   out.number(event.time),
                                   pairNames(motion, event),
                                   law ? nameOf(event.mode) : "",
                                   out.vector(first.at.point),
                                   out.vector(first.at.normal),
                                   law ? out.number(first.pair.elasticity) : "",
                                   law ? out.number(event.margins.smallest()) : ""};
    if (any) cells.push_back(changes[i]);
    table.row(cells);
  }
  table.print(out);
}

/// Impacts that have something in common.
struct Tally {
  std::size_t count = 0;
  double first = 0, last = 0;  // s

  void add(double time) {
    if (count++ == 0) first = time;
    last = time;
  }
};

/// The largest first; those of one size in the order of the scene.
template <class Key>
std::vector<std::pair<Key, Tally>> ranked(const std::map<Key, Tally>& tallies) {
  std::vector<std::pair<Key, Tally>> rows(tallies.begin(), tallies.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.second.count > b.second.count; });
  return rows;
}

/// One row a tally, the first of them only; `name` gives the first cell of a row.
template <class Key, class Name>
void printTallies(Output& out, const std::string& title, const char* heading, const std::map<Key, Tally>& tallies,
                  Name name) {
  const auto rows = ranked(tallies);
  const std::size_t shown = std::min(rows.size(), kMostRows);
  out.text() << '\n'
             << title;
  if (shown < rows.size()) out.text() << ", the first " << shown << " of " << rows.size();
  out.text() << ":\n";
  Table table({heading, ">impacts", ">first [s]", ">last [s]"});
  for (std::size_t i = 0; i < shown; ++i) {
    const Tally& tally = rows[i].second;
    table.row({name(rows[i].first), std::to_string(tally.count), out.number(tally.first), out.number(tally.last)});
  }
  table.print(out);
}

std::size_t nearestToTheEdge(const Motion& motion, const std::vector<std::size_t>& impacts) {
  const auto margin = [&](std::size_t index) { return motion.events[index].margins.smallest(); };
  return *std::ranges::min_element(impacts, {}, margin);
}

std::vector<std::size_t> countedEvents(const Motion& motion) {
  std::vector<std::size_t> impacts;
  for (std::size_t i = 0; i < motion.events.size(); ++i)
    if (motion.events[i].counts()) impacts.push_back(i);
  return impacts;
}

/// Pairs of bodies that have a reported impact in an event; those that touch in several places meet once.
std::vector<std::pair<int, int>> pairsOf(const Event& event) {
  std::vector<std::pair<int, int>> met;
  for (const Contact& contact : event.contacts)
    if (event.meets(contact.a, contact.b)) met.emplace_back(contact.a, contact.b);
  std::ranges::sort(met);
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return met;
}

/// Impacts from one on, so many at most; those that are alike and come one after another on one line.
void printPart(Output& out, const std::vector<std::string>& sequence, std::size_t from, std::size_t most) {
  const std::size_t to = std::min(sequence.size(), from + most);
  for (std::size_t i = from, same = 0; i < to; i += same) {
    for (same = 1; i + same < to && sequence[i + same] == sequence[i];) ++same;
    out.text() << "    " << sequence[i];
    if (same > 1) out.text() << ", " << same << " times";
    out.text() << '\n';
  }
  if (from == sequence.size()) out.text() << (from == 0 ? "    no impacts\n" : "    no more impacts\n");
}

}  // namespace

void printSequence(Output& out, const std::vector<std::string>& sequence, bool all) {
  printPart(out, sequence, 0, all ? sequence.size() : kMostListed);
  if (!all && sequence.size() > kMostListed)
    out.text() << "    and " << sequence.size() - kMostListed << " more; --impacts lists all\n";
}

void printSequences(Output& out, const std::vector<std::string>& before, const std::vector<std::string>& after,
                    bool all) {
  const std::size_t longest = std::max(before.size(), after.size());
  if (before == after) {
    out.text() << "  impacts, before and after:\n";
    printSequence(out, before, all);
  } else if (all || longest <= kMostListed) {
    out.text() << "  impacts before:\n";
    printSequence(out, before, all);
    out.text() << "  impacts after:\n";
    printSequence(out, after, all);
  } else {
    const auto parting = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
    const auto same = static_cast<std::size_t>(parting.first - before.begin());
    out.text() << "  impacts: " << before.size() << " before, " << after.size() << " after; --impacts lists all\n"
               << "  the first " << same << " are the same, then before:\n";
    printPart(out, before, same, kMostShown);
    out.text() << "  and now:\n";
    printPart(out, after, same, kMostShown);
  }
}

std::vector<std::size_t> toldEvents(const Motion& motion) {
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < motion.events.size(); ++i)
    if (!motion.events[i].tooLow()) told.push_back(i);
  return told;
}

void printImpacts(Output& out, const Motion& motion) {
  const std::vector<std::size_t> told = toldEvents(motion);
  if (!told.empty()) printRows(out, motion, told);
}

void printImpactSummary(Output& out, const Motion& motion) {
  std::map<ImpactMode, Tally> modes;
  std::map<std::pair<int, int>, Tally> pairs;
  std::map<int, Tally> bodies;
  const std::vector<std::size_t> impacts = countedEvents(motion);
  for (const std::size_t index : impacts) {
    const Event& event = motion.events[index];
    modes[event.mode].add(event.time);
    for (const Participant& participant : event.participants)
      if (participant.impact > 0) bodies[participant.body].add(event.time);
    for (const auto& pair : pairsOf(event)) pairs[pair].add(event.time);
  }
  printTallies(out, "Impacts by mode", "mode", modes, [](ImpactMode mode) { return std::string(nameOf(mode)); });
  printTallies(out, "Pairs with most impacts", "bodies", pairs,
               [&](const auto& pair) { return pairName(motion, pair); });
  printTallies(out, "Moving bodies with most impacts", "body", bodies,
               [&](int body) { return nameOfBody(motion, body); });
  if (!impacts.empty()) {
    out.text() << "\nThe first impact, the one with the smallest margin, and the last:\n";
    std::vector<std::size_t> chosen{impacts.front(), nearestToTheEdge(motion, impacts), impacts.back()};
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    printRows(out, motion, chosen);
  }
  out.text() << "--impacts lists all of them.\n";
}

}  // namespace carom::cli
