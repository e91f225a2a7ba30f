// SPDX-License-Identifier: MIT
#include "adjoint/derivative/derivative_arguments.hpp"

#include "adjoint/base/arguments.hpp"
#include "adjoint/motion/time_argument.hpp"

namespace carom::adjoint_detail {

void checkSeed(const char* where, const Motion& motion, const StateSeed& seed) {
  checkedIndex(where, "body", seed.body, motion.world_lines.size());
  if (seed.at.event != -1) {
    checkedIndex(where, "event", seed.at.event, motion.events.size());
  } else {
    checkTime(where, motion, seed.at.time);
  }
  for (const Vec3* weights :
       {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity, &seed.center_of_mass, &seed.gravity})
    checkEntries(where, "a weight of", *weights);
  checkEntries(where, "a weight of", Eigen::VectorXd(seed.inertia.reshaped()));
  checkedNumber(where, "a weight of", seed.time);
  checkedNumber(where, "a weight of", seed.mass);
  if (seed.size.size() == 0) return;
  const Shape& shape = motion.scene->bodies[static_cast<std::size_t>(seed.body)].shape;
  checkCount(where, "weights of dimensions", static_cast<std::size_t>(seed.size.size()),
             static_cast<std::size_t>(kindOf(shape).dimensions(shape).size()));
  checkEntries(where, "a weight of", seed.size);
}

void checkDirection(const char* where, const Scene& scene, const SceneTangent& d) {
  checkCount(where, "bodies", d.bodies.size(), scene.bodies.size());
  checkCount(where, "materials", d.materials.size(), scene.materials.size());
  checkCount(where, "tilts", d.tilts.size(), scene.tilts.size());
  checkEntries(where, "a rate of gravity of", d.gravity);
  for (const MaterialDerivative& m : d.materials)
    for (double rate : {m.elasticity, m.friction, m.tangential_elasticity})
      checkedNumber(where, "a rate of a material of", rate);
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    const BodyDerivative& b = d.bodies[i];
    const Shape& shape = scene.bodies[i].shape;
    const Eigen::Index sizes = kindOf(shape).dimensions(shape).size();
    checkCount(where, "rates of dimensions", static_cast<std::size_t>(b.size.size()), static_cast<std::size_t>(sizes));
    for (const Vec3* rates : {&b.position, &b.orientation, &b.velocity, &b.angular_velocity, &b.inertia, &b.surface_velocity,
                              &b.surface_angular_velocity})
      checkEntries(where, "a rate of a body of", *rates);
    checkEntries(where, "a rate of a dimension of", b.size);
    for (double rate : {b.mass, b.density}) checkedNumber(where, "a rate of a body of", rate);
  }
  for (const Vec2& tilt : d.tilts) checkEntries(where, "a rate of a tilt of", tilt);
}

}  // namespace carom::adjoint_detail
