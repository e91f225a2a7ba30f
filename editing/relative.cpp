#include "editing/relative.h"

namespace carom {

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

}  // namespace carom
