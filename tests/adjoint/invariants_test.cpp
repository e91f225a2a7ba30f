// SPDX-License-Identifier: MIT
// What every motion and every derivative keeps, whatever the scene: no reference is needed.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "adjoint/derivative/event_linearization.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

constexpr int kScenes = 25;

const State& stateAfter(const Motion& m, const Participant& p) {
  return m.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].startState();
}

const BodyModel& modelAt(const Motion& m, int body) { return (*m.models)[static_cast<std::size_t>(body)]; }

// Equation 5.4: lambda+ . F+ = lambda- . F- at every event.
TEST(Invariant, AdjointTimesRateIsKeptByEvents) {
  int events = 0;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Scene s = randomScene(seed);
    if (seed % 4 == 0) s.tilts = {{"body0", 1, {0.02, -0.01}}, {"body1", 1, {0.01, 0.03}}};
    const Motion m = play(s, 0.5, 10);
    DerivativeTape tape(m);
    Random random(seed);
    for (int e = 0; e < static_cast<int>(m.events.size()); ++e, ++events) {
      const EventLinearization& event = tape.event(e);
      const std::size_t n = m.events[static_cast<std::size_t>(e)].participants.size();
      EXPECT_LT(event.guardRate(), 0);
      std::vector<StateDerivative> after(n), none(n);
      for (StateDerivative& a : after) a = {random.vec(1), random.vec(1), random.vec(1), random.vec(1)};
      SceneGradient scene_bar(s);
      std::vector<BodyModelDerivative> model_bar(s.bodies.size());
      const auto before = event.pullback(after, none, 0, scene_bar, model_bar);
      double sum_after = 0, sum_before = 0, size = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const StateDerivative &rate_after = event.rateAfter()[k], &rate_before = event.rateBefore()[k];
        sum_after += after[k].dot(rate_after);
        sum_before += before[k].dot(rate_before);
        for (const auto& [bar, rate] : {std::pair(after[k], rate_after), std::pair(before[k], rate_before)})
          size += bar.x.cwiseAbs().dot(rate.x.cwiseAbs()) + bar.theta.cwiseAbs().dot(rate.theta.cwiseAbs()) +
                  bar.v.cwiseAbs().dot(rate.v.cwiseAbs());
      }
      expectEntries(sum_before / size, sum_after / size, 1e-13, m.describeEvent(e));
    }
  }
  EXPECT_GT(events, 100);
}

double kineticEnergyBefore(const Motion& m, const Event& e) {
  double sum = 0;
  for (const Participant& p : e.participants) sum += kineticEnergy(modelAt(m, p.body), p.before);
  return sum;
}

double kineticEnergyAfter(const Motion& m, const Event& e) {
  double sum = 0;
  for (const Participant& p : e.participants) sum += kineticEnergy(modelAt(m, p.body), stateAfter(m, p));
  return sum;
}

TEST(Invariant, ImpactsNeverAddEnergy) {
  int events = 0;
  for (std::uint64_t seed = 1; seed <= 3 * kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene o;
    o.bodies = 2 + static_cast<int>(seed % 4);
    const Motion m = play(randomScene(seed, o), 0.6, 40);
    for (const Event& e : m.events) {
      const double before = kineticEnergyBefore(m, e), after = kineticEnergyAfter(m, e);
      EXPECT_TRUE(after <= before * (1 + 1e-12))
          << nameOf(e.mode) << " at " << e.time << ": " << before << " -> " << after;
      ++events;
    }
  }
  EXPECT_GT(events, 500);
}

double totalEnergy(const Motion& m, double t) {
  double sum = 0;
  for (int b = 0; b < static_cast<int>(m.world_lines.size()); ++b) {
    const BodyModel& model = modelAt(m, b);
    if (!model.moving) continue;
    const State s = m.world_lines[static_cast<std::size_t>(b)].arcs[static_cast<std::size_t>(m.arcAt(b, t))].stateAt(t);
    sum += kineticEnergy(model, s) - model.mass * m.scene->gravity.dot(s.x);
  }
  return sum;
}

TEST(Invariant, ElasticFrictionlessMotionsKeepTheirEnergy) {
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene o;
    o.friction = false, o.lowest_elasticity = 1;
    const Motion m = play(randomScene(seed, o), 0.6);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    for (const Event& e : m.events)
      expectEntries(kineticEnergyAfter(m, e) / kineticEnergyBefore(m, e), 1, 1e-12, "kinetic energy");
    expectEntries(totalEnergy(m, m.end) / totalEnergy(m, 0), 1, 1e-12, "total energy");
  }
}

