// SPDX-License-Identifier: MIT
// Indices, times, weights and counts that make no sense: every public function of adjoint/ says so.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/scene/surface.h"
#include "adjoint/second_order/second_order.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN(), kUnbounded = std::numeric_limits<double>::infinity();

// A motion of three bodies with impacts, and what is made of it.
struct Made {
  Scene scene = makeScene({0, 0, -9.81}, 0.8, 0.3,
                          {makeBall("ball", 0.1, {0, 0, 1}, {0.4, 0, 0}),
                           makeBox("box", {0.2, 0.3, 0.4}, {2, 0, 1}, {0, 0.5, 0}),
                           makePlane("floor", Vec3::UnitZ(), 0)});
  OdeContacts contacts{scene};
  Motion motion = simulate(scene, contacts, 0.9);
  DerivativeTape tape{motion};
  SceneTangent direction{scene};
  MotionTangent moved = tangent(tape, direction);
  int events = static_cast<int>(motion.events.size());
};

StateSeed seedAt(int body, const Instant& at, double weight = 1) {
  StateSeed seed;
  seed.body = body, seed.at = at, seed.position = {weight, 0, 0};
  return seed;
}

struct Misuse {
  const char* name;
  std::function<void(Made&)> call;
  std::vector<std::string> words = {};  // of the sentence
};

void gradient(Made& m, const StateSeed& seed) { adjoint(m.tape, std::span(&seed, 1)); }

std::vector<Misuse> misusesOfMotions() {
  return {
      {"stateAt, body 7", [](Made& m) { m.motion.stateAt(7, 0.1); }, {"body 7", "from 0 to 2"}},
      {"stateAt, body -1", [](Made& m) { m.motion.stateAt(-1, 0.1); }, {"body -1"}},
      {"stateAt, no such name", [](Made& m) { m.motion.stateAt("nobody", 0.1); }, {"'nobody'", "'ball'"}},
      {"stateAt, after the end", [](Made& m) { m.motion.stateAt(0, 1); }, {"the time 1", "[0, 0.9"}},
      {"stateAt, NaN", [](Made& m) { m.motion.stateAt(0, kNotANumber); }, {"nan"}},
      {"stateBefore, event 99", [](Made& m) { m.motion.stateBefore(99, 0); }, {"event 99"}},
      {"stateBefore, event -1", [](Made& m) { m.motion.stateBefore(-1, 0); }, {"event -1"}},
      {"stateBefore, body 3", [](Made& m) { m.motion.stateBefore(0, 3); }, {"body 3"}},
      {"findImpact, body 3", [](Made& m) { m.motion.findImpact(3, 1); }, {"body 3"}},
      {"findImpact, impact 0", [](Made& m) { m.motion.findImpact(0, 0); }, {"impact 0", "1 (the first)"}},
      {"findImpact, with 3", [](Made& m) { m.motion.findImpact(0, 1, 3); }, {"other body 3"}},
      {"findImpact, with -2", [](Made& m) { m.motion.findImpact(0, 1, -2); }, {"other body -2"}},
      {"arcAt, body -1", [](Made& m) { m.motion.arcAt(-1, 0); }, {"body -1"}},
      {"arcAt, NaN", [](Made& m) { m.motion.arcAt(0, kNotANumber); }, {"time nan"}},
      {"describeEvent, after the last", [](Made& m) { m.motion.describeEvent(m.events); }, {"event"}},
      {"describeEvent, -1", [](Made& m) { m.motion.describeEvent(-1); }, {"event -1"}},
      {"materialIndexOf, body 3", [](Made& m) { materialIndexOf(m.scene, 3); }, {"body 3"}},
      {"simulate, a duration of NaN", [](Made& m) { simulate(m.scene, m.contacts, kNotANumber); }, {"nan"}},
      {"simulate, a duration of 2e9", [](Made& m) { simulate(m.scene, m.contacts, 2e9); }, {"2000000000"}},
      {"simulate, asked of one body",
       [](Made& m) {
         SimulateOptions options;
         options.asked.resize(1);
         simulate(m.scene, m.contacts, 1, options);
       },
       {"1 bodies asked for", "expected 3"}},
      {"simulateAlong, a duration of infinity",
       [](Made& m) { simulateAlong(m.motion, m.scene, m.motion.geometry, kUnbounded); },
       {"inf"}},
      {"simulateAlong, no geometry", [](Made& m) { simulateAlong(m.motion, m.scene, nullptr, 1); }, {"geometry"}},
      {"Arc::extendTo, infinity", [](Made& m) { m.motion.world_lines[1].arcs[0].extendTo(kUnbounded); }, {"inf"}},
      {"a rotation that was not extended",
       [](Made&) {
         TriaxialRotation rotation;
         rotation.begin({1, 2, 3}, Quat::Identity(), {1, 1, 1});
         rotation.orientationAt(0.1);
       },
       {"extended"}},
  };
}

