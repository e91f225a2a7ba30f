// SPDX-License-Identifier: MIT
// Second derivatives against differences of differences in 50 digits, on every row of the table of cases, in both
// orders of the bodies: the rate of every entry of the gradient of every row, along random directions of each kind of
// knob, of all of them together, and of the reading time.

#include "adjoint/second_order/second_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "adjoint/derivative/adjoint.h"
#include "tests/reference/replayed.h"
#include "tests/reference/worst.h"

namespace carom::reference {
namespace {

constexpr double kValueTolerance = 1e-13;  ///< of the gradient that is found on the way, of the column's scale

struct Along {
  std::string name;
  std::vector<double> by_knob;
  double time = 0;
};

std::vector<Along> directionsOf(const std::vector<Knob>& knobs) {
  std::mt19937_64 random(20260);
  const auto number = [&random] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  std::vector<Along> all;
  for (const Knob& knob : knobs) {
    const std::size_t k = static_cast<std::size_t>(&knob - knobs.data());
    const bool same = k > 0 && knobs[k - 1].kind == knob.kind;
    if (!same) all.push_back({knob.name.substr(0, knob.name.find('[')), std::vector<double>(knobs.size(), 0.0), 0});
    all.back().by_knob[k] = number();
  }
  Along everything{"everything", {}, number()};
  for (std::size_t k = 0; k < knobs.size(); ++k) everything.by_knob.push_back(number());
  all.push_back(everything);
  all.push_back({"time", std::vector<double>(knobs.size(), 0.0), 1});
  return all;
}

std::vector<ReadingDirection> readingDirections(const Scene& scene, const std::vector<Knob>& knobs,
                                                const std::vector<Along>& along, bool at_time) {
  std::vector<ReadingDirection> out;
  for (const Along& a : along) {
    ReadingDirection d{SceneTangent(scene), Eigen::VectorXd::Constant(1, at_time ? a.time : 0)};
    for (std::size_t k = 0; k < knobs.size(); ++k) entryOf(d.scene, knobs[k]) = a.by_knob[k];
    out.push_back(std::move(d));
  }
  return out;
}

// The velocity of a surface counts by its part along the surface: the column of a component along the normal is what rounding leaves
// of the others, and is held to their scale.
bool isComparedWith(const Knob& knob, const Knob& other) {
  const bool one_surface = knob.name.starts_with("surface_") && knob.kind == other.kind && knob.index == other.index;
  return one_surface || &knob == &other;
}

class SecondOrderAgainstReference : public testing::TestWithParam<std::tuple<std::size_t, bool>> {};

TEST_P(SecondOrderAgainstReference, EveryEntry) {
  const Case& c = cases()[std::get<0>(GetParam())];
  const Replayed r = replayOf(c, std::get<1>(GetParam()));
  const std::vector<Row> rows = rowsOf(r, c.duration);
  const std::vector<Knob> knobs = knobsOf(r.scene);
  std::vector<Along> along = directionsOf(knobs);
  // all together, and the time; forwards also two kinds alone, other ones in each case, to keep the time small
  const std::size_t kinds = along.size() - 2, first = std::get<0>(GetParam()) * 2;
  std::vector<Along> kept(along.end() - 2, along.end());
  for (std::size_t i = first; i < first + 2 && !std::get<1>(GetParam()); ++i) kept.push_back(along[i % kinds]);
  along = std::move(kept);

  DerivativeTape tape(r.motion);
  std::vector<SecondOrder> found;
  std::vector<SceneGradient> gradients;
  for (const Row& row : rows) {
    const std::vector<StateSeed> seed{seedOf(row)};
    found.push_back(secondOrder(tape, seed, {}, readingDirections(r.scene, knobs, along, row.event < 0)));
    gradients.push_back(adjoint(tape, seed));
  }
  for (const Knob& knob : knobs) {
    double scale = kSmallestScale, difference = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const Knob& other : knobs)
        if (isComparedWith(knob, other)) scale = std::max(scale, std::abs(entryOf(gradients[i], other)));
      keepWorst(difference, std::abs(entryOf(gradients[i], knob) - entryOf(found[i].gradient, knob)));
    }
    EXPECT_LE(difference / scale, kValueTolerance) << knob.name;
  }

  double worst = 0;
  std::string where = "none";
  for (std::size_t d = 0; d < along.size(); ++d) {
    const auto columns = r.reference.secondDerivatives(along[d].by_knob, along[d].time, knobs, rows);
    for (const Knob& knob : knobs) {
      const std::vector<double>& expected = columns[static_cast<std::size_t>(&knob - knobs.data())];
      double scale = kSmallestScale;
      for (std::size_t other = 0; other < knobs.size(); ++other)
        if (isComparedWith(knob, knobs[other]))
          for (const double e : columns[other]) scale = std::max(scale, std::abs(e));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double value = entryOf(found[i].gradient_rates[d], knob), error = std::abs(value - expected[i]) / scale;
        if (error <= worst || std::isnan(worst)) continue;
        worst = error;
        where = "d^2(" + describe(rows[i]) + ")/d(" + knob.name + ") d(" + along[d].name +
                ") = " + std::to_string(value) + ", expected " + std::to_string(expected[i]) + ", column's scale " +
                std::to_string(scale);
      }
    }
  }
  std::cout << c.name << ": worst of " << rows.size() << " x " << knobs.size() << " x " << along.size() << " entries "
            << worst << ": " << where << '\n';
  EXPECT_LE(worst, kGradientTolerance) << where;
}

INSTANTIATE_TEST_SUITE_P(Cases, SecondOrderAgainstReference,
                         testing::Combine(testing::Range<std::size_t>(0, cases().size()), testing::Bool()),
                         [](const auto& test) {
                           return std::string(cases()[std::get<0>(test.param)].name) +
                                  (std::get<1>(test.param) ? "_reversed" : "");
                         });

}  // namespace
}  // namespace carom::reference
