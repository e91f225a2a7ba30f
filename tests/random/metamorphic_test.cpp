// SPDX-License-Identifier: MIT
// What does not depend on how a scene is written: the same random scene turned, moved by a kilometre, mirrored, boosted, in
// other units, with its bodies in another order, with bodies far away, and with its planes and boxes as other shapes; scenes in
// a plane, which stay there; and elastic ones, which run backwards.
//
// A motion amplifies rounding, so scenes that are moved by 1e-10 are played beside: they say by how much, and from where on
// the sequence of impacts is no longer sure. Up to there a changed scene must have the same impacts, and states that
// differ by no more than its rounding, amplified.
//
// CAROM_TEST_SCALE multiplies the number of scenes; CAROM_TEST_SEED runs the scene of one seed, which failures name.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "adjoint/scene/body_model.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/random/scene_changes.h"
#include "tests/random/scenes.h"
#include "tests/support/scaled.h"

namespace carom::metamorphic {
namespace {

using brute::RandomScene;

constexpr int kScenes = 300, kBlocks = 4;
constexpr std::uint64_t kFirstSeed = 1;
constexpr double kNudge = 1e-10, kRounding = 2.2e-16;
constexpr double kSafety = 10000;      // roundings, in all: an arm is rounded as its place is, which a small ball feels as spin
constexpr double kMostGrowth = 1e6;    // a nudge that grows to 1e-4 is no longer small
constexpr double kNearTie = 1e-7;      // s between impacts
constexpr double kAlmost = 1e-5;       // of margins
constexpr double kSlowest = 0.05;      // m/s of approach: the time of a slower impact takes up more rounding than a nudge shows
constexpr double kShortest = 1e-3;     // s of flight, likewise
constexpr std::size_t kImpacts = 200;

Motion played(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = kImpacts;
  return simulate(scene, contacts, duration, options);
}

/// Who meets at an event, and how.
std::string keyOf(const Motion& motion, std::size_t event) {
  std::vector<std::string> pairs;
  const auto& bodies = motion.scene->bodies;
  for (const Contact& c : motion.events[event].contacts) {
    const std::string &a = bodies[static_cast<std::size_t>(c.a)].name, &b = bodies[static_cast<std::size_t>(c.b)].name;
    pairs.push_back(std::min(a, b) + "-" + std::max(a, b));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::string key = nameOf(motion.events[event].mode);
  for (const std::string& pair : pairs) key += " " + pair;
  return key;
}

/// The largest difference of two states: of numbers above 1 relative, of orientations as turns.
double apart(const BodyState& a, const BodyState& b) {
  const auto of = [](const Vec3& x, const Vec3& y) { return (x - y).norm() / std::max(1.0, y.norm()); };
  const double turn = 2 * (a.orientation.conjugate() * b.orientation).vec().norm();
  return std::max({of(a.position, b.position), of(a.velocity, b.velocity),
                   of(a.angular_velocity, b.angular_velocity), turn});
}

bool readable(const Motion& m, std::size_t body) { return !m.scene->bodies[body].fixed; }

/// A motion, how far it can be compared, and how it amplifies what its scene is changed by.
struct Base {
  Scene scene;
  double duration = 0;
  Motion motion;
  std::size_t events = 0;      ///< that are sure
  std::vector<double> growth;  ///< until just before each of them; of what follows the last one at the end
  bool whole = false;          ///< the end is sure, too
};

Scene nudged(const Scene& scene, std::uint64_t number) {
  Scene s = scene;
  test::Random random(number);
  for (Body& body : s.bodies) {
    if (body.fixed) continue;
    body.position += kNudge * random.unit();
    body.velocity += kNudge * random.unit();
    if (!body.kinematic) {  // of the angular momentum: what rounds is that
      const BodyModel model = modelOf(body);
      const Mat3 R = body.orientation.toRotationMatrix() * model.R_BG.transpose();
      const Vec3 about = R.transpose() * random.unit();
      body.angular_velocity += kNudge * model.inertia.maxCoeff() * (R * model.inverse_inertia.cwiseProduct(about));
    }
    body.orientation = (Quat(Eigen::AngleAxisd(kNudge, random.unit())) * body.orientation).normalized();
  }
  return s;
}

bool unhurried(const Motion& m, const Event& event) {
  const auto slow = [](const Contact& c) { return std::abs(c.approach) < kSlowest; };
  const auto brief = [&](const Participant& p) {
    const Arc& arc = m.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.arc)];
    return event.time - arc.start() < kShortest;
  };
  return std::none_of(event.contacts.begin(), event.contacts.end(), slow) &&
         std::none_of(event.participants.begin(), event.participants.end(), brief);
}

Base baseOf(const Scene& scene, double duration, std::uint64_t seed) {
  Base base{scene, duration, played(scene, duration), 0, {}, false};
  const Motion& m = base.motion;
  const std::vector<Motion> beside{played(nudged(scene, 3 * seed), duration),
                                   played(nudged(scene, 3 * seed + 1), duration)};
  double growth = 1;
  for (std::size_t e = 0; e < m.events.size(); ++e) {
    if (e + 1 < m.events.size() && m.events[e + 1].time - m.events[e].time < kNearTie) break;
    if (m.end - m.events[e].time < kNearTie || m.events[e].time < kNearTie) break;
    if (m.events[e].margins.smallest() < kAlmost || !unhurried(m, m.events[e])) break;
    bool sure = true;
    for (const Motion& other : beside) {
      sure = sure && e < other.events.size() && keyOf(other, e) == keyOf(m, e);
      if (!sure) break;
      growth = std::max(growth, std::abs(other.events[e].time - m.events[e].time) / kNudge);
      for (const Participant& p : m.events[e].participants) {
        const int event = static_cast<int>(e);
        growth = std::max(growth, apart(m.stateBefore(event, p.body), other.stateBefore(event, p.body)) / kNudge);
      }
    }
    if (!sure || !(growth < kMostGrowth)) break;
    base.growth.push_back(growth);
    base.events = e + 1;
  }
  base.whole = base.events == m.events.size() && m.status == MotionStatus::complete;
  for (const Motion& other : beside)
    base.whole = base.whole && other.events.size() == m.events.size() && other.status == m.status;
  for (std::size_t b = 0; base.whole && b < scene.bodies.size(); ++b)
    for (const Motion& other : beside)
      growth = std::max(growth, apart(m.stateAt(static_cast<int>(b), m.end),
                                      other.stateAt(static_cast<int>(b), other.end)) / kNudge);
  base.whole = base.whole && growth < kMostGrowth;
  if (base.whole) base.growth.push_back(growth);
  return base;
}

struct Tally {
  int compared = 0, impacts = 0, differ = 0;
  double worst = 0;  // error in roundings, amplified
};

class Comparison {
 public:
  Comparison(const Base& base, const Change& change, std::uint64_t seed)
      : base_(base), change_(change), seed_(seed), motion_(played(change.scene, base.duration * change.clock)) {
    for (const Body& body : change.scene.bodies)
      of_.emplace(body.name, static_cast<int>(&body - change.scene.bodies.data()));
  }

