// SPDX-License-Identifier: MIT
// A brick bounces: gradient, tangent, second derivatives, what they pass through, and the motion of a changed scene.
#include <cstdio>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/second_order/second_order.h"
#include "adjoint/simulate/simulate.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() try {
  Scene scene;
  scene.materials = {{.name = "wood", .elasticity = 0.6, .friction = 0.3}};
  Body floor, brick;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{}, floor.material = "wood";
  brick.name = "brick", brick.shape = Box{{0.1, 0.2, 0.3}}, brick.mass = 2, brick.material = "wood";
  brick.inertia = Inertia::fromMoments({0.02, 0.015, 0.01});
  brick.position = {0, 0, 1}, brick.velocity = {2, 0, 0}, brick.angular_velocity = {1, 5, 2};
  scene.bodies = {floor, brick};
  scene.tilts = {Tilt{"brick", 1, {0, 0}}};  // where the floor is first struck its normal may be tilted
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.6);

  StateSeed x;  // the functional: x of the brick at the end
  x.body = 1, x.at = Instant::at(motion.end), x.position = Vec3::UnitX();
  DerivativeTape tape(motion);  // linearises arcs and events once, for all that follows
  Reliability reliability;
  const SceneGradient gradient = adjoint(tape, {&x, 1}, &reliability);
  const BodyDerivative& by_brick = gradient.bodies[1];
  const MaterialDerivative& by_wood = gradient.materials[0];
  const Vec2& by_tilt = gradient.tilts[0];
  std::printf("dx/d(velocity) %.9f, dx/d(elasticity) %.9f, dx/d(tilt) %.9f, through %d impacts, %s\n",
              by_brick.velocity.x(), by_wood.elasticity, by_tilt.x(), reliability.events,
              reliability.reliable ? "reliable" : reliability.message.c_str());

  SceneTangent faster(scene);  // the direction: a faster throw
  faster.bodies[1].velocity = Vec3::UnitX();
  const MotionTangent forward = tangent(tape, faster);
  const BodyStateRate rate = forward.at(1, x.at);
  std::printf("the same forward %.9f; the first impact comes later by %.9f s a m/s\n", rate.dot(x), forward.eventTime(0));
  const StateDerivative& at_arc = forward.start(1, 1);
  const BodyModelDerivative& of_model = forward.model(1);
  std::printf("d(velocity) after it %.9f, d(mass) %.1f\n", at_arc.v.x(), of_model.mass);
  const ArcSensitivity& over_arc = tape.arc(1, 0);
  const RotationSensitivity& turn = over_arc;  // all that a flight needs; a path in contact has more
  const Mat3& by_start = turn.dtheta_dtheta;
  std::printf("d(orientation)/d(its start) over the first flight, first entry %.9f\n", by_start(0, 0));

  const ReadingDirection along{faster, {}};
  const SeedRates constant = nullptr;  // the weights of the functional do not depend on the state
  const SecondOrder second = secondOrder(tape, {&x, 1}, constant, {&along, 1}, RatesWanted::varied);
  const SceneDerivative& rates = second.gradient_rates[0];
  std::printf("d2x/d(velocity)2 %.9f\n", rates.bodies[1].velocity.x());

  Scene changed = scene;
  changed.bodies[1].velocity.x() += 1e-3;
  const MotionAlong moved = simulateAlong(motion, changed, motion.geometry, motion.duration);
  std::printf("x moves by %.9f m\n",
              moved.motion.stateAt("brick", 0.6).position.x() - motion.stateAt("brick", 0.6).position.x());
} catch (const NotComputable& error) {
  std::printf("no derivatives in doubles: %s\n", error.what());
}
