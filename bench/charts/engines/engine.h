// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::charts {

/// A fixed-step engine that plays a scene of spheres, boxes and planes. Each is set up as near to carom's model as it
/// goes: no damping, no sleeping, restitution and friction of the scene's materials, as little softness as it allows.
class Engine {
 public:
  virtual ~Engine() = default;
  virtual void step() = 0;
  virtual BodyState state(int body) const = 0;
  /// Steps, and gives d(states after)/d(states before) by the engine's own differences of size `nudge`: of every moving
  /// body place and rotation vector, then of every one velocity and angular velocity, rotations in body axes. An empty
  /// matrix where an engine has no such function.
  virtual Eigen::MatrixXd stepDerivative(double nudge) { return (void)nudge, step(), Eigen::MatrixXd(); }
};

struct EngineKind {
  std::string name;
  std::string version;
  std::unique_ptr<Engine> (*make)(const Scene& scene, double dt);
};

/// Those that were found when this was configured; ODE is always there. Maps leave out dWorldQuickStep, which solves
/// lone contacts as dWorldStep does.
const std::vector<EngineKind>& engines();
std::vector<EngineKind> mapEngines();
/// Names of those that were not.
const std::vector<std::string>& missingEngines();

/// Elasticity and friction that all bodies of the scene have in common, as the engines combine coefficients in ways of
/// their own. Throws std::invalid_argument where they differ.
PairCoefficients commonPair(const Scene& scene);

// One file each.
EngineKind odeStep();
EngineKind odeStepWithDefaultCfm();
EngineKind odeQuickStep();
EngineKind bullet();
EngineKind mujoco();

}  // namespace carom::charts
