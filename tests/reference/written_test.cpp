// SPDX-License-Identifier: MIT
// Bodies with a centre of mass and principal axes of their own, of every shape, against 50 digits that start from what
// is written: states as people read them, and their derivatives by every number of the scene, sizes among them.

#include <gtest/gtest.h>

#include <iostream>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/second_order/second_order.h"
#include "adjoint/simulate/simulate.h"
#include "tests/reference/worst.h"
#include "tests/reference/written_replay.h"
#include "tests/support/offset_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/swept_points.h"

namespace carom::reference {
namespace {

struct Thrown {
  Scene scene;
  Motion motion;
  int body, floor;
  ThrowNumbers numbers;
  std::vector<PointImpact> impacts;
};

Thrown thrown(const test::OffsetScene& row, bool floor_first) {
  Scene scene = floor_first ? test::floorFirst(row.scene()) : row.scene();
  const int body = floor_first ? 1 : 0, floor = 1 - body;
  test::SweptPointContacts contacts(scene);
  Motion motion = simulate(scene, contacts, row.duration);
  std::vector<PointImpact> impacts;
  for (const Event& e : motion.events) impacts.push_back({e.contacts.at(0).features.a, e.mode, e.time});
  ThrowNumbers numbers = throwNumbers(scene, body, floor);
  return {std::move(scene), std::move(motion), body, floor, std::move(numbers), std::move(impacts)};
}

class WrittenThrow : public testing::TestWithParam<std::tuple<std::size_t, bool>> {
 protected:
  const test::OffsetScene& row() const { return test::offsetScenes()[std::get<0>(GetParam())]; }
  Thrown throwIt() const { return thrown(row(), std::get<1>(GetParam())); }
};

TEST_P(WrittenThrow, StatesAndTimes) {
  const Thrown t = throwIt();
  ASSERT_EQ(t.motion.status, MotionStatus::complete) << t.motion.message;
  const std::vector<WrittenState> states = replay(t.numbers, t.impacts, row().duration, true);
  double worst_state = 0, worst_time = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const WrittenState& expected = states[k];
    const bool at_end = k == t.impacts.size();
    const BodyState found =
        at_end ? t.motion.stateAt(t.body, row().duration) : t.motion.stateBefore(static_cast<int>(k), t.body);
    if (!at_end) keepWorst(worst_time, std::abs(t.motion.events[k].time - static_cast<double>(expected.time)));
    const auto compare = [&](const Vec3& f, const Vec3& e) {
      for (int i = 0; i < 3; ++i) keepWorst(worst_state, std::abs(f[i] - e[i]) / std::max(1.0, std::abs(e[i])));
    };
    compare(found.position, expected.position.rounded());
    compare(found.velocity, expected.velocity.rounded());
    compare(found.angular_velocity, expected.spin.rounded());
    const Mat3 R = rounded(expected.R);
    for (int j = 0; j < 3; ++j) compare(found.orientation * Vec3::Unit(j), R.col(j));
  }
  std::cout << row().name << ": " << t.impacts.size() << " impacts, worst state " << worst_state << ", worst time "
            << worst_time << " s\n";
  EXPECT_LE(worst_state, kStateTolerance);
  EXPECT_LE(worst_time, kTimeTolerance);
}

/// The 13 numbers of one moment by every number of the scene: at event k, or at the end.
std::vector<SceneGradient> gradientsOf(DerivativeTape& tape, int body, const Instant& at, int numbers) {
  std::vector<SceneGradient> gradients;
  for (int i = 0; i < numbers; ++i) {
    StateSeed seed;
    seed.body = body, seed.at = at;
    Vec3* const parts[] = {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity};
    (i == 12 ? seed.time : (*parts[i / 3])[i % 3]) = 1;
    gradients.push_back(adjoint(tape, std::vector{seed}));
  }
  return gradients;
}

TEST_P(WrittenThrow, Gradients) {
  const Thrown t = throwIt();
  DerivativeTape tape(t.motion);
  std::vector<std::vector<SceneGradient>> moments;
  for (std::size_t k = 0; k < t.impacts.size(); ++k)
    moments.push_back(gradientsOf(tape, t.body, Instant::before(static_cast<int>(k)), 13));
  moments.push_back(gradientsOf(tape, t.body, Instant::at(row().duration), 12));

  double worst = 0;
  std::string where = "none";
  const std::vector<ThrowKnob> knobs = throwKnobs(t.numbers, t.body, t.floor);
  const std::vector<MomentRates> columns = replayDerivatives(t.numbers, t.impacts, row().duration, knobs);
  for (const ThrowKnob& knob : knobs) {
    const MomentRates& expected = columns[static_cast<std::size_t>(&knob - knobs.data())];
    ASSERT_EQ(expected.size(), moments.size());
    double scale = kSmallestScale;
    for (const auto& e : expected) scale = std::max(scale, e.cwiseAbs().maxCoeff());
    for (std::size_t k = 0; k < moments.size(); ++k)
      for (std::size_t i = 0; i < moments[k].size(); ++i) {
        const double found = knob.entry(moments[k][i]), wanted = expected[k][static_cast<Eigen::Index>(i)];
        const double error = std::abs(found - wanted) / scale;
        if (error <= worst) continue;
        keepWorst(worst, error);
        where = "number " + std::to_string(i) + " of moment " + std::to_string(k) + " by " + knob.name + ": found " +
                std::to_string(found) + ", expected " + std::to_string(wanted);
      }
  }
  std::cout << row().name << ": worst of " << knobs.size() << " columns " << worst << ": " << where << '\n';
  EXPECT_LE(worst, kGradientTolerance) << where;
}

// The rate of all of that along a random direction of every number of the scene: mass properties and sizes, whose rates
// depend on the sizes, among them.
TEST_P(WrittenThrow, SecondDerivatives) {
  const Thrown t = throwIt();
  DerivativeTape tape(t.motion);
  const std::vector<ThrowKnob> knobs = throwKnobs(t.numbers, t.body, t.floor);
  test::Random random(7);
  std::vector<double> direction;
  ReadingDirection along{SceneTangent(t.scene), {}};
  for (const ThrowKnob& knob : knobs) {
    // sizes by a share of theirs, so that none of them decides alone
    direction.push_back(random.in(-1, 1) * (knob.name.starts_with("size") ? 0.1 : 1));
    knob.entry(along.scene) = direction.back();
  }
  std::vector<std::vector<SceneGradient>> moments;
  for (std::size_t k = 0; k <= t.impacts.size(); ++k) {
    const bool at_end = k == t.impacts.size();
    const Instant at = at_end ? Instant::at(row().duration) : Instant::before(static_cast<int>(k));
    std::vector<SceneGradient>& rates = moments.emplace_back();
    for (int i = 0; i < (at_end ? 12 : 13); ++i) {
      StateSeed seed;
      seed.body = t.body, seed.at = at;
      Vec3* const parts[] = {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity};
      (i == 12 ? seed.time : (*parts[i / 3])[i % 3]) = 1;
      rates.push_back(secondOrder(tape, {&seed, 1}, {}, {&along, 1}).gradient_rates[0]);
    }
  }
  double worst = 0;
  std::string where = "none";
  std::vector<ThrowKnob> columns_of = knobs;
  if (t.numbers.body.inertia_derived) columns_of.push_back(inertiaOfMass());
  const auto columns =
      replaySecondDerivatives(t.numbers, t.impacts, row().duration, knobs, direction, columns_of);
  for (const ThrowKnob& knob : knobs) {
    const MomentRates& expected = columns[static_cast<std::size_t>(&knob - knobs.data())];
    double scale = kSmallestScale;
    const auto include = [&scale](const auto& column) {
      for (const auto& e : column) scale = std::max(scale, e.cwiseAbs().maxCoeff());
    };
    include(expected);
    if (t.numbers.body.inertia_derived && (knob.name == "mass" || knob.name == "density")) include(columns.back());
    for (std::size_t k = 0; k < moments.size(); ++k)
      for (std::size_t i = 0; i < moments[k].size(); ++i) {
        const double found = knob.entry(moments[k][i]), wanted = expected[k][static_cast<Eigen::Index>(i)];
        const double error = std::abs(found - wanted) / scale;
        if (error <= worst) continue;
        keepWorst(worst, error);
        where = "number " + std::to_string(i) + " of moment " + std::to_string(k) + " by " + knob.name + ": found " +
                std::to_string(found) + ", expected " + std::to_string(wanted);
      }
  }
  std::cout << row().name << ": worst of " << knobs.size() << " columns of rates " << worst << ": " << where << '\n';
  EXPECT_LE(worst, kGradientTolerance) << where;
}

INSTANTIATE_TEST_SUITE_P(Rows, WrittenThrow,
                         testing::Combine(testing::Range<std::size_t>(0, test::offsetScenes().size()), testing::Bool()),
                         [](const auto& row) {
                           return std::string(test::offsetScenes()[std::get<0>(row.param)].name) +
                                  (std::get<1>(row.param) ? "_floor_first" : "");
                         });

// The rows are about impacts too, not only flight.
TEST(WrittenThrow, MostRowsStrikeTheFloorTwice) {
  int twice = 0, sliding = 0, sticking = 0;
  for (const test::OffsetScene& row : test::offsetScenes()) {
    const Thrown t = thrown(row, false);
    twice += t.impacts.size() >= 2;
    for (const PointImpact& i : t.impacts) (i.mode == ImpactMode::slide ? sliding : sticking) += 1;
  }
  EXPECT_GE(twice, 14);
  EXPECT_GE(sliding, 3);
  EXPECT_GE(sticking, 3);
}

}  // namespace
}  // namespace carom::reference
