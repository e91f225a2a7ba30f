// SPDX-License-Identifier: MIT
// Rows and objectives of the caller: the same as built-in ones where they are the same, closed forms, and what is refused.

#include "editing/motion_function.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/controls/natural_scales.hpp"
#include "editing/problem/hessian.hpp"
#include "editing/solve/edit_evaluator.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;

/// |v| of a body at a time; with its second derivatives, or without.
MotionFunction speedAt(const std::string& body, double t, double scale, bool second_order) {
  MotionFunction f;
  f.name = "speed of " + body;
  f.scale = scale;
  f.until = t;
  f.read = [=](const Motion& motion) {
    const Vec3 v = motion.stateAt(body, t).velocity;
    const double speed = v.norm();
    const Vec3 u = v / speed;
    RowReading reading;
    reading.value = speed;
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = bodyIndex(*motion.scene, body);
    seed.at = Instant::at(t);
    seed.velocity = u;
    reading.second_order = second_order;
    if (second_order)
      reading.seed_rates = [u, speed](std::span<const BodyStateRate> rates) {
        std::vector<StateSeed> d(1);
        d[0].velocity = (rates[0].velocity - u.dot(rates[0].velocity) * u) / speed;
        return d;
      };
    return reading;
  };
  return f;
}

void expectFound(const EditResult& result) {
  EXPECT_TRUE(result.solved()) << nameOf(result.status) << ": " << result.message;
  EXPECT_TRUE(result.scaled_residual <= 1e-9) << result.scaled_residual;
}

/// Of the values after, relative to 1.
void expectSameChanges(const EditResult& a, const EditResult& b, double tolerance) {
  ASSERT_EQ(a.changed.size(), b.changed.size());
  for (std::size_t i = 0; i < a.changed.size(); ++i)
    EXPECT_TRUE(std::abs(a.changed[i].after - b.changed[i].after) <= tolerance * (1 + std::abs(b.changed[i].after)))
        << a.changed[i].name << ": " << a.changed[i].after << " and " << b.changed[i].after;
}

std::vector<Control> boxControls() { return {velocity("box"), angularVelocity("box"), elasticity("felt")}; }

// At 2 m/s the smallest change lies within its impact sequence; at 2.2 m/s on a boundary, where it is found to 1e-4 alone, so
// that only what goes the same way ends at the same place.
TEST(MotionFunction, RowIsTheBuiltInOne) {
  for (const double speed : {2.0, 2.2}) {
    SCOPED_TRACE(speed);
    const Scene scene = thrownBox();
    OdeContacts contacts(scene);
    const double scale = naturalScales(scene, 1).velocity;
    Edit built_in(scene, contacts, 0.8), own(scene, contacts, 0.8), secant(scene, contacts, 0.8);
    for (Edit* edit : {&built_in, &own, &secant}) {
      for (const Control& control : boxControls()) edit->vary(control);
      edit->nail("box", 0.7).position({1.1, any, any});
    }
    built_in.nail("box", 0.6).speed(speed);
    own.require(speedAt("box", 0.6, scale, true), speed);
    secant.require(speedAt("box", 0.6, scale, false), speed);
    const EditResult a = built_in.solve(), b = own.solve(), c = secant.solve();
    expectFound(a), expectFound(b), expectFound(c);
    expectSameChanges(b, a, 1e-13);
    if (speed == 2.0) expectSameChanges(c, a, 1e-6);
    EXPECT_TRUE(std::abs(c.objective - a.objective) <= 1e-3 * a.objective) << c.objective << " and " << a.objective;
    EXPECT_EQ(b.residuals.back().name, "'speed of box'");
    EXPECT_EQ(b.residuals.back().constraint, -1);
  }
}

TEST(MotionFunction, RangeIsReachedAtItsNearEnd) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.8);
  edit.vary(velocity("box"));
  edit.require(speedAt("box", 0.3, 1, false), within(4, 5));
  const EditResult result = edit.solve();
  expectFound(result);
  EXPECT_NEAR(result.motion.stateAt("box", 0.3).velocity.norm(), 4, 1e-7);
}

