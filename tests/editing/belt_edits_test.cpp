// SPDX-License-Identifier: MIT
// Edits whose unknown is how fast a belt or a turntable runs.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/report/motion_checks.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;

// A parcel, a uniform ball of radius r, falls from height h with the velocity v on a belt; it sticks, and bounces to the floor of
// the next bounce: after the first impact it flies for 2 e t1 and comes down k/(1 + k) (beta - v) 2 e t1 further.
struct Dropped {
  double r = 0.1, h = 1.1, v = 0.4, e = 0.6, g = 9.81;
  static constexpr double k = 0.4;
  double meets() const { return std::sqrt(2 * (h - r) / g); }
  double second(double beta) const { return v * meets() + (v + k / (1 + k) * (beta - v)) * 2 * e * meets(); }
  double speedFor(double mark) const { return v + (1 + k) / k * ((mark - v * meets()) / (2 * e * meets()) - v); }
  Scene scene(double beta) const {
    Scene scene;
    scene.materials = {material("rubber", e, 5)};
    scene.bodies = {fixedPlane("belt", "rubber", Vec3::UnitZ(), 0), ball("parcel", "rubber", r, {0, 0, h}, {v, 0, 0})};
    scene.bodies[0].surface_velocity = {beta, 0, 0};
    return scene;
  }
};

TEST(BeltEdits, WhichBeltSpeedBringsTheBounceToTheMark) {
  const Dropped c;
  for (const double beta : {0.0, 0.8}) {
    const Scene scene = c.scene(beta);
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 3 * c.meets());
    edit.vary(surfaceVelocity("belt").only({"x"}));
    const double mark = c.second(-1.3);
    edit.nail("parcel", nthImpact(2, "belt")).position({mark, any, any});
    const EditResult result = edit.solve();
    ASSERT_TRUE(result.solved()) << nameOf(result.status) << ": " << result.message;
    ASSERT_EQ(result.changed.size(), 1u);
    EXPECT_EQ(result.changed[0].name, "surface_velocity.x of 'belt'");
    EXPECT_NEAR(result.changed[0].after, c.speedFor(mark), 1e-8);
    EXPECT_NEAR(result.changed[0].after, -1.3, 1e-8);
    EXPECT_NEAR(result.motion.stateBefore(1, 1).position.x(), mark, 1e-8);
    EXPECT_LE(energyGain(result.motion), 1e-12);
  }
}

TEST(BeltEdits, WhichTurntableThrowsThere) {
  const Dropped c;
  Scene scene = c.scene(0);
  scene.bodies[0].surface_angular_velocity = {0, 0, 1};
  scene.bodies[0].position = {0.2, -0.7, 0};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 3 * c.meets());
  edit.vary(surfaceAngularVelocity("belt").only({"z"}));
  edit.nail("parcel", nthImpact(2, "belt")).position({any, 0.3, any});
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << nameOf(result.status) << ": " << result.message;
  // where it lands, the plate runs along y at Omega (x - 0.2)
  const double along = c.v * c.meets() - 0.2, share = c.k / (1 + c.k);
  EXPECT_NEAR(result.changed[0].after, 0.3 / (share * along * 2 * c.e * c.meets()), 1e-7);
}

TEST(BeltEdits, OfABodyThatImpactsMoveIsRefused) {
  const Scene scene = Dropped().scene(1);
  OdeContacts contacts(scene);
  for (const Control& control : {surfaceVelocity("parcel"), surfaceAngularVelocity("parcel")}) {
    Edit edit(scene, contacts, 1);
    edit.vary(control);
    edit.nail("parcel", 0.5).position({1, any, any});
    try {
      (void)edit.solve();
      FAIL() << control.vary;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(control.vary + " cannot vary: impacts move body 'parcel'"), std::string::npos)
          << error.what();
    }
  }
}

// What rests on a belt that stands still has a derivative by its velocity that is not followed, and says so.
TEST(BeltEdits, RestOnABeltMakesItsDerivativeUnreliable) {
  Scene scene = Dropped().scene(0);
  scene.bodies[1].shape = Box{{0.3, 0.2, 0.1}};
  scene.bodies[1].position = {0, 0, 0.05}, scene.bodies[1].velocity.setZero();
  OdeContacts contacts(scene);
  for (const bool belt : {true, false}) {
    const EditProblem problem(scene, contacts, 1, {belt ? surfaceVelocity("belt") : elasticity("rubber")},
                              {{"parcel", 0.5, {{"position", {0, any, any}}}}});
    const Eigen::VectorXd values = problem.controls.startValues();
    const Motion motion = simulateAt(problem, values, 1);
    const RowValues rows = problem.constraints.evaluate(motion, Eigen::VectorXd());
    ASSERT_TRUE(rows.available);
    std::vector<Reliability> reliability;
    (void)jacobianByAdjoint(problem, values, motion, rows, &reliability);
    ASSERT_FALSE(reliability.empty());
    EXPECT_EQ(reliability[0].reliable, !belt) << reliability[0].message;
    if (belt) EXPECT_NE(reliability[0].message.find("stays in contact with 'belt'"), std::string::npos) << reliability[0].message;
  }
}

}  // namespace
}  // namespace carom
