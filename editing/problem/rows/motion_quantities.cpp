// SPDX-License-Identifier: MIT
#include "editing/problem/rows/motion_quantities.hpp"

#include <cmath>

#include "adjoint/scene/body_model.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/instants.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

/// Below this share of its scale a length of a vector is rounding, and its direction too.
constexpr double kNothing = 1e-13;

BodyState stateOf(const QuantityPlace& place, int body) { return stateAt(place.motion, body, place.at); }

std::string nameIn(const QuantityPlace& place, int body) {
  return "'" + place.motion.scene->bodies[static_cast<std::size_t>(body)].name + "'";
}

StateSeed seedAt(int body, const Instant& at) {
  StateSeed seed;
  seed.body = body;
  seed.at = at;
  return seed;
}

/// Derivative of v/|v| along dv.
Vec3 directionRate(const Vec3& direction, double length, const Vec3& dv) {
  return (dv - direction.dot(dv) * direction) / length;
}

RowReading withoutDerivative(double value, const std::string& what, const QuantityPlace& place) {
  RowReading out;
  out.value = value;
  out.second_order = true;  // there is nothing to weigh
  out.doubt = what + " of " + nameIn(place, place.body) + " is 0 at t = " + number(place.time) +
              " s, where it has no derivative";
  return out;
}

}  // namespace

RowReading readSpeed(const QuantityPlace& place) {
  const bool alone = place.relative_to < 0;
  Vec3 v = stateOf(place, place.body).velocity;
  if (!alone) v -= stateOf(place, place.relative_to).velocity;
  const double speed = v.norm();
  if (speed <= kNothing * place.scale) return withoutDerivative(speed, "the speed", place);
  const Vec3 u = v / speed;
  RowReading out;
  out.value = speed;
  out.second_order = true;
  out.seeds.push_back(seedAt(place.body, place.at));
  out.seeds[0].velocity = u;
  if (!alone) {
    out.seeds.push_back(seedAt(place.relative_to, place.at));
    out.seeds[1].velocity = -u;
  }
  out.seed_rates = [u, speed](std::span<const BodyStateRate> rates) {
    std::vector<StateSeed> d(rates.size());
    const bool pair = rates.size() == 2;
    d[0].velocity = directionRate(u, speed, pair ? Vec3(rates[0].velocity - rates[1].velocity) : rates[0].velocity);
    if (pair) d[1].velocity = -d[0].velocity;
    return d;
  };
  return out;
}

RowReading readKineticEnergy(const QuantityPlace& place) {
  const BodyModel& model = (*place.motion.models)[static_cast<std::size_t>(place.body)];
  const BodyState s = stateOf(place, place.body);
  const Mat3 R = s.orientation.toRotationMatrix();
  const Mat3 J = R * (model.R_BG.transpose() * model.inertia.asDiagonal() * model.R_BG) * R.transpose();
  const Vec3 v = s.velocity, w = s.angular_velocity, L = J * w, w_G = R.transpose() * w;
  const double m = model.mass;
  RowReading out;
  out.value = 0.5 * (m * v.squaredNorm() + w.dot(L));
  out.second_order = true;
  StateSeed seed = seedAt(place.body, place.at);
  seed.velocity = m * v;
  seed.angular_velocity = L;
  seed.orientation = L.cross(w);
  seed.mass = 0.5 * v.squaredNorm();
  seed.inertia = 0.5 * w_G * w_G.transpose();
  out.seeds = {std::move(seed)};
  out.seed_rates = [=](std::span<const BodyStateRate> rates) {
    const BodyStateRate& d = rates[0];
    const Vec3 &theta = d.orientation, &dw = d.angular_velocity;
    const Vec3 dL = theta.cross(L) - J * theta.cross(w) + R * (d.inertia * w_G) + J * dw;
    const Vec3 dw_G = R.transpose() * (dw - theta.cross(w));
    StateSeed of;
    of.velocity = d.mass * v + m * d.velocity;
    of.angular_velocity = dL;
    of.orientation = dL.cross(w) + L.cross(dw);
    of.mass = v.dot(d.velocity);
    of.inertia = 0.5 * (dw_G * w_G.transpose() + w_G * dw_G.transpose());
    return std::vector<StateSeed>{std::move(of)};
  };
  return out;
}