std::vector<Misuse> misusesOfDerivatives() {
  return {
      {"adjoint, a seed as it is made", [](Made& m) { gradient(m, StateSeed{}); }, {"body -1"}},
      {"adjoint, body 7", [](Made& m) { gradient(m, seedAt(7, Instant::at(0.1))); }, {"body 7"}},
      {"adjoint, event 99", [](Made& m) { gradient(m, seedAt(0, Instant::before(99))); }, {"event 99"}},
      {"adjoint, event -2", [](Made& m) { gradient(m, seedAt(0, Instant::before(-2))); }, {"event -2"}},
      {"adjoint, after the end", [](Made& m) { gradient(m, seedAt(0, Instant::at(2))); }, {"the time 2"}},
      {"adjoint, a time of NaN", [](Made& m) { gradient(m, seedAt(0, Instant::at(kNotANumber))); }, {"nan"}},
      {"adjoint, a weight of NaN", [](Made& m) { gradient(m, seedAt(0, Instant::at(0.1), kNotANumber)); }, {"weight", "nan"}},
      {"adjoint, a weight of infinity",
       [](Made& m) {
         StateSeed seed = seedAt(0, Instant::before(0));
         seed.time = kUnbounded;
         gradient(m, seed);
       },
       {"weight", "inf"}},
      {"timeDerivative, body 7", [](Made& m) { timeDerivative(m.motion, seedAt(7, Instant::at(0))); }, {"body 7"}},
      {"readPlace, event 99", [](Made& m) { readPlace(m.motion, 0, Instant::before(99)); }, {"event 99"}},
      {"readPlace, body -1", [](Made& m) { readPlace(m.motion, -1, Instant::at(0)); }, {"body -1"}},
      {"tape, arc of body 3", [](Made& m) { m.tape.arc(3, 0); }, {"body 3"}},
      {"tape, an arc without an event", [](Made& m) { m.tape.arc(2, 0); }, {"arc", "there are none"}},
      {"tape, arc 99", [](Made& m) { m.tape.arc(0, 99); }, {"99"}},
      {"tape, arc until NaN", [](Made& m) { m.tape.arcUntil(0, 0, kNotANumber); }, {"nan"}},
      {"tape, arc 99 until 0.1", [](Made& m) { m.tape.arcUntil(0, 99, 0.1); }, {"arc 99"}},
      {"tape, event 99", [](Made& m) { m.tape.event(99); }, {"event 99"}},
      {"reliability of event 99", [](Made& m) { Reliability{}.pass(m.motion, 99); }, {"event 99"}},
      {"tangent, of another scene", [](Made& m) { tangent(m.tape, SceneTangent()); }, {"0 bodies", "expected 3"}},
      {"tangent, NaN",
       [](Made& m) {
         m.direction.bodies[0].velocity.y() = kNotANumber;
         tangent(m.tape, m.direction);
       },
       {"a body", "nan"}},
      {"tangent, too few dimensions",
       [](Made& m) {
         m.direction.bodies[1].size.resize(2);
         tangent(m.tape, m.direction);
       },
       {"2 rates of dimensions", "expected 3"}},
      {"MotionTangent::at, body 7", [](Made& m) { m.moved.at(7, Instant::at(0.1)); }, {"body 7"}},
      {"MotionTangent::at, event 99", [](Made& m) { m.moved.at(0, Instant::before(99)); }, {"event 99"}},
      {"MotionTangent::start, arc 99", [](Made& m) { m.moved.start(0, 99); }, {"arc 99"}},
      {"MotionTangent::start, body -1", [](Made& m) { m.moved.start(-1, 0); }, {"body -1"}},
      {"MotionTangent::model, body 3", [](Made& m) { m.moved.model(3); }, {"body 3"}},
      {"MotionTangent::eventTime, event 99", [](Made& m) { m.moved.eventTime(99); }, {"event 99"}},
      {"secondOrder, a seed as it is made",
       [](Made& m) {
         const StateSeed seed;
         secondOrder(m.tape, std::span(&seed, 1), {}, {});
       },
       {"body -1"}},
      {"secondOrder, two times for one seed",
       [](Made& m) {
         const StateSeed seed = seedAt(0, Instant::at(0.1));
         const ReadingDirection direction{m.direction, Eigen::VectorXd::Zero(2)};
         secondOrder(m.tape, std::span(&seed, 1), {}, std::span(&direction, 1));
       },
       {"2 rates of times", "expected 1"}},
      {"dot, of another scene", [](Made& m) { m.direction.dot(SceneDerivative()); }, {"expected 1"}},
  };
}

