// SPDX-License-Identifier: MIT
// Motions with lasting contact do not depend on how their world is written: in other units of length, time and mass, powers of
// two, they have the same bits. CAROM_TEST_SCALE=50 plays 2000 worlds; CAROM_TEST_SEED plays the world of one seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "ode_bridge/ode_contacts.h"
#include "tests/random/lasting_worlds.h"
#include "tests/random/scene_changes.h"
#include "tests/support/scaled.h"

namespace carom::metamorphic {
namespace {

using namespace test;

constexpr int kLastingWorlds = 40;
constexpr std::size_t kWorkOfWorld = 300'000;

Motion playedWhole(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 2000;
  options.step_limit = kWorkOfWorld;
  return simulate(scene, contacts, duration, options);
}

struct UnitsOfWorld {
  const char* name;
  double length, time, mass;
};
// Masses by powers of 4: factors of mass matrices are roots of them.
constexpr UnitsOfWorld kUnitsOfWorlds[] = {
    {"time unit 64", 1, 64, 1},        {"time unit 1/64", 1, 0x1p-6, 1}, {"lengths 2^-13", 0x1p-13, 1, 1},
    {"lengths 2^-5", 0x1p-5, 1, 1},    {"lengths 2^10", 0x1p10, 1, 1},   {"masses 2^-20", 1, 1, 0x1p-20},
    {"masses 2^10", 1, 1, 0x1p10},     {"all of them", 0x1p-10, 0x1p3, 0x1p-16},
};

std::string eventText(const Motion& motion, std::size_t i, bool features) {
  const Event& e = motion.events[i];
  std::vector<std::string> parts;
  for (const Contact& c : e.contacts) {
    std::string a = motion.scene->bodies[static_cast<std::size_t>(c.a)].name, b = motion.scene->bodies[static_cast<std::size_t>(c.b)].name;
    if (b < a) std::swap(a, b);
    parts.push_back(a + "-" + b + (features ? " " + motion.geometry->describe(c.a, c.b, c.features) : "") + (c.lasts ? "+" : ""));
  }
  std::ranges::sort(parts);
  if (!features) parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  std::string out = nameOf(e.kind) + std::string(" ") + nameOf(e.cause) + " " + nameOf(e.mode);
  for (const std::string& part : parts) out += " " + part;
  return out;
}

// What two motions differ in first, to the last bit; empty where in nothing.
std::string firstDifference(const Motion& m, const Motion& other, const Change& change) {
  const std::size_t n = std::min(m.events.size(), other.events.size());
  for (std::size_t i = 0; i < n; ++i) {
    const std::string one = eventText(m, i, true), two = eventText(other, i, true);
    const std::string at = "event " + std::to_string(i + 1) + " of " + std::to_string(m.events.size()) + ", at " + std::to_string(m.events[i].time) + " s";
    if (one != two) return at + ": '" + two + "' for '" + one + "'";
    for (const Participant& p : m.events[i].participants) {
      const int event = static_cast<int>(i);
      for (const bool after : {false, true}) {
        const BodyState s = after ? m.stateAfter(event, p.body) : m.stateBefore(event, p.body);
        const BodyState t = change.back(after ? other.stateAfter(event, p.body) : other.stateBefore(event, p.body), 0);
        if (flatten(s) != flatten(t))
          return at + " (" + one + "): the state " + (after ? "after" : "before") + " it is off by " +
                 std::to_string(std::log10((flatten(s) - flatten(t)).cwiseAbs().maxCoeff())) + " (log10)";
      }
    }
    if (other.events[i].time != change.clock * m.events[i].time) return at + " (" + one + "): its time differs";
  }
  if (m.events.size() != other.events.size())
    return std::to_string(other.events.size()) + " events for " + std::to_string(m.events.size()) + ", '" + other.message + "' for '" + m.message + "'";
  if (m.status != other.status) return "'" + other.message + "' for '" + m.message + "'";
  if (other.end != change.clock * m.end) return "another end";
  for (std::size_t b = 0; b < m.scene->bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    if (flatten(m.stateAt(body, m.end)) != flatten(change.back(other.stateAt(body, other.end), 0))) return "another state at the end";
  }
  return m.steps == other.steps ? "" : "another number of steps";
}

template <class Test>
void eachWorld(const Test& test) {
  if (const char* seed = std::getenv("CAROM_TEST_SEED")) return test(std::strtoull(seed, nullptr, 10));
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(kLastingWorlds)); ++seed) test(seed);
}

TEST(LastingUnits, ChangeNoBit) {
  std::map<std::string, int> ends, differ;
  int events = 0, lasting = 0;
  eachWorld([&](std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const LastingWorld world = lastingWorld(seed);
    const Motion m = playedWhole(world.scene, world.duration);
    ++ends[nameOf(m.status)];
    events += static_cast<int>(m.events.size());
    lasting += std::ranges::any_of(m.events, [](const Event& e) { return e.kind != EventKind::impact; });
    for (const UnitsOfWorld& units : kUnitsOfWorlds) {
      const Change change = inUnits(world.scene, units.length, units.time, units.mass);
      const std::string difference = firstDifference(m, playedWhole(change.scene, world.duration * units.time), change);
      if (difference.empty()) continue;
      ++differ[units.name];
      ADD_FAILURE() << world.name << ", " << units.name << ": " << difference;
    }
  });
  std::printf("%d events, %d worlds with lasting contact;", events, lasting);
  for (const auto& [what, n] : ends) std::printf(" %s %d", what.c_str(), n);
  for (const auto& [what, n] : differ) std::printf("; %s: %d differ", what.c_str(), n);
  std::printf("\n");
}

}  // namespace
}  // namespace carom::metamorphic
