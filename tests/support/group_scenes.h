// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adjoint/simulate/simulate.h"

/// Bodies that move on each other in lasting contact (SimulateOptions::groups).
namespace carom::groups {

inline constexpr double kG = 9.81;
inline const Vec3 kDown(0, 0, -kG);

Motion playGroups(const Scene& scene, double duration);
Scene inOrder(Scene scene, bool reverse);
/// Of all that moves, in the scene's gravity, J.
double energyOf(const Motion& m, double t);

/// Of bodies with their centres of mass at their origins, at so many times: the deepest overlap, m, and what energy grows by from one time to
/// the next, as a share of it.
struct Kept {
  double deepest = 0, gain = 0;
};
Kept keptBy(const Motion& m, int looks = 60);

/// Materials "rough" and "ice": ice slips on everything.
Scene sceneOf(double friction, std::vector<Body> bodies, const Vec3& gravity = kDown);
Body onIce(Body body);
Body iceFloor();
Body withMass(Body body, double mass);

/// 1 kg at 2 m/s on a plank of 4 kg on ice, mu 0.25.
Scene boxOnPlank();
/// A ball at 2 m/s without spin on a box of 3 kg on ice, mu 0.3.
Scene ballOnBox();

/// A plank of 2 kg on two rollers of 1 kg on a slope of 0.1 rad.
Scene plankOnRollers();
/// Thin boxes of 20 g in a row, 5 cm high and 3 cm apart, the first of which turns about its lower edge at 9 rad/s.
Scene dominoRow(int count);

/// A scene of a group, of which the state of one body at a time is differentiated.
struct GroupCase {
  std::string name;
  Scene scene;
  int body = 0;
  double until = 1, step = 1e-3;
  int least = 5;          ///< controls of which differences are good
  double order = 1e-11;   ///< what the order of bodies may change by
  std::function<void(SceneTangent&)> along;  ///< leaves out what would make another motion; empty: nothing
};
std::vector<GroupCase> groupCases();

}  // namespace carom::groups
