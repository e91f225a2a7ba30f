// SPDX-License-Identifier: MIT
#include "tests/support/moving_target_scenes.h"

#include "tests/support/thrown_box.h"

namespace carom::test {
namespace {

Body kinematicSlab(const Vec3& velocity, const Vec3& spin) {
  Body b = makeBox("slab", {2, 2.2, 0.2}, {0.1, 0, 0.1}, velocity);
  b.mass.reset();
  b.kinematic = true;
  b.angular_velocity = spin;
  b.gravity_factor = 3;  // has no say
  return b;
}
const Vec3 kSlabVelocity(0.3, -0.2, 0.4), kSlabSpin(0.2, -0.3, 0.5);
Scene kinematicTarget() {
  return makeScene(kThrownGravity, 0.7, 0.3, {thrownBox(), kinematicSlab(kSlabVelocity, kSlabSpin)});
}
Scene kinematicFirst() {
  return makeScene(kThrownGravity, 0.7, 0.3, {kinematicSlab(kSlabVelocity, kSlabSpin), thrownBox()});
}
Scene kinematicFrictionless() {
  Scene s = kinematicTarget();
  s.materials[0].friction = 0;
  return s;
}
Scene kinematicOffset() {
  Scene s = kinematicTarget();
  s.bodies[1].center_of_mass = Vec3(0.2, -0.3, 0.05);
  return s;
}
// whose centre moves with its sizes
Scene kinematicCompound() {
  Scene s = kinematicTarget();
  Compound parts;
  parts.parts.push_back({Box{{2, 2.2, 0.2}}, Vec3::Zero(), Quat::Identity()});
  parts.parts.push_back({Box{{0.3, 0.4, 0.5}}, {-0.8, 0.7, -0.2}, Quat(0.9, 0.1, 0.2, 0.1).normalized()});
  s.bodies[1].shape = parts;
  return s;
}
Scene kinematicJoint(double friction) {
  Scene s = flatBoxOnFloor(friction);
  s.bodies[1] = kinematicSlab({0.2, -0.1, 0.3}, Vec3::Zero());
  return s;
}
Scene kinematicJointStick() { return kinematicJoint(3); }
Scene kinematicJointSlide() { return kinematicJoint(0.1); }
// half on a slab that moves and half on one that does not
Scene kinematicAndFixed(double friction) {
  Scene s = flatBoxOnFloor(friction);
  Body moving = kinematicSlab({0.2, 0.1, 0}, Vec3::Zero()), still = fixedBody(moving);
  moving.position.x() = -1.2, still.position.x() = 1;
  still.kinematic = false, still.velocity.setZero(), still.name = "still";
  s.bodies[0].velocity = {0, 0, -1};
  s.bodies.pop_back();
  s.bodies.push_back(moving);
  s.bodies.push_back(still);
  return s;
}
Scene kinematicAndFixedFrictionless() { return kinematicAndFixed(0); }
Scene kinematicAndFixedFriction() { return kinematicAndFixed(0.5); }

// Surfaces that move: of a floor, of a slope that lies and is turned anyhow, of a body that moves itself.
Scene belt() {
  Scene s = boxOnFloor(0.7, 0.3);
  s.bodies[1].surface_velocity = {1.2, -0.4, 0.3};
  return s;
}
Scene beltFirst() {
  Scene s = belt();
  std::swap(s.bodies[0], s.bodies[1]);
  return s;
}
Scene turntable(double friction) {
  Body plate = fixedBody(makeBox("plate", {6, 5, 0.4}, {-0.3, 0.2, -0.1}));
  plate.orientation = Quat(0.95, 0.12, -0.08, 0.2).normalized();
  plate.surface_velocity = {0.3, 0.2, -0.1}, plate.surface_angular_velocity = {0.4, -0.3, 2.5};
  return makeScene(kThrownGravity, 0.7, friction, {thrownBox(), plate});
}
Scene turntableStick() { return turntable(2); }
Scene turntableSlide() { return turntable(0.1); }
Scene turntableFrictionless() { return turntable(0); }
Scene turntableTilt() {
  Scene s = turntable(0.3);
  s.tilts = {{"box", 1, {0.03, -0.05}}};
  return s;
}
Scene ballOnRoller() {
  Body roller = fixedBody(makeBall("roller", 0.5, {0.05, 0.02, 0}));
  roller.surface_angular_velocity = {1.5, 4, -2};
  return makeScene(kThrownGravity, 0.6, 0.2, {makeBall("ball", 0.1, {0, 0, 1.2}, {0.1, 0, 0}), roller});
}
Scene kinematicBelt() {
  Scene s = kinematicOffset();
  s.bodies[1].surface_velocity = {-0.7, 0.5, 0.2}, s.bodies[1].surface_angular_velocity = {0.2, 0.6, -1.5};
  return s;
}
Scene kinematicCompoundBelt() {
  Scene s = kinematicCompound();
  s.bodies[1].surface_velocity = {-0.7, 0.5, 0.2}, s.bodies[1].surface_angular_velocity = {0.2, 0.6, -1.5};
  return s;
}
Scene jointBelt(double friction) {
  Scene s = flatBoxOnFloor(friction);
  s.bodies[1].surface_velocity = {0.8, -0.3, 0}, s.bodies[1].surface_angular_velocity = {0, 0, 1.1};
  return s;
}
Scene jointBeltStick() { return jointBelt(3); }
Scene jointBeltSlide() { return jointBelt(0.1); }
// half on a belt and half on a floor, or on belts that run apart
Scene beltAndFloor() {
  Scene s = kinematicAndFixed(0.5);
  for (std::size_t b : {1u, 2u}) s.bodies[b].fixed = true, s.bodies[b].kinematic = false, s.bodies[b].velocity.setZero();
  s.bodies[1].surface_velocity = {0.6, 0.2, 0};
  return s;
}
Scene beltsApart() {
  Scene s = beltAndFloor();
  s.bodies[2].surface_velocity = {-0.2, 0.4, 0};
  return s;
}

}  // namespace

std::vector<DotProductScene> movingTargetScenes() {
  return {
      {"kinematic", kinematicTarget},
      {"kinematic_first", kinematicFirst},
      {"kinematic_frictionless", kinematicFrictionless},
      {"kinematic_offset", kinematicOffset},
      {"kinematic_compound", kinematicCompound},
      {"kinematic_joint_stick", kinematicJointStick, 2, {"joint"}},
      {"kinematic_joint_slide", kinematicJointSlide, 2, {"joint"}},
      {"kinematic_and_fixed_frictionless", kinematicAndFixedFrictionless, 1, {"joint"}},
      {"kinematic_and_fixed_friction", kinematicAndFixedFriction, 1, {"joint"}},
      {"belt", belt, 3},
      {"belt_first", beltFirst, 3},
      {"turntable_stick", turntableStick, 2, {"stick"}},
      {"turntable_slide", turntableSlide, 2, {"slide"}},
      {"turntable_frictionless", turntableFrictionless, 2, {"frictionless"}},
      {"turntable_tilt", turntableTilt, 2},
      {"ball_on_roller", ballOnRoller, 1, {"ball on ball"}},
      {"kinematic_belt", kinematicBelt},
      {"kinematic_compound_belt", kinematicCompoundBelt},
      {"joint_belt_stick", jointBeltStick, 2, {"joint"}},
      {"joint_belt_slide", jointBeltSlide, 1, {"joint"}},
      {"belt_and_floor", beltAndFloor, 1, {"joint"}},
      {"belts_apart", beltsApart, 1, {"joint"}},
  };
}

}  // namespace carom::test
