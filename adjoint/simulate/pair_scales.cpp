// SPDX-License-Identifier: MIT
#include "adjoint/simulate/pair_scales.hpp"

#include <algorithm>
#include <cmath>

namespace carom::adjoint_detail {
namespace {

// As positions are known to about 1e-13 S.
constexpr double kLeastHeight = 1e-12;
// See mostAcceleration: far above what gravity, and the speeds at the start, make of contacts.
constexpr double kOfGravity = 1e5, kOfSpeeds = 10;

}  // namespace

PairScales::PairScales(const Scene& scene, const std::vector<BodyModel>& models) : gravity_(scene.gravity.norm()) {
  double size = 0, fastest = 0, pull = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const double own = kindOf(body.shape).boundingRadius(body.shape), radius = own + models[i].center.norm();
    size = std::max({size, body.position.lpNorm<Eigen::Infinity>(), std::isfinite(own) ? own : 0});
    radius_.push_back(radius);
    moved_.push_back(!body.immovable());
    if (body.fixed) continue;
    fastest = std::max(fastest, body.velocity.norm() + body.angular_velocity.norm() * radius);
    if (!moved_.back()) continue;
    largest_ = std::max(largest_, radius);
    pull = std::max(pull, std::abs(body.gravity_factor) * gravity_);
  }
  if (largest_ > 0) most_acceleration_ = kOfGravity * pull + kOfSpeeds * fastest * fastest / largest_;
  least_height_ = kLeastHeight * size;
}

PairScale PairScales::of(int a, int b, const Arc& arc_a, const Arc& arc_b, double t) const {
  PairScale scale{kInfinity, (arc_a.velocityAt(t) - arc_b.velocityAt(t)).norm()};
  const auto add = [&](int body, const Arc& arc) {
    if (!arc.moving()) return;
    if (moved_[static_cast<std::size_t>(body)]) scale.length = std::min(scale.length, radius(body));
    scale.speed += arc.spinBound() * radius(body);
  };
  add(a, arc_a), add(b, arc_b);
  scale.speed += std::sqrt(gravity_ * scale.length);
  return scale;
}

double PairScales::instantOf(const Motion& motion, const Event& event) const {
  const auto arcOf = [&](int body) -> const Arc& {
    const Participant* p = event.find(body);
    return motion.world_lines[static_cast<std::size_t>(body)].arcs[p ? static_cast<std::size_t>(p->arc) : 0];
  };
  const Contact& c = event.contacts.front();
  return of(c.a, c.b, arcOf(c.a), arcOf(c.b), event.time).instant();
}

}  // namespace carom::adjoint_detail
