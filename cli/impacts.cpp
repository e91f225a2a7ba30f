// SPDX-License-Identifier: MIT
#include "cli/impacts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "cli/table.h"

namespace carom::cli {
namespace {

constexpr std::size_t kMostRows = 10;  // of pairs, and of bodies
constexpr std::size_t kMostShown = 5;  // impacts after two sequences part

const std::string& nameOfBody(const Motion& motion, int body) {
  return motion.scene->bodies[static_cast<std::size_t>(body)].name;
}

std::string pairName(const Motion& motion, const std::pair<int, int>& pair) {
  return nameOfBody(motion, pair.first) + "-" + nameOfBody(motion, pair.second);
}

/// One row an impact.
void printRows(Output& out, const Motion& motion, const std::vector<std::size_t>& impacts) {
  Table table({">", ">time [s]", "bodies", "mode", "point [m]", "normal", ">elasticity", ">margin"});
  for (const std::size_t index : impacts) {
    const Event& event = motion.events[index];
    const Contact& first = event.contacts.front();
    std::vector<std::string> names;
    for (const Contact& contact : event.contacts) names.push_back(pairName(motion, {contact.a, contact.b}));
    table.row({std::to_string(index + 1), out.number(event.time), joined(names, " + "), nameOf(event.mode),
               out.vector(first.at.point), out.vector(first.at.normal), out.number(first.pair.elasticity),
               out.number(event.margins.smallest())});
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

std::size_t nearestToTheEdge(const std::vector<Event>& events) {
  const auto less = [](const Event& a, const Event& b) { return a.margins.smallest() < b.margins.smallest(); };
  return static_cast<std::size_t>(std::min_element(events.begin(), events.end(), less) - events.begin());
}

/// Lines from one on, so many at most.
void printPart(Output& out, const std::vector<std::string>& sequence, std::size_t from, std::size_t most) {
  const std::size_t to = std::min(sequence.size(), from + most);
  for (std::size_t i = from; i < to; ++i) out.text() << "    " << sequence[i] << '\n';
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
               << "  the first " << same << " are the same, then came\n";
    printPart(out, before, same, kMostShown);
    out.text() << "  and now come\n";
    printPart(out, after, same, kMostShown);
  }
}

void printImpacts(Output& out, const Motion& motion) {
  if (motion.events.empty()) return;
  std::vector<std::size_t> all(motion.events.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  printRows(out, motion, all);
}

void printImpactSummary(Output& out, const Motion& motion) {
  std::map<ImpactMode, Tally> modes;
  std::map<std::pair<int, int>, Tally> pairs;
  std::map<int, Tally> bodies;
  for (const Event& event : motion.events) {
    modes[event.mode].add(event.time);
    for (const Participant& participant : event.participants) bodies[participant.body].add(event.time);
    std::vector<std::pair<int, int>> met;  // bodies that touch in several places meet once
    for (const Contact& contact : event.contacts) met.emplace_back(contact.a, contact.b);
    std::sort(met.begin(), met.end());
    met.erase(std::unique(met.begin(), met.end()), met.end());
    for (const auto& pair : met) pairs[pair].add(event.time);
  }
  printTallies(out, "Impacts by mode", "mode", modes, [](ImpactMode mode) { return std::string(nameOf(mode)); });
  printTallies(out, "Pairs that meet most often", "bodies", pairs,
               [&](const auto& pair) { return pairName(motion, pair); });
  printTallies(out, "Moving bodies with most impacts", "body", bodies,
               [&](int body) { return nameOfBody(motion, body); });
  out.text() << "\nThe first impact, the one nearest to where derivatives stop, and the last:\n";
  std::vector<std::size_t> chosen{0, nearestToTheEdge(motion.events), motion.events.size() - 1};
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  printRows(out, motion, chosen);
  out.text() << "--impacts lists all of them.\n";
}

}  // namespace carom::cli
