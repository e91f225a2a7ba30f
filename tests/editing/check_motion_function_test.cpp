// SPDX-License-Identifier: MIT
// The checker passes functions whose derivatives are right, and finds each way in which one can be wrong.
#include "editing/check_motion_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "adjoint/base/errors.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;

/// What may be wrong with a function.
struct Wrong {
  double of_seed = 1, of_rate = 1;
  bool second_order = true;
};

/// Height times speed along x, just before the second impact.
MotionFunction reachOfBox(Wrong wrong = {}) {
  MotionFunction f;
  f.name = "reach";
  f.until = nthImpact(2), f.body = "box";
  f.read = [wrong](const Motion& motion) {
    const int body = bodyIndex(*motion.scene, "box"), event = motion.findImpact(body, 2).value();
    const BodyState at = motion.stateBefore(event, body);
    RowReading reading;
    reading.value = at.position.z() * at.velocity.x();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = body, seed.at = Instant::before(event);
    seed.position = {0, 0, wrong.of_seed * at.velocity.x()}, seed.velocity = {at.position.z(), 0, 0};
    reading.second_order = wrong.second_order;
    if (wrong.second_order)
      reading.seed_rates = [wrong](std::span<const BodyStateRate> rates) {
        std::vector<StateSeed> d(1);
        d[0].position = {0, 0, wrong.of_rate * rates[0].velocity.x()}, d[0].velocity = {rates[0].position.z(), 0, 0};
        return d;
      };
    return reading;
  };
  return f;
}

std::vector<Control> throwOfBox() { return {velocity("box"), angularVelocity("box"), elasticity("felt"), mass("box")}; }

MotionFunctionCheck checked(const MotionFunction& f, double duration = 0.8) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  return checkMotionFunction(scene, contacts, duration, f, throwOfBox());
}

std::string all(const MotionFunctionCheck& check) {
  std::string text;
  for (const std::string& finding : check.findings) text += finding + "\n";
  return text;
}

TEST(CheckMotionFunction, PassesWhatIsRight) {
  for (const bool second_order : {true, false}) {
    const MotionFunctionCheck check = checked(reachOfBox({.second_order = second_order}));
    EXPECT_TRUE(check.passed) << all(check);
    EXPECT_EQ(check.compared, second_order ? 8 + 64 : 8);
    EXPECT_EQ(check.not_compared, 0);
    EXPECT_TRUE(check.gradient_error <= 1e-7) << check.gradient_error;
    EXPECT_TRUE(check.hessian_error <= 1e-6) << check.hessian_error;
  }
}

TEST(CheckMotionFunction, FindsWrongDerivatives) {
  const MotionFunctionCheck seeds = checked(reachOfBox({.of_seed = 1.001, .second_order = false}));
  EXPECT_FALSE(seeds.passed);
  EXPECT_TRUE(seeds.gradient_error > 1e-6) << seeds.gradient_error;
  EXPECT_NE(all(seeds).find("Its derivative with respect to velocity.z of 'box' is "), std::string::npos) << all(seeds);
  const MotionFunctionCheck rates = checked(reachOfBox({.of_rate = 0.999}));
  EXPECT_FALSE(rates.passed);
  EXPECT_TRUE(rates.gradient_error <= 1e-7) << rates.gradient_error;
  EXPECT_TRUE(rates.hessian_error > 1e-6) << rates.hessian_error;
  EXPECT_NE(all(rates).find("Its second derivative with respect to "), std::string::npos) << all(rates);
}

TEST(CheckMotionFunction, FindsWhatIsNoFunctionOfTheMotion) {
  MotionFunction f = reachOfBox();
  f.read = [calls = std::make_shared<int>(0), read = f.read](const Motion& motion) {
    RowReading reading = read(motion);
    reading.value += 1e-3 * (*calls)++;
    return reading;
  };
  EXPECT_NE(all(checked(f)).find("for one and the same motion"), std::string::npos);
}

TEST(CheckMotionFunction, FindsWhatIsReadAfterItsEnd) {
  MotionFunction f;
  f.name = "end", f.until = When(0.2);
  f.read = [](const Motion& motion) {
    RowReading reading;
    reading.value = motion.stateAt("box", motion.end).position.x();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = 1, seed.at = Instant::at(motion.end), seed.position = {1, 0, 0};
    return reading;
  };
  EXPECT_NE(all(checked(f)).find("It reads the motion after `until`"), std::string::npos) << all(checked(f));
}

// Where nothing can be compared it does not pass, and says so.
TEST(CheckMotionFunction, DoesNotPassWhereNothingIsCompared) {
  const Scene scene = manyBounces();  // straight down: every impact is one of a ball that neither sticks nor slides
  OdeContacts contacts(scene);
  MotionFunction lacks = reachOfBox();
  lacks.body = scene.bodies[1].name, lacks.until = nthImpact(1000);
  const MotionFunctionCheck check = checkMotionFunction(scene, contacts, 1, lacks, {velocity(scene.bodies[1].name)});
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.compared, 0);
  EXPECT_NE(all(check).find("does not come"), std::string::npos) << all(check);

  // A body at rest that begins to slide with any throw: differences to both sides are of other motions.
  Scene still = thrownBox();
  still.bodies[1].angular_velocity.setZero(), still.bodies[1].velocity.setZero();
  still.bodies[1].orientation = Quat::Identity();
  still.bodies[1].position.z() = std::get<Box>(still.bodies[1].shape).size.z() / 2;
  OdeContacts at_rest(still);
  MotionFunction place{"place",
                       [](const Motion& motion) {
                         RowReading reading;
                         reading.value = motion.stateAt("box", 0.3).position.x();
                         StateSeed& seed = reading.seeds.emplace_back();
                         seed.body = 1, seed.at = Instant::at(0.3), seed.position = {1, 0, 0};
                         return reading;
                       },
                       1, When(0.3)};
  const MotionFunctionCheck of_rest = checkMotionFunction(still, at_rest, 0.5, place, {velocity("box").only({"x"})});
  EXPECT_FALSE(of_rest.passed);
  EXPECT_EQ(of_rest.compared, 0) << all(of_rest);
}

TEST(CheckMotionFunction, SaysThatItWasStopped) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  std::stop_source stop;
  MotionFunction f = reachOfBox();
  f.read = [&stop, calls = std::make_shared<int>(0), read = f.read](const Motion& motion) {
    if (++*calls == 5) stop.request_stop();
    return read(motion);
  };
  const MotionFunctionCheck check = checkMotionFunction(scene, contacts, 0.8, f, throwOfBox(), stop.get_token());
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(all(check), "The check was stopped.\n");
}

TEST(CheckMotionFunction, PassesOnWhatTheFunctionThrows) {
  MotionFunction f = reachOfBox();
  f.read = [](const Motion&) -> RowReading { throw std::runtime_error("own trouble"); };
  EXPECT_THROW(checked(f), std::runtime_error);
  f.read = nullptr;
  EXPECT_THROW(checked(f), InputError);
}

}  // namespace
}  // namespace carom
