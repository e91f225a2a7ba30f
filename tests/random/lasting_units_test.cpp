// SPDX-License-Identifier: MIT
// Motions with lasting contact do not depend on how their world is written: in other units of length, time and mass, powers of
// two, they have the same bits; turned, and with the bodies in reverse order, the same events, and states that differ by
// rounding. CAROM_TEST_SCALE=50 plays 2000 worlds; CAROM_TEST_SEED plays the world of one seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

#include "adjoint/derivative/tangent.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/random/lasting_worlds.h"
#include "tests/random/scene_changes.h"
#include "tests/support/scaled.h"

namespace carom::metamorphic {
namespace {

using namespace test;

constexpr int kLastingWorlds = 40, kWorldsOfAShare = 20;
constexpr std::size_t kWorkOfWorld = 300'000;
// How far states of rewritten worlds may differ: so much, or so much of the largest entry of the motion's tangent.
constexpr double kSameState = 1e-11, kShareOfTangent = 1e-11;

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

// What rounding is amplified by: the largest rate of a state just before each event, and before, along random directions of all
// scene parameters.
std::vector<double> growthOf(const Motion& motion, std::uint64_t seed) {
  std::vector<double> growth(motion.events.size() + 1, 1);
  DerivativeTape tape(motion);
  Random random(seed);
  for (int d = 0; d < 6; ++d) {
    const MotionTangent by = tangent(tape, randomDirection(*motion.scene, random));
    double largest = 1;
    const auto take = [&](int body, const Instant& at) {
      const BodyStateRate rate = by.at(body, at);
      for (const Vec3& v : {rate.position, rate.orientation, rate.velocity, rate.angular_velocity})
        largest = std::max(largest, v.cwiseAbs().maxCoeff());
    };
    for (std::size_t e = 0; e < motion.events.size(); ++e) {
      for (const Participant& p : motion.events[e].participants) take(p.body, Instant::before(static_cast<int>(e)));
      growth[e] = std::max(growth[e], largest);
    }
    for (std::size_t b = 0; b < motion.scene->bodies.size(); ++b)
      if (!motion.scene->bodies[b].fixed) take(static_cast<int>(b), Instant::at(motion.end));
    growth.back() = std::max(growth.back(), largest);
  }
  return growth;
}

struct WorldsApart {
  int compared = 0, sequences = 0, apart = 0;
  double worst = 0;
};

double stateDifference(const BodyState& a, const BodyState& b) {
  Eigen::Matrix<double, 13, 1> x = flatten(a), y = flatten(b);
  if (x.segment<4>(3).dot(y.segment<4>(3)) < 0) y.segment<4>(3) *= -1;
  return (x - y).cwiseAbs().maxCoeff();
}

// A motion against the same one, written otherwise, as far as their events are the same.
struct Rewritten {
  const Motion &m, &other;
  const Change& change;
  std::uint64_t seed;
  std::vector<double> growth = {};
  double worst = 0;
  std::string off = {}, sequence = {};  // what differs

  void look(const BodyState& state, const BodyState& there, double time, std::size_t event) {
    const double difference = stateDifference(state, change.back(there, time));
    if (difference <= kSameState || !off.empty()) return;
    if (growth.empty()) {
      try {
        growth = growthOf(m, seed);
      } catch (const NotComputable&) {  // of bodies that move on each other: nothing to measure it by
        growth.assign(m.events.size() + 1, kInfinity);
      }
    }
    worst = std::max(worst, difference / growth[event]);
    if (!(difference <= kShareOfTangent * growth[event]))
      off = "states before event " + std::to_string(event + 1) + " are off by " + std::to_string(difference * 1e12) + "e-12, the tangent is " + std::to_string(growth[event]);
  }
  std::string text(const Motion& of, std::size_t i) const {
    return i < of.events.size() ? eventText(of, i, false) : std::string(nameOf(of.status)) + " " + of.message;
  }
  void compare() {
    const auto place = [&](int body) { return bodyIndex(*other.scene, m.scene->bodies[static_cast<std::size_t>(body)].name); };
    for (std::size_t i = 0; i < std::max(m.events.size(), other.events.size()); ++i) {
      if (i >= m.events.size() || i >= other.events.size() || eventText(m, i, false) != eventText(other, i, false)) {
        sequence = "event " + std::to_string(i + 1) + " of " + std::to_string(m.events.size()) + ": '" + text(other, i) + "' for '" + text(m, i) + "'";
        return;
      }
      for (const Participant& p : m.events[i].participants)
        look(m.stateBefore(static_cast<int>(i), p.body), other.stateBefore(static_cast<int>(i), place(p.body)), other.events[i].time, i);
    }
    if (m.status != other.status) sequence = "'" + text(other, other.events.size()) + "' for '" + text(m, m.events.size()) + "'";
    if (m.status != MotionStatus::complete || !sequence.empty()) return;
    for (int b = 0; b < static_cast<int>(m.scene->bodies.size()); ++b)
      if (!m.scene->bodies[static_cast<std::size_t>(b)].fixed) look(m.stateAt(b, m.end), other.stateAt(place(b), other.end), other.end, m.events.size());
  }
};

TEST(LastingWorlds, AreTheSameTurnedAndInReverseOrder) {
  std::map<std::string, WorldsApart> count;
  eachWorld([&](std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const LastingWorld world = lastingWorld(seed);
    const Motion m = playedWhole(world.scene, world.duration);
    Random dice(seed);
    Change reversed{"in reverse order", world.scene, [](const BodyState& s, double) { return s; }};
    std::ranges::reverse(reversed.scene.bodies);
    for (const Change& change : {turned(world.scene, dice), reversed}) {
      WorldsApart& of = count[change.name];
      ++of.compared;
      const Motion other = playedWhole(change.scene, world.duration);
      Rewritten rewritten{m, other, change, seed};
      rewritten.compare();
      of.worst = std::max(of.worst, rewritten.worst);
      of.apart += !rewritten.off.empty();
      of.sequences += !rewritten.sequence.empty();
      for (const std::string& what : {rewritten.off, rewritten.sequence})
        if (!what.empty())
          std::printf("seed %d, %s, %s: %s\n", static_cast<int>(seed), world.name.c_str(), change.name.c_str(), what.c_str());
    }
  });
  for (const auto& [what, of] : count)
    std::printf("%s: %d worlds, %d of other events, %d of other states; largest share of a tangent where states are off by more than %.0e: %.2g\n",
                what.c_str(), of.compared, of.sequences, of.apart, kSameState, of.worst);
  // Events too low for people, and contacts of flat landings, are decided by rounding where nothing else decides them:
  // about one world of five has one. The share of a few worlds tells nothing.
  for (const auto& [what, of] : count) {
    if (of.compared >= kWorldsOfAShare) EXPECT_LE(4 * of.sequences, of.compared) << what;
    EXPECT_LE(20 * of.apart, of.compared) << what;  // see docs/progress.md
  }
}

}  // namespace
}  // namespace carom::metamorphic
