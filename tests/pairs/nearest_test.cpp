// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/motion/body_distance.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/pairs/distance.h"
#include "tests/support/brute/flight.h"
#include "tests/support/scenes.h"

// The nearest features of bodies that are apart against all features of all pieces, in long double: in general
// position, and with parallel edges and faces.

namespace carom::pairs {
namespace {

Shape shapeOf(test::Random& random, int kind) {
  const double size = random.in(0.05, 0.4);
  switch (kind) {
    case 0: return Sphere{size};
    case 1: return Box{{size, random.in(0.05, 0.5), random.in(0.05, 0.9)}};
    case 2: return Capsule{0.4 * size, random.in(0.1, 1.0)};
    case 3: return Cylinder{size, random.in(0.05, 0.9)};
    case 4: return Cone{size, random.in(0.1, 0.7)};
    default: {
      Compound compound;
      compound.parts = {{Box{{size, 0.2, 0.1}}, {0.3, 0, 0}}, {Cylinder{0.4 * size, 0.3}, {-0.2, 0.1, 0}}};
      return compound;
    }
  }
}

/// Axes that are often parallel to those of the other body.
Quat orientationOf(test::Random& random, bool aligned) {
  if (!aligned) return random.rotation();
  Quat q = Quat::Identity();
  for (int axis = 0; axis < 3; ++axis)
    q = q * Quat(Eigen::AngleAxisd(0.5 * 3.14159265358979323846 * random.below(4), Vec3::Unit(axis)));
  return q.normalized();
}

Body fixedBody(const std::string& name, const Shape& shape, const Vec3& at, const Quat& orientation) {
  Body body;
  body.name = name, body.fixed = true, body.shape = shape, body.position = at, body.orientation = orientation;
  return body;
}

Placed placedOf(const Solid& solid, const Body& body) {
  Placed placed(solid);
  const Mat3 R = body.orientation.toRotationMatrix();
  placed.moveTo({brute::exactly(brute::Vector(body.position.cast<Real>())),
                 brute::exactly(brute::Matrix(R.cast<Real>()))});
  return placed;
}

TEST(Nearest, AgreesWithAllFeaturesOfAllPieces) {
  int compared = 0, several = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    test::Random random(seed);
    const bool aligned = seed % 4 == 0;
    const Shape shape_a = shapeOf(random, random.below(6));
    Shape shape_b = shapeOf(random, random.below(6));
    if (seed % 9 == 0) shape_b = Plane{random.unit(), random.in(-1.5, -0.5)};
    Scene scene;
    const double away = seed % 3 == 0 ? 5 : 1.2;
    scene.bodies = {fixedBody("a", shape_a, random.vec(away), orientationOf(random, aligned)),
                    fixedBody("b", shape_b, Vec3::Zero(), orientationOf(random, aligned))};
    const Body &a = scene.bodies[0], &b = scene.bodies[1];
    const Solid solid_a(shape_a), solid_b(shape_b);
    const Placed A = placedOf(solid_a, a), B = placedOf(solid_b, b);
    if (!provenApart(A, B)) continue;
    const Distance reference = distanceOf(A, B);
    const Real expected = reference.nearest.distance;
    if (expected < 1e-6L) continue;
    OdeContacts contacts(scene);
    const auto geometry = contacts.geometry();
    const auto& distances = dynamic_cast<const adjoint_detail::BodyDistance&>(*geometry);
    const carom::Pose pose_a{a.position, a.orientation.toRotationMatrix()},
        pose_b{b.position, b.orientation.toRotationMatrix()};
    const adjoint_detail::Nearest found = distances.nearest(0, 1, pose_a, pose_b);
    const adjoint_detail::Nearest swapped = distances.nearest(1, 0, pose_b, pose_a);
    // where parallel curves hide the nearest features from the enumeration, its two bounds differ
    const bool exact = expected - reference.proven <= 1e-14L;
    EXPECT_TRUE(found.gap - expected <= 1e-14L && reference.proven - found.gap <= 1e-14L) << seed << ": " << found.gap;
    EXPECT_TRUE(exact || aligned) << seed;
    EXPECT_TRUE(std::abs(swapped.gap - found.gap) <= 1e-14) << seed;
    EXPECT_TRUE(found.apart() && swapped.apart()) << seed;
    if (!found.apart()) continue;
    const ContactJacobian J = geometry->jacobian(0, 1, found.features, pose_a, pose_b);
    EXPECT_TRUE(J.pose.row(0).allFinite() && J.size_a.row(0).allFinite() && J.size_b.row(0).allFinite()) << seed;
    if (!found.several && !swapped.several) {
      const ContactJacobian K = geometry->jacobian(1, 0, swapped.features, pose_b, pose_a);
      EXPECT_TRUE((J.pose.row(0).head<6>() - K.pose.row(0).tail<6>()).norm() <= 1e-11) << seed;
    }
    compared += exact;
    several += found.several;
  }
  EXPECT_GE(compared, 1000);
  EXPECT_GE(several, 20);
}

}  // namespace
}  // namespace carom::pairs
