// SPDX-License-Identifier: MIT
#include "bench/charts/error.h"

#include <algorithm>
#include <cmath>

namespace carom::charts {
namespace {

double angleBetween(const Quat& a, const Quat& b) {
  const Quat d = a.normalized().conjugate() * b.normalized();
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

double keepLargest(double largest, double value) { return std::isnan(largest) || value <= largest ? largest : value; }

}  // namespace

double stateError(const Scene& scene, const States& found, const States& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.fixed) continue;
    const bool turns = !std::holds_alternative<Sphere>(body.shape) || materialOf(scene, body).friction > 0;
    const double turned = turns ? angleBetween(found[i].orientation, exact[i].orientation) : 0;
    const double error =
        (found[i].position - exact[i].position).norm() + kindOf(body.shape).boundingRadius(body.shape) * turned;
    worst = keepLargest(worst, error);
  }
  return worst;
}

States statesAt(const Motion& motion, double t) {
  States states;
  for (std::size_t i = 0; i < motion.scene->bodies.size(); ++i)
    states.push_back(motion.stateAt(static_cast<int>(i), t));
  return states;
}

States startOf(const Scene& scene) {
  States states;
  for (const Body& b : scene.bodies) states.push_back({b.position, b.orientation, b.velocity, b.angular_velocity});
  return states;
}

double energy(const Scene& scene, const States& states) {
  double sum = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].fixed) continue;
    const BodyModel model = modelOf(scene.bodies[i]);
    const Vec3 w = states[i].orientation.conjugate() * states[i].angular_velocity;  // shape axes are principal here
    sum += 0.5 * model.mass * states[i].velocity.squaredNorm() + 0.5 * w.dot(model.inertia.cwiseProduct(w)) -
           model.mass * scene.gravity.dot(states[i].position);
  }
  return sum;
}

double depthInPlanes(const Scene& scene, const States& states) {
  double deepest = -INFINITY;
  for (const Body& fixed : scene.bodies) {
    const auto* plane = std::get_if<Plane>(&fixed.shape);
    if (!plane) continue;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Body& body = scene.bodies[i];
      if (body.fixed) continue;
      const Vec3 n = states[i].orientation.conjugate() * plane->normal;
      double reach = 0;
      if (const auto* ball = std::get_if<Sphere>(&body.shape)) reach = ball->radius;
      if (const auto* box = std::get_if<Box>(&body.shape)) reach = 0.5 * box->size.dot(n.cwiseAbs());
      deepest = std::max(deepest, plane->offset + reach - plane->normal.dot(states[i].position));
    }
  }
  return deepest;
}

}  // namespace carom::charts
