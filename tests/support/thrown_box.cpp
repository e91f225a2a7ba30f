// SPDX-License-Identifier: MIT
#include "tests/support/thrown_box.h"

namespace carom::test {

Body thrownBox() {
  Body b = makeBox("box", {0.3, 0.2, 0.1}, {0, 0, 0.6}, {1, 0.3, -1});
  b.orientation = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  b.angular_velocity = {2, -3, 1};
  return b;
}

Scene boxOnFloor(double elasticity, double friction, double tangential) {
  Scene s = makeScene(kThrownGravity, elasticity, friction, {thrownBox(), makePlane("floor", Vec3::UnitZ(), 0)});
  s.materials[0].tangential_elasticity = tangential;
  return s;
}

Scene flatBoxOnFloor(double friction) {
  Scene s = boxOnFloor(0.6, friction, 0.2);
  s.gravity = {0, 0, -9.81};
  s.bodies[0].orientation.setIdentity();
  s.bodies[0].angular_velocity.setZero();
  return s;
}

}  // namespace carom::test