std::vector<Misuse> misusesOfShapes() {
  const auto set = [](Shape shape, Eigen::Index count) {
    return [shape, count](Made&) {
      Shape s = shape;
      kindOf(s).setDimensions(s, Eigen::VectorXd::Ones(count));
    };
  };
  const auto rate = [](Shape shape, Eigen::Index count) {
    return [shape, count](Made&) { kindOf(shape).propertiesRate(shape, Eigen::VectorXd::Ones(count)); };
  };
  return {
      {"two sizes of a box", set(Box{}, 2), {"2 numbers", "expected 3"}},
      {"no radius of a sphere", set(Sphere{}, 0), {"0 numbers", "expected 1"}},
      {"a capsule's", set(Capsule{}, 3), {"expected 2"}},
      {"a cylinder's", set(Cylinder{}, 1), {"expected 2"}},
      {"a hull's", set(Hull{}, 0), {"expected 1"}},
      {"a mesh's", set(Mesh{}, 2), {"expected 1"}},
      {"a plane's", set(Plane{}, 1), {"expected 0"}},
      {"a compound's", set(Compound{{{Box{}}, {Sphere{}}}}, 3), {"expected 4"}},
      {"rates of a box", rate(Box{}, 2), {"expected 3"}},
      {"rates of a sphere", rate(Sphere{}, 0), {"expected 1"}},
      {"rates of a capsule", rate(Capsule{}, 1), {"expected 2"}},
      {"rates of a cylinder", rate(Cylinder{}, 1), {"expected 2"}},
      {"rates of a compound", rate(Compound{{{Box{}}, {Sphere{}}}}, 3), {"expected 4"}},
      {"an inertia of NaN", [](Made&) { Inertia::fromMatrix(Mat3::Constant(kNotANumber)); }, {"nan"}},
      {"an inertia that is not symmetric",
       [](Made&) {
         Mat3 upper = Vec3(1, 2, 2).asDiagonal();
         upper(0, 1) = 0.1;
         Inertia::fromMatrix(upper);
       },
       {"not symmetric"}},
      {"a polygon of two corners",
       [](Made&) {
         assembleSurface({Vec3::Zero(), Vec3::UnitX()}, {{0, 1}});
       },
       {"2", "3 or more"}},
      {"a polygon of vertices that are not there",
       [](Made&) {
         assembleSurface({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 3}});
       },
       {"vertex 3"}},
  };
}

void expectRefused(const std::vector<Misuse>& misuses) {
  for (const Misuse& misuse : misuses) {
    SCOPED_TRACE(misuse.name);
    Made made;
    try {
      misuse.call(made);
      ADD_FAILURE() << "was taken";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("found"), std::string::npos) << text;
      EXPECT_NE(text.find("expected"), std::string::npos) << text;
      for (const std::string& word : misuse.words) EXPECT_NE(text.find(word), std::string::npos) << word << ": " << text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "threw " << error.what();
    }
  }
}

TEST(Arguments, OfMotionsAreChecked) { expectRefused(misusesOfMotions()); }
TEST(Arguments, OfDerivativesAreChecked) { expectRefused(misusesOfDerivatives()); }
TEST(Arguments, OfShapesAreChecked) { expectRefused(misusesOfShapes()); }

TEST(Arguments, ThatMakeSenseAreTaken) {
  Made m;
  ASSERT_GE(m.events, 2);
  EXPECT_EQ(m.motion.arcAt(0, -1), 0) << "before the start";
  EXPECT_EQ(m.motion.findImpact(0, 99), std::nullopt);
  EXPECT_EQ(m.motion.stateAt(0, m.motion.end).position, m.motion.stateAt("ball", 0.9).position);
  EXPECT_NO_THROW(gradient(m, seedAt(0, Instant::before(m.events - 1))));
}

}  // namespace
}  // namespace carom
