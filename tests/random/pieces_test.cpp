// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/random/solid.h"
#include "tests/support/brute/flight.h"

// The pieces of the brute-force check against what is known of them.

namespace carom::brute {
namespace {

Body brick() {
  Body body;
  body.shape = Box{{0.1, 0.25, 0.5}};
  body.mass = 2;
  return body;
}

TEST(Pieces, flightKeepsEnergyAndFollowsSpin) {
  const MassProperties mass = massOf(brick());
  const Vector L(0.3L, 0.25L, -0.2L), none = Vector::Zero();
  Flight flight(mass, none, 0, none, Rotation::Identity(), none, L);
  const Real energy = L.dot(flight.at(0).w);
  const Real h = 1e-4L;
  for (Real t = 0.1L; t < 3; t += 0.37L) {
    const Kinematic k = flight.at(t);
    EXPECT_LE(std::abs(L.dot(k.w) - energy), 1e-16L * energy) << "t = " << static_cast<double>(t);
    // R' = [w]x R, by a fourth-order difference
    const Matrix dR =
        (8 * (flight.at(t + h).R - flight.at(t - h).R) - flight.at(t + 2 * h).R + flight.at(t - 2 * h).R) / (12 * h);
    for (int c = 0; c < 3; ++c) EXPECT_LE((dR.col(c) - k.w.cross(k.R.col(c))).norm(), 1e-9L);
  }
}

TEST(Pieces, flightOfSymmetricBodyIsItsClosedForm) {
  Body body = brick();
  body.shape = Box{{0.2, 0.2, 0.5}};
  const MassProperties mass = massOf(body);
  const Vector L(0.3L, 0.1L, -0.2L), none = Vector::Zero();
  Flight flight(mass, none, 0, none, Rotation::Identity(), none, L);
  const auto turn = [](const Vector& v) { return Eigen::AngleAxis<Real>(v.norm(), v.normalized()).toRotationMatrix(); };
  for (Real t : {0.1L, 0.9L, 2.3L}) {
    const Matrix expected =
        turn(L / mass.inertia[0] * t) * turn(Vector(0, 0, (1 / mass.inertia[2] - 1 / mass.inertia[0]) * L[2] * t));
    EXPECT_LE((flight.at(t).R - expected).norm(), 1e-16L);
  }
}

TEST(Pieces, separationsOfKnownPlacements) {
  const Solid box = solidOf(Box{{2, 2, 2}}), ball = solidOf(Sphere{0.5}), floor = solidOf(Plane{{0, 0, 1}, -1});
  const auto at = [](Real x, Real y, Real z) { return Placement{Vector(x, y, z), Matrix::Identity()}; };
  const auto value = [](const Solid& a, const Placement& A, const Solid& b, const Placement& B) {
    EXPECT_NEAR(double(separation(a, A, b, B).value), double(separation(b, B, a, A).value), 1e-18);
    return double(separation(a, A, b, B).value);
  };
  EXPECT_NEAR(value(box, at(0, 0, 0.25L), floor, at(0, 0, 0)), 0.25, 1e-16);
  EXPECT_NEAR(value(ball, at(0, 0, -0.75L), floor, at(0, 0, 0)), -0.25, 1e-16);
  EXPECT_NEAR(value(ball, at(3, 0, 0), ball, at(0, 4, 0)), 4, 1e-16);
  EXPECT_NEAR(value(ball, at(1.7L, 0, 0), box, at(0, 0, 0)), 0.2, 1e-16);
  EXPECT_NEAR(value(ball, at(2, 3, 3), box, at(0, 0, 0)), 2.5, 1e-15);
  EXPECT_NEAR(value(ball, at(0.9L, 0, 0), box, at(0, 0, 0)), -0.6, 1e-16);
  EXPECT_NEAR(value(box, at(2.5L, 0.3L, 0), box, at(0, 0, 0)), 0.5, 1e-16);
  EXPECT_NEAR(value(box, at(1.5L, 0.3L, 0.2L), box, at(0, 0, 0)), -0.5, 1e-16);

  // Two edges that cross at a right angle, on boxes that stand on them: apart along x only.
  const Real s = std::sqrt(Real(2)), quarter = std::atan(Real(1));
  const Placement about_z{Vector(2 * s + 0.1L, 0, 0), Eigen::AngleAxis<Real>(quarter, Vector::UnitZ()).matrix()};
  const Placement about_y{Vector::Zero(), Eigen::AngleAxis<Real>(quarter, Vector::UnitY()).matrix()};
  EXPECT_NEAR(value(box, about_z, box, about_y), 0.1, 1e-16);
  const auto contacts = contactsOf(box, about_z, box, about_y, 1e-9L);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_LE((contacts[0].n - Vector::UnitX()).norm(), 1e-16L);
  EXPECT_LE((contacts[0].p - Vector(s, 0, 0)).norm(), 1e-16L);
}

}  // namespace
}  // namespace carom::brute