/// A ball thrown at a wall, and half the square of its speed when it hits it.
Scene ballAndWall() {
  Scene scene;
  scene.materials = {material("rubber", 0.5, 0.3)};
  scene.bodies = {fixedPlane("floor", "rubber", {0, 0, 1}, 0), fixedPlane("wall", "rubber", {-1, 0, 0}, -3.1),
                  ball("ball", "rubber", 0.1, {0, 0, 1}, {7, 0.3, 3})};
  return scene;
}

MotionFunction hardness(bool second_order, double factor = 1) {
  MotionFunction f;
  f.name = "hardness";
  f.until = nthImpact(1);
  f.body = "ball";
  f.read = [=](const Motion& motion) {
    const int body = bodyIndex(*motion.scene, "ball"), event = motion.findImpact(body, 1).value();
    const Vec3 v = motion.stateBefore(event, body).velocity;
    RowReading reading;
    reading.value = 0.5 * factor * v.squaredNorm();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = body;
    seed.at = Instant::before(event);
    seed.velocity = factor * v;
    reading.second_order = second_order;
    if (second_order)
      reading.seed_rates = [factor](std::span<const BodyStateRate> rates) {
        std::vector<StateSeed> d(1);
        d[0].velocity = factor * rates[0].velocity;
        return d;
      };
    return reading;
  };
  return f;
}

// v^2 = g (h + sqrt(h^2 + d^2)) is the least square of a throw's speed to a mark h above and d away.
TEST(MotionFunction, ObjectiveFindsTheSoftestHit) {
  const Scene scene = ballAndWall();
  OdeContacts contacts(scene);
  const double h = 0.5, d2 = 9 + 0.04, g = 9.81;
  const double least = g * (h + std::sqrt(h * h + d2)) - 2 * g * h;
  for (bool second_order : {true, false}) {
    for (int threads : {1, 2}) {
      Edit edit(scene, contacts, 2);
      edit.vary(velocity("ball"));
      edit.nail("ball", nthImpact(1, "wall")).position({any, 0.2, 1.5});
      edit.minimise(hardness(second_order));
      EditOptions options;
      options.threads = threads;
      const EditResult result = edit.solve(options);
      expectFound(result);
      EXPECT_NEAR(2 * result.objective, least, (second_order ? 1e-9 : 1e-7) * least) << second_order;
      EXPECT_NEAR(result.motion.stateBefore(0, 2).velocity.squaredNorm(), least, 1e-7 * least);
    }
  }
}

// It is minimised from a start that meets the constraints already, and without any.
TEST(MotionFunction, ObjectiveCountsWhereNothingElseIsAsked) {
  const Scene scene = ballAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball").within(-10, 10));
  MotionFunction f = speedAt("ball", 0.1, 1, false);
  f.read = [](const Motion& motion) {  // |x - (0.5, 0.1, 1)|^2 at 0.1 s
    const Vec3 off = motion.stateAt("ball", 0.1).position - Vec3(0.5, 0.1, 1);
    RowReading reading;
    reading.value = off.squaredNorm();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = 2;
    seed.at = Instant::at(0.1);
    seed.position = 2 * off;
    return reading;
  };
  edit.minimise(f);
  const EditResult result = edit.solve();
  expectFound(result);
  EXPECT_LE(result.objective, 1e-10);
  EXPECT_NEAR((result.motion.stateAt("ball", 0.1).position - Vec3(0.5, 0.1, 1)).norm(), 0, 1e-5);
}

