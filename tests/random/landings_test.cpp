// SPDX-License-Identifier: MIT
// What a box comes to while contacts hold it, against a look at it all along: the first impact besides the contacts that
// hold it is where it first comes to overlap, and nowhere else. CAROM_TEST_SCALE=15 looks at 10^4 paths.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ode_bridge/ode_contacts.h"
#include "tests/random/solid.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::brute {
namespace {

using namespace test;

constexpr int kSamples = 120;
constexpr double kAtOnce = 1e-10;          // s: contacts that meet within it meet at once, and their gaps are closed at once
constexpr double kSlowest = 3e-5;          // m/s, at which gravity does not matter until the overlap is seen
constexpr double kLook = 1e-3;             // s, that an arc is followed beyond its end

// A box that falls without a rebound onto a plane, near the border of a box, or onto the corner of a box that juts out.
Scene randomFall(std::uint64_t seed) {
  Random random(seed);
  Body box = makeBox("box", {random.in(0.05, 0.4), random.in(0.05, 0.4), random.in(0.05, 0.4)}, Vec3::Zero());
  box.orientation = random.rotation();
  box.velocity = random.vec(1);
  box.angular_velocity = random.vec(random.below(2) ? 1 : 6);
  std::vector<Body> bodies{box};
  const int kind = random.below(3);
  if (kind == 0) {
    bodies.push_back(makePlane("floor", Vec3::UnitZ(), 0));
  } else {
    Body table = makeBox("table", {random.in(0.3, 1), random.in(0.3, 1), random.in(0.2, 0.5)}, Vec3::Zero());
    if (kind == 1) {
      table.position.z() = -0.5 * std::get<Box>(table.shape).size.z();
    } else {
      table.orientation = random.rotation();
      table.position.z() = -0.4;
    }
    bodies.push_back(fixedBody(table));
    bodies.push_back(makePlane("floor", Vec3::UnitZ(), -0.8));
  }
  bodies[0].position = {random.in(-0.4, 0.4), random.in(-0.4, 0.4), random.in(0.35, 0.6)};
  return makeScene({0, 0, -9.81}, random.below(2) ? 0 : 0.2, random.below(4) ? random.in(0.05, 1) : 0, bodies);
}

struct Landings {
  int paths = 0, impacts = 0, close = 0;
  double worst = 0;  // s
};

class Look {
 public:
  explicit Look(const Motion& motion, Landings& landings) : motion_(motion), landings_(landings) {
    for (const Body& b : motion.scene->bodies) {
      solids_.push_back(solidOf(b.shape));
      places_.push_back({widen(b.position), b.orientation.cast<Real>().normalized().toRotationMatrix()});
    }
  }

  // The path is followed a little beyond where the motion leaves it.
  void at(std::size_t k) {
    const std::vector<Arc>& arcs = motion_.world_lines[0].arcs;
    Arc path = arcs[k];
    const bool last = k + 1 == arcs.size();
    const double from = path.start(), end = last ? motion_.end : arcs[k + 1].start();
    const Event* event = last ? nullptr : &motion_.events[static_cast<std::size_t>(motion_.world_lines[0].events[k])];
    const bool impact = event && event->kind != EventKind::transition;
    // bodies are moved by no more than a bounce that is none, where their gaps are closed
    const double allowed = motion_.lowest_bounce + kAtOnce * fastestAt(motion_.world_lines[0].events[k - 1]);
    ++landings_.paths;
    landings_.impacts += impact;
    for (int i = 1; i <= kSamples; ++i) {
      const double t = from + (end - from) * i / kSamples;
      const Real apart = separationAt(path, std::min(t, path.availableUntil()));
      EXPECT_TRUE(apart >= -allowed) << "overlap of " << static_cast<double>(-apart) << " at " << t << " of [" << from
                                      << ", " << end << "]";
      if (!(apart >= -allowed)) return;
    }
    if (!impact) return;
    const double approach = fastestAt(motion_.world_lines[0].events[k]);
    path.extendTo(end + kLook);
    const double beyond = std::min(end + kLook, path.knownUntil());
    // it overlaps soon after: at the latest where twice the allowed overlap is reached at half its speed
    const double soon = end + 4 * allowed / approach + 1e-12;
    if (!(soon < beyond) || !(approach > kSlowest)) {
      ++landings_.close;
      return;
    }
    EXPECT_TRUE(separationAt(path, soon) < -allowed) << "no overlap at " << soon << ", after an impact at " << approach
                                                      << " m/s at " << end << ": "
                                                      << static_cast<double>(separationAt(path, soon));
    landings_.worst = std::max(landings_.worst, soon - end);
  }

 private:
  // The approach of the fastest contact that meets at an event, m/s.
  double fastestAt(int event) const {
    double fastest = 0;
    for (const carom::Contact& c : motion_.events[static_cast<std::size_t>(event)].contacts)
      if (!c.held) fastest = std::max(fastest, -c.approach);
    return fastest;
  }
  Real separationAt(const Arc& path, double t) {
    const Kinematics k = path.kinematicsAt(t);
    places_[0] = {widen(k.x), k.R.cast<Real>()};
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t b = 1; b < solids_.size(); ++b)
      least = std::min(least, separation(solids_[0], places_[0], solids_[b], places_[b]).value);
    return least;
  }

  const Motion& motion_;
  Landings& landings_;
  std::vector<Solid> solids_;
  std::vector<Placement> places_;
};

TEST(Landings, AreWhereBodiesFirstComeToOverlap) {
  Landings landings;
  int unfinished = 0;
  const auto count = static_cast<std::uint64_t>(scaled(40));
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = randomFall(seed);
    OdeContacts contacts(scene);
    SimulateOptions options;
    options.impact_limit = 60;
    const Motion m = simulate(scene, contacts, 1.5, options);
    if (m.status != MotionStatus::complete && m.status != MotionStatus::impact_limit) {
      ++unfinished;
      std::printf("seed %d: %s\n", static_cast<int>(seed), m.message.c_str());
    }
    Look look(m, landings);
    const std::vector<Arc>& arcs = m.world_lines[0].arcs;
    for (std::size_t k = 1; k < arcs.size(); ++k)
      if (arcs[k].isIntegrated()) look.at(k);
  }
  std::printf("%d paths in contact, %d end with an impact, %d of them too slow to tell; found within %.2g s\n", landings.paths,
              landings.impacts, landings.close, landings.worst);
  EXPECT_GT(landings.paths, static_cast<int>(count));
  EXPECT_GT(landings.impacts, static_cast<int>(count) / 2);
  EXPECT_TRUE(unfinished <= static_cast<int>(count) / 200);
}

}  // namespace
}  // namespace carom::brute
