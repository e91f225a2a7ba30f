// SPDX-License-Identifier: MIT
// Stacks whose bodies differ in mass, in how they resist a turn and in size by as much as 1e12: each impact is right, or
// the motion ends with a sentence.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"
#include "tests/support/scaled.h"

namespace carom {
namespace {

using namespace test;

const int kStacks = test::scaled(60);

struct Stack {
  Scene scene;
  double duration = 1;
};

Stack randomStack(std::uint64_t seed) {
  Random random(seed);
  const auto oneOf = [&](std::initializer_list<double> list) {
    return *(list.begin() + random.below(static_cast<int>(list.size())));
  };
  const double unit = random.below(2) == 0 ? 1 : std::pow(10, random.below(13) - 6), e = oneOf({0, 1e-9, 0.5, 1});
  std::vector<Body> bodies;
  double top = random.in(0, 0.5) * unit;
  const int count = 1 + random.below(4);
  const bool aslant = random.below(3) == 0;
  for (int i = 0; i < count; ++i) {
    const double height = unit * (random.below(2) == 0 ? 1 : random.in(0.5, 1.5));
    Body body = makeBox("b" + std::to_string(i), unit * Vec3(1, 1, height / unit), {0, 0, top + height / 2});
    const int kind = random.below(4);
    if (kind == 0) body.shape = Sphere{height / 2};
    if (kind == 1) body.shape = Cylinder{0.5 * unit, height};
    body.mass = std::pow(10, random.in(-6, 6));
    if (random.below(3) == 0)
      body.inertia = Inertia::fromMoments(*body.mass * unit * unit * std::pow(10, random.in(-12, 6)) *
                                          Vec3(1, random.in(0.5, 1), random.in(0.5, 1)));
    if (aslant) body.orientation = Quat(Eigen::AngleAxisd(random.in(0.1, 1), random.unit()));
    if (aslant) body.angular_velocity = random.vec(1);
    body.velocity.z() = -random.below(2) * random.in(0, 1) * unit;
    top += height + (random.below(2) == 0 ? 0 : random.in(0, 0.1) * unit) + (aslant ? unit : 0);
    bodies.push_back(body);
  }
  bodies.push_back(makePlane("floor", Vec3::UnitZ(), 0));
  Stack stack{makeScene({0, 0, -10 * unit}, e, oneOf({0, 1e-9, 0.5, 10}), bodies), 1};
  stack.scene.materials[0].tangential_elasticity = oneOf({-1, 0, 1});
  return stack;
}

TEST(RatioScenes, StacksAreRightOrSayWhyNot) {
  int events = 0, joint = 0;
  std::map<std::string, int> statuses;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kStacks); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Stack stack = randomStack(seed);
    OdeContacts contacts(stack.scene);
    SimulateOptions options;
    options.impact_limit = 100;
    options.step_limit = 3'000'000;  // a body that hardly resists a turn shakes 1e6 times a second where it stands on its rim
    const Motion m = simulate(stack.scene, contacts, stack.duration, options);
    ++statuses[nameOf(m.status)];
    if (m.status == MotionStatus::not_computable) std::printf("seed %d: %s\n", static_cast<int>(seed), m.message.c_str());
    EXPECT_FALSE(m.message.empty());
    for (const Event& event : m.events) {
      ++events;
      joint += event.mode == ImpactMode::joint;
      double before = 0, after = 0;
      for (const Participant& p : event.participants) {
        const BodyModel& model = (*m.models)[static_cast<std::size_t>(p.body)];
        before += kineticEnergy(model, p.before);
        after += kineticEnergy(
            model, m.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].startState());
      }
      EXPECT_TRUE(after <= before * (1 + 1e-9)) << "gains " << after / before - 1 << " of its energy at " << event.time;
      struct Parting {
        double after = 0, approach = 0, size = 0;
      };
      std::vector<Parting> partings;
      double fastest = 0;  // impulses of all are found together: what stays at rest has no speeds but rounding of theirs
      for (const Contact& c : event.contacts) {
        Parting& at = partings.emplace_back();
        for (const Participant& p : event.participants) {
          if (p.body != c.a && p.body != c.b) continue;
          const BodyModel& model = (*m.models)[static_cast<std::size_t>(p.body)];
          const auto speed = [&](const State& s) {
            const Vec3 w = model.inverseInertiaWorld(p.before.q.toRotationMatrix()) * s.L, r = c.at.point - p.before.x;
            at.size += s.v.norm() + w.norm() * r.norm();
            return (p.body == c.a ? 1 : -1) * c.at.normal.dot(s.v + w.cross(r));
          };
          at.approach += speed(p.before);
          at.after += speed(
              m.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].startState());
        }
        fastest = std::max(fastest, at.size);
      }
      for (std::size_t k = 0; k < partings.size(); ++k) {
        const Parting& at = partings[k];
        EXPECT_TRUE(at.after >= -event.contacts[k].pair.elasticity * at.approach - 1e-9 * (at.size + 1e-3 * fastest))
            << "parts at " << at.after << " after " << at.approach << " at " << event.time;
      }
    }
  }
  std::printf("%d stacks, %d impacts (%d joint):", kStacks, events, joint);
  for (const auto& [status, count] : statuses) std::printf(" %d %s", count, status.c_str());
  std::printf("\n");
  EXPECT_GT(joint, kStacks / 2);
}

}  // namespace
}  // namespace carom
