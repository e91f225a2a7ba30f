// SPDX-License-Identifier: MIT
#include "editing/problem/rows/relative.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

BodyState seenFrom(const BodyState& a, const BodyState& b) {
  const Quat to_b = b.orientation.conjugate();
  BodyState seen;
  seen.position = to_b * (a.position - b.position);
  seen.orientation = (to_b * a.orientation).normalized();
  seen.velocity = to_b * (a.velocity - b.velocity);
  seen.angular_velocity = to_b * (a.angular_velocity - b.angular_velocity);
  return seen;
}

// d(R_b^T y) = R_b^T (dy - theta_b x y) for a vector y, and theta = R_b^T (theta_a - theta_b).
SeedPair seenFromPullback(const BodyState& a, const BodyState& b, const StateSeed& seed) {
  SeedPair pair;
  StateSeed &of_a = pair.of_a = seed, &of_b = pair.of_b;
  of_a.position = b.orientation * seed.position;
  of_a.orientation = b.orientation * seed.orientation;
  of_a.velocity = b.orientation * seed.velocity;
  of_a.angular_velocity = b.orientation * seed.angular_velocity;
  of_b.position = -of_a.position;
  of_b.velocity = -of_a.velocity;
  of_b.angular_velocity = -of_a.angular_velocity;
  of_b.orientation = -of_a.orientation - (a.position - b.position).cross(of_a.position) -
                     (a.velocity - b.velocity).cross(of_a.velocity) -
                     (a.angular_velocity - b.angular_velocity).cross(of_a.angular_velocity);
  return pair;
}

BodyStateRate seenFromRate(const BodyState& a, const BodyState& b, const BodyStateRate& da, const BodyStateRate& db) {
  const Quat to_b = b.orientation.conjugate();
  const auto seen = [&](const Vec3& difference, const Vec3& rate) {
    return Vec3(to_b * (rate - db.orientation.cross(difference)));
  };
  BodyStateRate rate;
  rate.position = seen(a.position - b.position, da.position - db.position);
  rate.orientation = to_b * (da.orientation - db.orientation);
  rate.velocity = seen(a.velocity - b.velocity, da.velocity - db.velocity);
  rate.angular_velocity = seen(a.angular_velocity - b.angular_velocity, da.angular_velocity - db.angular_velocity);
  rate.time = da.time;
  return rate;
}

SeedPair seenFromPullbackRate(const BodyState& a, const BodyState& b, const BodyStateRate& da, const BodyStateRate& db,
                              const StateSeed& seed, const StateSeed& dseed) {
  SeedPair pair = seenFromPullback(a, b, dseed);  // linear in the seed
  const SeedPair now = seenFromPullback(a, b, seed);
  StateSeed &of_a = pair.of_a, &of_b = pair.of_b;
  const auto turn = [&](Vec3 StateSeed::*field) { return Vec3(db.orientation.cross(now.of_a.*field)); };
  const Vec3 position = turn(&StateSeed::position), orientation = turn(&StateSeed::orientation),
             velocity = turn(&StateSeed::velocity), angular_velocity = turn(&StateSeed::angular_velocity);
  of_a.position += position, of_a.orientation += orientation;
  of_a.velocity += velocity, of_a.angular_velocity += angular_velocity;
  of_b.position -= position, of_b.velocity -= velocity, of_b.angular_velocity -= angular_velocity;
  of_b.orientation -=
      orientation + (a.position - b.position).cross(position) + (a.velocity - b.velocity).cross(velocity) +
      (a.angular_velocity - b.angular_velocity).cross(angular_velocity) +
      (da.position - db.position).cross(now.of_a.position) + (da.velocity - db.velocity).cross(now.of_a.velocity) +
      (da.angular_velocity - db.angular_velocity).cross(now.of_a.angular_velocity);
  return pair;
}

}  // namespace carom::editing_detail