  void run(Tally& tally) {
    ++tally.compared;
    const Motion& m = base_.motion;
    for (std::size_t e = 0; e < base_.events; ++e) {
      if (e >= motion_.events.size() || keyOf(motion_, e) != keyOf(m, e)) {
        ++tally.differ;
        std::printf("seed %llu, %s: impact %zu at %.12g s is %s, not %s (growth %.1e, margin %.1e)\n",
                    static_cast<unsigned long long>(seed_), change_.name.c_str(), e + 1, m.events[e].time,
                    e < motion_.events.size() ? keyOf(motion_, e).c_str() : motion_.message.c_str(),
                    keyOf(m, e).c_str(), base_.growth[e], m.events[e].margins.smallest());
        return;
      }
      ++tally.impacts;
      const double time = motion_.events[e].time / change_.clock;
      judge(std::abs(time - m.events[e].time), e, "time of impact", tally);
      for (const Participant& p : m.events[e].participants) {
        const BodyState found = motion_.stateBefore(static_cast<int>(e), at(p.body));
        const BodyState back = change_.back(found, time), expected = m.stateBefore(static_cast<int>(e), p.body);
        judge(apart(back, expected), e, "state before impact", tally);
      }
    }
    if (!base_.whole) return;
    if (motion_.events.size() != m.events.size() || motion_.status != m.status) {
      ++tally.differ;
      std::printf("seed %llu, %s: %zu impacts and '%s', not %zu and '%s'\n", static_cast<unsigned long long>(seed_),
                  change_.name.c_str(), motion_.events.size(), motion_.message.c_str(), m.events.size(),
                  m.message.c_str());
      return;
    }
    for (std::size_t b = 0; b < m.scene->bodies.size(); ++b) {
      if (!readable(m, b)) continue;
      const BodyState found = motion_.stateAt(at(static_cast<int>(b)), motion_.end);
      judge(apart(change_.back(found, m.end), m.stateAt(static_cast<int>(b), m.end)), base_.events, "state at the end",
            tally);
    }
  }

