// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"

/// Scenes, directions and read-outs that the tests of adjoint/ and ode_bridge/ share.
namespace carom::test {

Material makeMaterial(const std::string& name, double elasticity, double friction, double tangential = 0);
/// Fixed half space below the plane normal . p = offset.
Body makePlane(const std::string& name, const Vec3& normal, double offset);
/// Bodies of mass 1 and of material "m".
Body makeBall(const std::string& name, double radius, const Vec3& position, const Vec3& velocity = Vec3::Zero());
Body makeBox(const std::string& name, const Vec3& size, const Vec3& position, const Vec3& velocity = Vec3::Zero());
Body fixedBody(Body body);
/// Boxes as one shape: each its size, and where it is.
Shape shapeOfBoxes(const std::vector<std::pair<Vec3, Vec3>>& boxes);
/// One material "m" and these bodies.
Scene makeScene(const Vec3& gravity, double elasticity, double friction, std::vector<Body> bodies);

/// Simulates with collision detection of its own.
Motion play(const Scene& scene, double duration, std::size_t impact_limit = 20000);

/// Random numbers that are the same everywhere. Tests print `seed` with SCOPED_TRACE.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 2654435761u + 12345) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int below(int n) { return static_cast<int>(in(0, n)); }
  Vec3 vec(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Vec3 unit();
  Quat rotation();
  Eigen::VectorXd vector(Eigen::Index n);

 private:
  std::mt19937_64 engine_;
};

struct RandomScene {
  int bodies = 3;        ///< moving boxes and balls
  bool floor = true;     ///< a plane under them
  bool friction = true;  ///< false: frictionless
  double lowest_elasticity = 0;
  double tangential = 1;  ///< largest |e_t|
  bool gravity = true;
};
/// Boxes and balls thrown at one another, apart at the start; two materials.
Scene randomScene(std::uint64_t seed, const RandomScene& options = {});

/// Every field of every body, material and tilt at random.
SceneTangent randomDirection(const Scene& scene, Random& random);
/// The scene, each of its numbers changed by h times its entry of d.
Scene moved(Scene scene, const SceneTangent& d, double h);

/// Number i of a body's state: position 0-2, orientation 3-5, velocity 6-8, angular velocity 9-11.
StateSeed seedOf(int body, const Instant& at, int i);
StateSeed randomSeed(int body, const Instant& at, Random& random);
/// With weights of the scene's own numbers besides: mass, inertia, dimensions and gravity.
StateSeed randomSeedOfScene(const Scene& scene, int body, const Instant& at, Random& random);
/// Gradient of one number of a state.
SceneGradient gradientOf(const Motion& motion, int body, double time, int i);

/// All numbers of a SceneDerivative, always in the same order.
Eigen::VectorXd flatten(const SceneDerivative& d);
Eigen::Matrix<double, 13, 1> flatten(const BodyState& s);

/// Kinetic energy, momentum and angular momentum about the origin of one body.
double kineticEnergy(const BodyModel& model, const State& s);
Vec3 angularMomentum(const BodyModel& model, const State& s);

}  // namespace carom::test