// The change itself as an objective of one's own, and beside nothing at all.
TEST(MotionFunction, ObjectiveBesideTheChange) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const double s = naturalScales(scene, 1).velocity;
  const Vec3 v0 = scene.bodies[1].velocity;
  MotionFunction change;
  change.name = "change of the velocity";
  change.until = 0.01;
  change.read = [s, v0](const Motion& motion) {
    const Vec3 z = (motion.stateAt("box", 0).velocity - v0) / s;
    RowReading reading;
    reading.value = 0.5 * z.squaredNorm();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = 1;
    seed.at = Instant::at(0);
    seed.velocity = z / s;
    reading.second_order = true;
    reading.seed_rates = [s](std::span<const BodyStateRate> rates) {
      std::vector<StateSeed> d(1);
      d[0].velocity = rates[0].velocity / (s * s);
      return d;
    };
    return reading;
  };
  const auto solve = [&](int own, double weight) {
    Edit edit(scene, contacts, 0.8);
    edit.vary(velocity("box"));
    edit.nail("box", 0.7).position({0.9, any, any});
    if (own) edit.minimise(change, weight);
    EditResult result = edit.solve();
    expectFound(result);
    return result;
  };
  const EditResult built_in = solve(0, 0), alone = solve(1, 0), both = solve(1, 2);
  expectSameChanges(alone, built_in, 1e-6);
  expectSameChanges(both, built_in, 1e-6);
  EXPECT_NEAR(alone.objective, built_in.objective, 1e-7 * built_in.objective);
  EXPECT_NEAR(both.objective, 3 * built_in.objective, 3e-7 * built_in.objective);
}

TEST(MotionFunction, SecondDerivativesOfTheObjective) {
  const Scene scene = ballAndWall();
  OdeContacts contacts(scene);
  OwnFunctions own;
  own.objective = hardness(true, 0.7);
  own.objective->scale = 3;
  const EditProblem problem(scene, contacts, 2, {velocity("ball"), position("ball"), gravity()}, {}, own);
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(problem.unknowns(), -0.02, 0.03);
  const auto gradient = [&](const Eigen::VectorXd& y) {
    const EditPointPtr point = pointAt(problem, y, problem.horizon, false);
    differentiateObjective(problem, *point);
    return *point->objective_gradient;
  };
  const EditPointPtr point = pointAt(problem, at, problem.horizon, false);
  const Eigen::MatrixXd H = rowsHessian(problem, at, point->motion, point->rows, Eigen::VectorXd(0), 1.0 / 3);
  const double h = 1e-4;
  for (int j = 0; j < problem.unknowns(); ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(at.size(), j);
    const double slope = (pointAt(problem, at + step, problem.horizon, false)->objective -
                          pointAt(problem, at - step, problem.horizon, false)->objective) /
                         (2 * h);
    EXPECT_NEAR(gradient(at)[j], slope, 1e-6);
    const Eigen::VectorXd expected = (gradient(at + step) - gradient(at - step)) / (2 * h);
    for (int i = 0; i < problem.unknowns(); ++i) EXPECT_NEAR(H(i, j), expected[i], 1e-6);
  }
}

TEST(MotionFunction, WhatItThrowsComesOut) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  for (int call : {1, 2, 5}) {
    for (int threads : {1, 2}) {
      for (bool objective : {false, true}) {
        std::atomic<int> calls = 0;
        MotionFunction f = speedAt("box", 0.6, 1, false);
        f.read = [&calls, call, read = f.read](const Motion& motion) {
          if (++calls >= call) throw std::runtime_error("own trouble");
          return read(motion);
        };
        Edit edit(scene, contacts, 0.8);
        for (const Control& control : boxControls()) edit.vary(control);
        edit.nail("box", 0.7).position({0.9, any, any});
        objective ? edit.minimise(f) : edit.require(f, 2.2);
        EditOptions options;
        options.threads = threads;
        try {
          edit.solve(options);
          ADD_FAILURE() << "nothing came of call " << call;
        } catch (const std::runtime_error& error) {
          EXPECT_STREQ(error.what(), "own trouble");
        }
      }
    }
  }
}

TEST(MotionFunction, WhatIsMissingIsSaid) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  MotionFunction late = speedAt("box", 0.6, 1, false);
  late.until = nthImpact(40, "floor"), late.body = "box";
  MotionFunction lacks = speedAt("box", 0.6, 1, false);
  lacks.read = [](const Motion&) {
    RowReading reading;
    reading.missing = "It is not to be had.";
    return reading;
  };
  MotionFunction rests = speedAt("box", 0.6, 1, false);
  rests.read = [](const Motion&) {
    RowReading reading;
    reading.doubt = "there is no slope";
    return reading;
  };
  const std::pair<MotionFunction, const char*> table[] = {
      {late, "Impact 40 with 'floor' of 'box' does not come within 0.8 s; 'speed of box' is read after it."},
      {lacks, "It is not to be had."},
      {rests, "There is no slope."}};
  for (const auto& [function, message] : table) {
    for (bool objective : {false, true}) {
      Edit edit(scene, contacts, 0.8);
      edit.vary(velocity("box"));
      objective ? edit.minimise(function) : edit.require(function, 2);
      const EditResult result = edit.solve();
      EXPECT_FALSE(result.solved());
      EXPECT_NE(result.message.find(message), std::string::npos) << result.message;
    }
  }
}