 private:
  int at(int body) const { return of_.at(base_.motion.scene->bodies[static_cast<std::size_t>(body)].name); }

  void judge(double error, std::size_t event, const char* what, Tally& tally) {
    const double share = error / (kRounding * change_.size * base_.growth[event]);
    tally.worst = std::max(tally.worst, share);
    if (!failed_ && !(share <= kSafety)) {
      failed_ = true;
      ADD_FAILURE() << "seed " << seed_ << ", " << change_.name << ": " << what << " " << event + 1 << " is off by "
                    << error << ", " << share << " roundings (growth " << base_.growth[event] << ")\n"
                    << brute::describe({base_.scene, base_.duration});
    }
  }

  const Base& base_;
  const Change& change_;
  std::uint64_t seed_;
  Motion motion_;
  std::map<std::string, int> of_;
  bool failed_ = false;
};

/// Capsules and cylinders in turn in place of the boxes, within them.
void makeRound(Scene& scene) {
  int count = 0;
  for (Body& b : scene.bodies) {
    const Box* box = std::get_if<Box>(&b.shape);
    if (!box) continue;
    const Vec3 size = box->size;
    const double radius = 0.5 * std::min(size.x(), size.y());
    if (++count % 2 && size.z() > 2.2 * radius)
      b.shape = Capsule{radius, size.z() - 2 * radius};
    else
      b.shape = Cylinder{radius, size.z()};
  }
}

class Suite {
 public:
  void run(std::uint64_t seed) {
    RandomScene random = brute::randomScene(seed);
    if (seed % 3 == 0) makeRound(random.scene);
    const Base base = baseOf(random.scene, random.duration, seed);
    test::Random dice(seed);
    std::vector<Change> changes{turned(base.scene, dice),    moved(base.scene, dice),     mirrored(base.scene),
                                inUnits(base.scene, dice),   reordered(base.scene, dice), withFarBodies(base.scene, dice)};
    const auto kind = static_cast<Kind>(1 + dice.below(3));
    changes.push_back(boxesAs(kind, base.scene));
    if (hasPlanes(base.scene))
      changes.push_back(planesAs(static_cast<Kind>(dice.below(4)), base.scene));
    else
      changes.push_back(boosted(base.scene, dice));
    for (const Change& change : changes) Comparison(base, change, seed).run(tallies_[change.name]);
    staysInItsPlane(random, seed);
    runsBackwards(random, seed);
  }

  void report() const {
    int compared = 0, differ = 0;
    for (const auto& [name, t] : tallies_) {
      std::printf("%-22s %5d scenes, %6d impacts, %3d of other sequences, worst error %.1f amplified roundings\n",
                  name.c_str(), t.compared, t.impacts, t.differ, t.worst);
      compared += t.compared, differ += t.differ;
    }
    EXPECT_LE(300 * differ, compared) << "more than one comparison in 300 has another sequence";
  }

