// SPDX-License-Identifier: MIT
// The closed forms of docs/equations.md section 8 for a rod, and the laws that every motion keeps: masses have no
// scale, and the elastic map from start to end keeps volume.

#include <gtest/gtest.h>

#include <numbers>

#include <Eigen/LU>
#include <cmath>

#include "tests/adjoint/tolerances.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

// A vertex at r = (r_x, r_z) from the centre of mass falls from rest at height h:
// v- = -sqrt(2 g (h + r_z)), P = -(1 + e) v-/(1/m + r_x^2/I), v+ = v- + P/m, omega_y+ = -r_x P/I.
struct PlanarVertex {
  double rx, rz, I, e, height = 1, g = 9.81;

  double fall() const { return -std::sqrt(2 * g * (height + rz)); }
  double impulse() const { return -(1 + e) * fall() / (1 + rx * rx / I); }
  double velocity() const { return fall() + impulse(); }
  double spin() const { return -rx * impulse() / I; }
  double dimpulse_dI() const { return impulse() * rx * rx / (I * I) / (1 + rx * rx / I); }
  double dspin_dI() const { return -rx * (dimpulse_dI() - impulse() / I) / I; }
  double dspin_de() const { return spin() / (1 + e); }
};

TEST(ClosedForm, RodTipOnFloor) {
  // a bar on its edge: its tip is one vertex, in the plane of the motion, half a metre from the middle and half a
  // radian below it
  const double depth = 0.01, half = std::sqrt(0.25 - depth * depth), width = depth * std::sqrt(2.);
  Body rod = makeBox("rod", {2 * half, width, width}, {0, 0, 1});
  rod.inertia = Inertia::fromMoments(Vec3::Constant(1. / 12));
  rod.orientation = Quat(Eigen::AngleAxisd(0.5 - std::atan2(depth, half), Vec3::UnitY())) *
                    Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()));
  const Motion m = play(makeScene({0, 0, -9.81}, 0.5, 0, {rod, makePlane("floor", Vec3::UnitZ(), 0)}), 0.42);
  ASSERT_EQ(m.events.size(), 1u);
  EXPECT_EQ(m.events[0].mode, ImpactMode::frictionless);

  const PlanarVertex tip{0.5 * std::cos(0.5), -0.5 * std::sin(0.5), 1. / 12, 0.5};
  expectEntries(tip.velocity(), -2.112215513648, 1e-12, "formula, v+");
  expectEntries(tip.spin(), -9.2147033299731, 1e-12, "formula, omega+");
  const BodyState after = m.stateAt("rod", m.events[0].time);
  expectEntries(after.velocity, Vec3(0, 0, tip.velocity()), kState, "v+");
  expectEntries(after.angular_velocity, Vec3(0, tip.spin(), 0), kState, "omega+");

  // gravity adds to v+ what does not depend on I; omega about y is kept in flight
  const SceneGradient v = gradientOf(m, 0, 0.42, 8), w = gradientOf(m, 0, 0.42, 10);
  // turned by 45 degrees about its length, the rod has two principal moments that make up the one of the plane
  const double dv_dI = v.bodies[0].inertia.tail<2>().sum(), dw_dI = w.bodies[0].inertia.tail<2>().sum();
  expectEntries(dv_dI, 14.656595640472, kDerivative, "dv+/dI");
  expectEntries(-dw_dI, -33.402203455138, kDerivative, "d|omega+|/dI");
  expectEntries(-w.materials[0].elasticity, 6.1431355533154, kDerivative, "d|omega+|/de");
  expectEntries(dv_dI, tip.dimpulse_dI(), kDerivative, "dv+/dI, formula");
  expectEntries(dw_dI, tip.dspin_dI(), kDerivative, "domega+/dI, formula");
  expectEntries(w.materials[0].elasticity, tip.dspin_de(), kDerivative, "domega+/de, formula");
}

Scene writtenInertias(Scene s) {
  Random random(7);
  for (Body& b : s.bodies) {
    if (b.fixed) continue;
    const double base = 0.02 * *b.mass;
    b.inertia = Inertia::fromMoments(base * (Vec3(1, 1.2, 1.4) + random.vec(0.1)));
  }
  return s;
}

TEST(ScaleLaw, MassesAndMomentsOverAllBodies) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const bool written = seed % 2 == 1;
    Scene s = randomScene(seed);
    if (written) s = writtenInertias(s);
    if (seed % 3 == 0) {  // a density in place of a mass
      s.bodies[0].density = 700, s.bodies[0].mass.reset();
    }
    const Motion m = play(s, 0.5, 6);  // the derivative grows with every impact, and so does its rounding
    for (int i = 0; i < 12; ++i) {
      const SceneGradient g = gradientOf(m, 0, m.end, i);
      double sum = 0, size = 1e-2 * flatten(g).cwiseAbs().maxCoeff();  // a lone body's terms are 0, up to rounding
      for (std::size_t b = 0; b < s.bodies.size(); ++b) {
        const Body& body = s.bodies[b];
        if (body.fixed) continue;
        Vec3 products = g.bodies[b].inertia.cwiseProduct(body.inertia.moments);
        const double mass = body.density ? *body.density * g.bodies[b].density : *body.mass * g.bodies[b].mass;
        sum += mass + products.sum();
        size += std::abs(mass) + products.cwiseAbs().sum();
      }
      expectEntries(sum / size, 0, kDerivative, "sum of m dy/dm + I dy/dI, row " + std::to_string(i));
    }
  }
}

// Rows and columns are (x, theta, v, omega); in (x, theta, m v, L) the map has the same determinant, because both ends
// differ by the same constant factor m^3 I1 I2 I3.
double volumeChange(const Scene& scene, const Motion& motion, double T) {
  std::vector<int> moving;
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
    if (!scene.bodies[static_cast<std::size_t>(b)].fixed) moving.push_back(b);
  const auto n = static_cast<Eigen::Index>(moving.size());
  Eigen::MatrixXd J(12 * n, 12 * n);
  for (Eigen::Index row = 0; row < 12 * n; ++row) {
    const SceneGradient g =
        gradientOf(motion, moving[static_cast<std::size_t>(row / 12)], T, static_cast<int>(row % 12));
    for (Eigen::Index c = 0; c < n; ++c) {
      const BodyDerivative& d = g.bodies[static_cast<std::size_t>(moving[static_cast<std::size_t>(c)])];
      J.row(row).segment<12>(12 * c) << d.position.transpose(), d.orientation.transpose(), d.velocity.transpose(),
          d.angular_velocity.transpose();
    }
  }
  return std::abs(J.determinant());
}

TEST(VolumeLaw, ElasticFrictionlessMotionsKeepVolume) {
  int impacts = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene o;
    o.friction = false, o.lowest_elasticity = 1, o.bodies = 1 + static_cast<int>(seed % 3);
    const Scene s = randomScene(seed, o);
    const Motion m = play(s, 0.45, 5);
    impacts += static_cast<int>(m.events.size());
    expectEntries(volumeChange(s, m, m.end), 1, kDerivative, "determinant");
  }
  EXPECT_GE(impacts, 15);
}

TEST(VolumeLaw, LossesShrinkVolume) {
  Scene s = makeScene({0, 0, -9.81}, 0.5, 0, {makeBall("ball", 0.1, {0, 0, 1}), makePlane("floor", Vec3::UnitZ(), 0)});
  const Motion m = play(s, 0.5);
  ASSERT_EQ(m.events.size(), 1u);
  expectEntries(volumeChange(s, m, 0.5), 0.25, kDerivative, "determinant e^2");
}

}  // namespace
}  // namespace carom