struct BadFunction {
  const char* name;
  void (*spoil)(MotionFunction&);
  const char* says;
};

template <class Spoil>
void spoilReading(MotionFunction& f, Spoil spoil) {
  f.read = [read = f.read, spoil](const Motion& motion) {
    RowReading reading = read(motion);
    spoil(reading);
    return reading;
  };
}

const BadFunction kBadFunctions[] = {
    {"name", [](MotionFunction& f) { f.name.clear(); }, "found no name"},
    {"function", [](MotionFunction& f) { f.read = nullptr; }, "found no function"},
    {"scale", [](MotionFunction& f) { f.scale = 0; }, "/scale: found 0, expected a number > 0"},
    {"span", [](MotionFunction& f) { f.until = between(0.1, 0.2); }, "/until: found a span"},
    {"late", [](MotionFunction& f) { f.until = 0.9; }, "/until: found 0.9, expected a time in [0, 0.8]"},
    {"body", [](MotionFunction& f) { f.body = "box"; }, "/body: found 'box' beside a time"},
    {"nobody", [](MotionFunction& f) { f.until = nthImpact(1), f.body = "bix"; }, "/body: "},
    {"with", [](MotionFunction& f) { f.until = nthImpact(1, "bix"), f.body = "box"; }, "/until/with: "},
    {"value", [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.value = kNaN; }); }, "found the value nan"},
    {"seeds", [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.seeds.clear(); }); }, "found no seeds"},
    {"seedBody", [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.seeds[0].body = 2; }); }, "body"},
    {"seedTime",
     [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.seeds[0].at = Instant::at(9); }); },
     "time"},
    {"seedEvent",
     [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.seeds[0].at = Instant::before(99); }); },
     "event"},
    {"seedSize",
     [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.seeds[0].size = Eigen::VectorXd::Ones(2); }); },
     "weights of dimensions"},
    {"seedNumber",
     [](MotionFunction& f) { spoilReading(f, [](RowReading& r) { r.seeds[0].velocity[1] = INFINITY; }); },
     "weight"},
    {"rates",
     [](MotionFunction& f) {
       spoilReading(f, [](RowReading& r) {
         r.second_order = true;
         r.seed_rates = [](std::span<const BodyStateRate>) { return std::vector<StateSeed>(3); };
       });
     },
     "found rates of 3 seeds, expected 1"},
};

class FunctionMistake : public testing::TestWithParam<BadFunction> {};

TEST_P(FunctionMistake, IsNamed) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  for (bool objective : {false, true}) {
    MotionFunction f = speedAt("box", 0.6, 1, false);
    GetParam().spoil(f);
    Edit edit(scene, contacts, 0.8);
    edit.vary(velocity("box"));
    objective ? edit.minimise(f) : edit.require(f, 2.2);
    try {
      edit.solve();
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find(objective ? "minimise" : "require 0"), 0u) << what;
      EXPECT_NE(what.find(GetParam().says), std::string::npos) << what;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, FunctionMistake, testing::ValuesIn(kBadFunctions),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(MotionFunction, WantedAndWeightAreChecked) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  for (const Wanted& wanted : {Wanted(any), Wanted(3, 2), Wanted(INFINITY), atLeast(INFINITY)}) {
    Edit edit(scene, contacts, 0.8);
    edit.require(speedAt("box", 0.6, 1, false), wanted);
    EXPECT_THROW(edit.solve(), InputError);
  }
  for (double weight : {-1.0, kNaN}) {
    Edit edit(scene, contacts, 0.8);
    edit.minimise(speedAt("box", 0.6, 1, false), weight);
    EXPECT_THROW(edit.solve(), InputError);
  }
}

}  // namespace
}  // namespace carom