 private:
  // y = 0, and all axes of rotation along y.
  void staysInItsPlane(const RandomScene& random, std::uint64_t seed) {
    Scene scene = random.scene;
    std::erase_if(scene.bodies, [](const Body& b) {
      const Plane* plane = std::get_if<Plane>(&b.shape);
      return plane && std::abs((b.orientation * plane->normal).y()) > 0.5;
    });
    for (Body& b : scene.bodies) {
      if (Plane* plane = std::get_if<Plane>(&b.shape)) {
        Vec3 n = b.orientation * plane->normal;
        plane->offset += n.dot(b.position);
        n.y() = 0;
        plane->normal = n.normalized();
        b.position.setZero();
        b.orientation = Quat::Identity();
        continue;
      }
      const double angle = 2 * std::atan2(b.orientation.y(), b.orientation.w());
      b.position.y() = b.velocity.y() = 0;
      b.orientation = Quat(std::cos(angle / 2), 0, std::sin(angle / 2), 0).normalized();
      b.angular_velocity.x() = b.angular_velocity.z() = 0;
    }
    if (!OdeContacts(scene).overlaps().empty()) return;
    const Base base = baseOf(scene, random.duration, seed);
    Tally& tally = tallies_["planar"];
    ++tally.compared;
    const auto outOf = [](const BodyState& s) {
      return std::max({std::abs(s.position.y()), std::abs(s.velocity.y()), std::abs(s.angular_velocity.x()),
                       std::abs(s.angular_velocity.z()), std::abs(s.orientation.x()), std::abs(s.orientation.z())});
    };
    double worst = 0;
    for (std::size_t e = 0; e < base.events; ++e) {
      ++tally.impacts;
      for (const Participant& p : base.motion.events[e].participants)
        worst = std::max(worst, outOf(base.motion.stateBefore(static_cast<int>(e), p.body)) / base.growth[e]);
    }
    tally.worst = std::max(tally.worst, worst / kRounding);
    EXPECT_TRUE(worst <= kSafety * kRounding) << "seed " << seed << ": leaves its plane by " << worst << "\n"
                                              << brute::describe({scene, random.duration});
  }

  // Elastic and without friction, up to the first impact of several contacts: at the end everything is turned round, and
  // the start comes back.
  void runsBackwards(const RandomScene& random, std::uint64_t seed) {
    Scene scene = random.scene;
    for (Material& m : scene.materials) m.elasticity = 1, m.friction = 0, m.combine_elasticity = Combine::average;
    double duration = random.duration;
    Motion there = played(scene, duration);
    double last = 0;
    for (const Event& e : there.events) {
      if (e.contacts.size() > 1 || e.margins.grazing < 1e-3 || e.time - last < 1e-6) {
        duration = 0.5 * (last + e.time);
        break;
      }
      last = e.time;
    }
    if (!(duration - last > 1e-6)) return;
    there = played(scene, duration);
    if (there.status != MotionStatus::complete) return;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].fixed) continue;
      const BodyState s = there.stateAt(static_cast<int>(b), duration);
      scene.bodies[b].position = s.position;
      scene.bodies[b].orientation = s.orientation.normalized();
      scene.bodies[b].velocity = -s.velocity;
      scene.bodies[b].angular_velocity = -s.angular_velocity;
    }
    const Base back = baseOf(scene, duration, seed);
    if (!back.whole) return;
    Tally& tally = tallies_["backwards"];
    ++tally.compared;
    const std::size_t n = there.events.size();
    bool alike = back.motion.events.size() == n;
    for (std::size_t e = 0; alike && e < n; ++e) alike = keyOf(back.motion, e) == keyOf(there, n - 1 - e);
    if (!alike) {
      ++tally.differ;
      std::printf("seed %llu, backwards: %zu impacts, not %zu\n", static_cast<unsigned long long>(seed),
                  back.motion.events.size(), n);
      return;
    }
    tally.impacts += static_cast<int>(n);
    double worst = 0;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].fixed) continue;
      BodyState s = back.motion.stateAt(static_cast<int>(b), duration);
      s.velocity *= -1, s.angular_velocity *= -1;
      worst = std::max(worst, apart(s, there.stateAt(static_cast<int>(b), 0)));
    }
    const double share = worst / (kRounding * back.growth.back());
    tally.worst = std::max(tally.worst, share);
    EXPECT_TRUE(share <= kSafety) << "seed " << seed << ": comes back off by " << worst << ", " << share
                                  << " roundings (growth " << back.growth.back() << ")\n"
                                  << brute::describe(random);
  }

  std::map<std::string, Tally> tallies_;
};

class Metamorphic : public testing::TestWithParam<int> {};

TEST_P(Metamorphic, ScenesThatAreTheSameMoveTheSame) {
  Suite suite;
  if (const char* seed = std::getenv("CAROM_TEST_SEED")) {
    if (GetParam() == 0) suite.run(std::strtoull(seed, nullptr, 10)), suite.report();
    return;
  }
  const int scenes = test::scaled(kScenes / kBlocks);
  for (int i = 0; i < scenes; ++i) suite.run(kFirstSeed + static_cast<std::uint64_t>(GetParam() + kBlocks * i));
  suite.report();
}
INSTANTIATE_TEST_SUITE_P(Blocks, Metamorphic, testing::Range(0, kBlocks));

}  // namespace
}  // namespace carom::metamorphic