TEST(Invariant, FreeSpaceKeepsMomentumAndAngularMomentum) {
  int events = 0;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene o;
    o.bodies = 5, o.floor = false, o.gravity = false;
    const Motion m = play(randomScene(seed, o), 0.7);
    events += static_cast<int>(m.events.size());
    const auto momenta = [&](double t) {
      Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
      for (int b = 0; b < 5; ++b) {
        const State s =
            m.world_lines[static_cast<std::size_t>(b)].arcs[static_cast<std::size_t>(m.arcAt(b, t))].stateAt(t);
        sum.head<3>() += modelAt(m, b).mass * s.v;
        sum.tail<3>() += angularMomentum(modelAt(m, b), s);
      }
      return sum;
    };
    expectEntries(momenta(m.end), momenta(0), 1e-12, "momentum and angular momentum");
  }
  EXPECT_GT(events, 50);
}

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Every number of a motion that others are computed from.
std::vector<double> numbersOf(const Motion& m) {
  std::vector<double> all{m.end};
  const auto add = [&](const auto& v) { all.insert(all.end(), v.data(), v.data() + v.size()); };
  for (const WorldLine& line : m.world_lines)
    for (const Arc& arc : line.arcs) {
      const State& s = arc.startState();
      all.push_back(arc.start());
      add(s.x), add(s.q.coeffs()), add(s.v), add(s.L);
    }
  for (const Event& e : m.events) {
    all.insert(all.end(), {e.time, e.margins.grazing, e.margins.stick_slip});
    for (const Contact& c : e.contacts) add(c.impulse), add(c.at.normal), add(c.at.point);
  }
  for (int b = 0; b < static_cast<int>(m.world_lines.size()); ++b)
    for (double t : {0.3 * m.end, m.end}) add(flatten(m.stateAt(b, t)));
  return all;
}

void expectSameBits(const Motion& m, const Motion& n) {
  EXPECT_EQ(m.signature(), n.signature());
  EXPECT_EQ(m.message, n.message);
  const std::vector<double> a = numbersOf(m), b = numbersOf(n);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_TRUE(sameBits(a[i], b[i])) << "number " << i << ": " << a[i] << " and " << b[i];
}

TEST(Invariant, SimulatingTwiceGivesTheSameBits) {
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene s = randomScene(seed);
    OdeContacts used(s);
    const Motion m = simulate(s, used, 0.5);
    const Motion again = simulate(s, used, 0.5);
    expectSameBits(m, again);
    expectSameBits(m, play(s, 0.5));
  }
}

TEST(Invariant, DifferentiatingChangesNothing) {
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene s = randomScene(seed);
    const Motion m = play(s, 0.5, 20);
    const std::vector<double> before = numbersOf(m);
    const SceneGradient first = gradientOf(m, 0, m.end, 1), second = gradientOf(m, 0, m.end, 1);
    const std::vector<double> after = numbersOf(m);
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_TRUE(sameBits(before[i], after[i]));
    const Eigen::VectorXd a = flatten(first), b = flatten(second);
    for (Eigen::Index i = 0; i < a.size(); ++i) ASSERT_TRUE(sameBits(a[i], b[i])) << "gradient entry " << i;
  }
}

// The order of the bodies in the scene has no meaning.
TEST(Invariant, ReversedBodiesMoveAlike) {
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene s = randomScene(seed);
    Scene r = s;
    std::reverse(r.bodies.begin(), r.bodies.end());
    const Motion m = play(s, 0.4, 4), n = play(r, 0.4, 4);
    ASSERT_EQ(m.events.size(), n.events.size());
    const double T = std::min(m.end, n.end);
    const int last = static_cast<int>(s.bodies.size()) - 1;
    for (int b = 0; b < last; ++b) {
      // impacts magnify rounding as they do any other change
      const double growth = std::max(1.0, flatten(gradientOf(m, b, T, 0)).cwiseAbs().maxCoeff() / 10);
      BodyState x = m.stateAt(b, T), y = n.stateAt(last - b, T);
      expectEntries(flatten(x), flatten(y), 1e-12, "state of " + std::to_string(b), growth);
      for (int i = 0; i < 12; ++i) {
        SceneGradient g = gradientOf(m, b, T, i), h = gradientOf(n, last - b, T, i);
        std::reverse(h.bodies.begin(), h.bodies.end());
        const Eigen::VectorXd expected = flatten(g);
        expectEntries(flatten(h), expected, 1e-9, "gradient of number " + std::to_string(i),
                      std::max(1.0, expected.cwiseAbs().maxCoeff()));
      }
    }
  }
}

}  // namespace
}  // namespace carom