RowReading readImpulse(const QuantityPlace& place) {
  const double m = (*place.motion.models)[static_cast<std::size_t>(place.body)].mass;
  const Vec3 change =
      place.motion.stateAfter(place.at.event, place.body).velocity - stateOf(place, place.body).velocity;
  const double length = change.norm();
  if (m * length <= kNothing * place.scale) return withoutDerivative(m * length, "the impulse", place);
  const Vec3 u = change / length;
  RowReading out;
  out.value = m * length;
  out.second_order = true;
  out.seeds = {seedAt(place.body, Instant::after(place.at.event)), seedAt(place.body, place.at)};
  out.seeds[0].velocity = m * u;
  out.seeds[0].mass = length;
  out.seeds[1].velocity = -m * u;
  out.seed_rates = [=](std::span<const BodyStateRate> rates) {
    const Vec3 d = rates[0].velocity - rates[1].velocity;
    std::vector<StateSeed> of(2);
    of[0].velocity = rates[0].mass * u + m * directionRate(u, length, d);
    of[0].mass = u.dot(d);
    of[1].velocity = -of[0].velocity;
    return of;
  };
  return out;
}

namespace {

/// What the height of a body's lowest point is made of.
struct Lowest {
  Vec3 up, x, p, gravity;  ///< p: of the lowest point, axes of the shape
  Mat3 R;
  FarthestPoint farthest;

  Vec3 n() const { return -(R.transpose() * up); }
  double height() const { return up.dot(x) - farthest.reach(n()); }
};

StateSeed heightSeed(const Lowest& of) {
  const Vec3 arm = of.R * of.p, place = of.x + arm, n = of.n();
  StateSeed seed;
  seed.position = of.up;
  seed.orientation = arm.cross(of.up);
  if (const double g = of.gravity.norm(); g > 0) seed.gravity = -(place - of.up.dot(place) * of.up) / g;
  seed.size.resize(of.farthest.ball_rates.size());
  for (Eigen::Index d = 0; d < seed.size.size(); ++d) seed.size[d] = -of.farthest.sizeRate(n, d);
  return seed;
}

StateSeed heightSeedRate(const Lowest& of, const BodyStateRate& rate) {
  const Vec3 &theta = rate.orientation, &up = of.up, n = of.n();
  const double g = of.gravity.norm();
  const Vec3 dup = g > 0 ? Vec3(-(rate.gravity - up.dot(rate.gravity) * up) / g) : Vec3(Vec3::Zero());
  const Vec3 dn = -(of.R.transpose() * (dup - theta.cross(up)));
  Vec3 dp = of.farthest.bend(n) * dn;
  for (Eigen::Index d = 0; d < rate.size.size(); ++d) dp += rate.size[d] * of.farthest.pointRate(n, d);
  const Vec3 arm = of.R * of.p, darm = theta.cross(arm) + of.R * dp;
  const Vec3 place = of.x + arm, dplace = rate.position + darm;
  StateSeed seed;
  seed.position = dup;
  seed.orientation = darm.cross(up) + arm.cross(dup);
  if (g > 0) {
    const double h = up.dot(place), dh = dup.dot(place) + up.dot(dplace), dg = -up.dot(rate.gravity);
    seed.gravity = -(dplace - dh * up - h * dup) / g + (place - h * up) * dg / (g * g);
  }
  seed.size.resize(of.farthest.ball_rates.size());
  for (Eigen::Index d = 0; d < seed.size.size(); ++d) seed.size[d] = -of.farthest.pointRate(n, d).dot(dn);
  return seed;
}

}  // namespace

RowReading readHeight(const QuantityPlace& place) {
  const Scene& scene = *place.motion.scene;
  const Shape& shape = scene.bodies[static_cast<std::size_t>(place.body)].shape;
  const BodyState s = stateOf(place, place.body);
  Lowest of;
  of.gravity = scene.gravity;
  of.up = of.gravity.isZero(0) ? Vec3::UnitZ() : Vec3(-of.gravity.normalized());
  of.x = s.position;
  of.R = s.orientation.toRotationMatrix();
  of.farthest = kindOf(shape).farthest(shape, of.n());
  of.p = of.farthest.point(of.n());
  RowReading out;
  out.value = of.height();
  StateSeed seed = heightSeed(of);
  seed.body = place.body;
  seed.at = place.at;
  out.seeds = {std::move(seed)};
  out.second_order = of.farthest.margin > 0;
  if (!(of.farthest.margin > kReliableMargin * kindOf(shape).boundingRadius(shape)))
    out.doubt = "several points of " + nameIn(place, place.body) + " are equally low at t = " + number(place.time) +
                " s: the derivative of its height is one-sided, that of one of them";
  out.seed_rates = [of](std::span<const BodyStateRate> rates) {
    return std::vector<StateSeed>{heightSeedRate(of, rates[0])};
  };
  return out;
}

}  // namespace carom::editing_detail
