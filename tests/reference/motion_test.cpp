// SPDX-License-Identifier: MIT
// The product against the reference, on every row of the table of cases, in both orders of the bodies.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/simulate/simulate.h"
#include "tests/reference/cases.h"
#include "tests/reference/replay.h"
#include "tests/reference/replayed.h"
#include "tests/reference/worst.h"

namespace carom::reference {

using namespace adjoint_detail;

namespace {

Vec3 turnBetween(const Quat& from, const Quat& to) {
  const Quat d = to * from.conjugate();
  return 2 * (d.w() < 0 ? -1 : 1) * d.vec();
}

/// Largest difference of two states, each component by its own size, at least 1.
double difference(const BodyState& found, const BodyState& expected) {
  double error = 0;
  const auto compare = [&error](const Vec3& f, const Vec3& e) {
    for (int i = 0; i < 3; ++i) keepWorst(error, std::abs(f[i] - e[i]) / std::max(1.0, std::abs(e[i])));
  };
  compare(turnBetween(expected.orientation, found.orientation), Vec3::Zero());
  compare(found.position, expected.position);
  compare(found.velocity, expected.velocity);
  compare(found.angular_velocity, expected.angular_velocity);
  return error;
}

struct Worst {
  double error = 0;
  std::string where = "none";
};

/// The reference's matrix: a column for each knob, an entry for each row.
using Columns = std::vector<std::vector<double>>;

Columns columnsOf(const Replayed& r, const std::vector<Knob>& knobs, const std::vector<Row>& rows, ImpactTimes times) {
  Columns columns;
  for (const Knob& knob : knobs) columns.push_back(r.reference.derivative(knob, rows, times));
  return columns;
}

/// Compares a matrix with the reference's entry by entry; `found(row, knob)` is the product's entry.
Worst compare(const Columns& expected, const std::vector<Knob>& knobs, const std::vector<Row>& rows,
              const auto& found) {
  Worst worst;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    double scale = kSmallestScale;
    for (const double e : expected[k]) scale = std::max(scale, std::abs(e));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double value = found(i, knobs[k]);
      const double error = std::abs(value - expected[k][i]) / scale;
      if (error <= worst.error || std::isnan(worst.error)) continue;
      worst.error = error;
      worst.where = "d(" + describe(rows[i]) + ")/d(" + knobs[k].name + ") = " + std::to_string(value) + ", expected " +
                    std::to_string(expected[k][i]) + ", column's scale " + std::to_string(scale);
    }
  }
  return worst;
}

class MotionAgainstReference : public testing::TestWithParam<std::tuple<std::size_t, bool>> {
 protected:
  const Case& row() const { return cases()[std::get<0>(GetParam())]; }
  bool backwards() const { return std::get<1>(GetParam()); }
  Replayed replay() const { return replayOf(row(), backwards()); }
};

TEST_P(MotionAgainstReference, Sequence) {
  const Replayed r = replay();
  ASSERT_EQ(r.motion.status, MotionStatus::complete) << r.motion.message;
  const Sequence scouted = scout(r.scene, row().duration);
  ASSERT_EQ(r.motion.events.size(), row().modes.size());
  ASSERT_EQ(scouted.size(), row().modes.size());
  for (std::size_t i = 0; i < scouted.size(); ++i) {
    const Event& event = r.motion.events[i];
    const int n = static_cast<int>(i);
    EXPECT_EQ(event.mode, row().modes[i]) << "event " << i;
    EXPECT_EQ(r.reference.mode(n), row().modes[i]) << "event " << i;
    EXPECT_NE(r.reference.features(n).find(row().features[i]), std::string::npos) << r.reference.features(n);
    EXPECT_EQ(std::minmax(event.contacts[0].a, event.contacts[0].b), std::minmax(scouted[i].a, scouted[i].b));
    EXPECT_NEAR(event.time, scouted[i].time, 1e-11);
  }
}

TEST_P(MotionAgainstReference, StatesAndTimes) {
  const Replayed r = replay();
  double worst_state = 0, worst_time = 0;
  for (int event = 0; event < r.reference.events(); ++event) {
    const Event& e = r.motion.events[event];
    keepWorst(worst_time, std::abs(e.time - r.reference.eventTime(event)));
    for (const Participant& p : e.participants) {
      keepWorst(worst_state, difference(r.motion.stateBefore(event, p.body), r.reference.stateBefore(event, p.body)));
    }
    for (int i = 0; i < 3; ++i) {
      keepWorst(worst_state, std::abs(e.contacts[0].impulse[i] - r.reference.impulse(event)[i]));
    }
  }
  constexpr int kTimes = 11;
  for (int k = 0; k <= kTimes; ++k) {
    const double t = row().duration * k / kTimes;
    for (int body = 0; body < static_cast<int>(r.scene.bodies.size()); ++body) {
      keepWorst(worst_state, difference(r.motion.stateAt(body, t), r.reference.stateAt(body, t)));
    }
  }
  std::cout << row().name << ": worst state " << worst_state << ", worst event time " << worst_time << " s\n";
  EXPECT_LE(worst_state, kStateTolerance);
  EXPECT_LE(worst_time, kTimeTolerance);
}

TEST_P(MotionAgainstReference, Gradients) {
  const Replayed r = replay();
  const std::vector<Row> rows = rowsOf(r, row().duration);
  const std::vector<Knob> knobs = knobsOf(r.scene);
  const Columns expected = columnsOf(r, knobs, rows, ImpactTimes::follow);
  DerivativeTape tape(r.motion);

  std::vector<SceneGradient> gradients;
  for (const Row& one : rows) gradients.push_back(adjoint(tape, std::vector{seedOf(one)}));
  const auto by_adjoint = [&](std::size_t i, const Knob& knob) { return entryOf(gradients[i], knob); };
  const Worst worst = compare(expected, knobs, rows, by_adjoint);
  std::cout << row().name << ": worst of " << rows.size() << " x " << knobs.size() << " entries " << worst.error << ": "
            << worst.where << '\n';
  EXPECT_LE(worst.error, kGradientTolerance) << worst.where;

  std::string current;
  MotionTangent pass;
  const auto by_tangent = [&](std::size_t i, const Knob& knob) {
    if (current != knob.name) {
      SceneTangent direction(r.scene);
      entryOf(direction, knob) = 1;
      pass = tangent(tape, direction);
      current = knob.name;
    }
    const StateSeed seed = seedOf(rows[i]);
    return pass.at(seed.body, seed.at).dot(seed);
  };
  const Worst worst_tangent = compare(expected, knobs, rows, by_tangent);
  EXPECT_LE(worst_tangent.error, kGradientTolerance) << worst_tangent.where;

  // Impact times that stay where they are are what fixed-step engines differentiate; against that the same gradient is
  // wrong by far, so the tolerances above do see the term.
  if (backwards()) return;
  const Columns frozen = columnsOf(r, knobs, rows, ImpactTimes::frozen);
  EXPECT_GT(compare(frozen, knobs, rows, by_adjoint).error, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Cases, MotionAgainstReference,
                         testing::Combine(testing::Range<std::size_t>(0, cases().size()), testing::Bool()),
                         [](const auto& test) {
                           return std::string(cases()[std::get<0>(test.param)].name) +
                                  (std::get<1>(test.param) ? "_reversed" : "");
                         });

}  // namespace
}  // namespace carom::reference
