// SPDX-License-Identifier: MIT
// Mass properties of every shape against closed forms, and their rates against differences of high order.

#include <gtest/gtest.h>

#include <numbers>

#include "adjoint/base/errors.h"
#include "tests/adjoint/shapes.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {
namespace {

using namespace test;

SolidProperties propertiesOf(const Shape& s) { return kindOf(s).properties(s); }

Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

Mesh meshOf(const Triangles& t, double scale = 1) { return {t.surface(), scale, ""}; }
Hull hullOf(const Triangles& t, double scale = 1) { return {t.surface(), scale, ""}; }

// Every kind that has a volume, plain and nested.
struct Named {
  const char* name;
  Shape shape;
  std::vector<std::string> dimensions;
};

std::vector<Named> solids() {
  Random random(21);
  const Triangles corner = tetrahedron({0.1, 0, 0}, {1, 0.1, 0}, {0, 1.2, -0.1}, {0.2, 0.1, 0.9});
  const Compound hat{{part(Cylinder{0.16, 0.01}), part(Cylinder{0.09, 0.12}, {0, 0, 0.06})}};
  const Compound odd{{part(Box{{0.3, 0.7, 0.4}}, random.vec(0.5), random.rotation()),
                      part(Capsule{0.2, 0.6}, random.vec(0.5), random.rotation()),
                      part(Mesh{meshOf(corner, 0.7)}, random.vec(0.5), random.rotation())}};
  const Compound nested{{part(Sphere{0.4}, random.vec(0.5), random.rotation()),
                         part(odd, random.vec(0.5), random.rotation()),
                         part(Hull{hullOf(corner, 1.3)}, random.vec(0.5), random.rotation())}};
  return {
      {"sphere", Sphere{0.7}, {"radius"}},
      {"box", Box{{0.3, 0.8, 1.7}}, {"x", "y", "z"}},
      {"capsule", Capsule{0.3, 1.1}, {"radius", "height"}},
      {"cylinder", Cylinder{0.4, 0.9}, {"radius", "height"}},
      {"cone", Cone{0.4, 0.9}, {"radius", "height"}},
      {"two cones",
       Compound{{part(Cone{0.3, 0.5}, random.vec(0.5), random.rotation()), part(Cone{0.2, 0.9}, random.vec(0.5))}},
       {"0.radius", "0.height", "1.radius", "1.height"}},
      {"hull", hullOf(corner, 0.8), {"scale"}},
      {"mesh", meshOf(torusTriangles(0.8, 0.3, 9, 7).placed(random.rotation(), {1, 2, 3}), 1.2), {"scale"}},
      {"hat", hat, {"0.radius", "0.height", "1.radius", "1.height"}},
      {"odd", odd, {"0.x", "0.y", "0.z", "1.radius", "1.height", "2.scale"}},
      {"nested", nested, {"0.radius", "1.0.x", "1.0.y", "1.0.z", "1.1.radius", "1.1.height", "1.2.scale", "2.scale"}}};
}

TEST(MassProperties, NamesAndDimensions) {
  Random random(22);
  for (const auto& [name, shape, dimensions] : solids()) {
    SCOPED_TRACE(name);
    const ShapeKind& kind = kindOf(shape);
    EXPECT_TRUE(kind.solid(shape));
    EXPECT_EQ(kind.dimension_names(shape), dimensions);
    const Eigen::VectorXd before = kind.dimensions(shape);
    ASSERT_EQ(before.size(), static_cast<Eigen::Index>(dimensions.size()));
    EXPECT_EQ(propertiesOf(shape).rates.size(), dimensions.size());
    const Eigen::VectorXd other = before.unaryExpr([&](double d) { return d * random.in(0.5, 2); });
    Shape changed = shape;
    kind.setDimensions(changed, other);
    EXPECT_EQ(kind.dimensions(changed), other);
    EXPECT_EQ(kind.dimensions(shape), before) << "a copy is a shape of its own";
  }
}

TEST(MassProperties, Sphere) {
  const double r = 0.7;
  const SolidProperties p = propertiesOf(Sphere{r});
  expectEntries(p.volume, 4 * kPi * r * r * r / 3, 1e-15, "volume");
  EXPECT_EQ(p.center, Vec3::Zero());
  expectEntries(p.unit_inertia, 0.4 * r * r * Mat3::Identity(), 1e-16, "inertia");
}

TEST(MassProperties, Box) {
  const SolidProperties p = propertiesOf(Box{{1, 2, 4}});
  EXPECT_EQ(p.volume, 8);
  expectEntries(p.unit_inertia, diagonal(20. / 12, 17. / 12, 5. / 12), 1e-16, "inertia");
}

TEST(MassProperties, Cylinder) {
  const double r = 0.3, h = 0.8;
  const SolidProperties p = propertiesOf(Cylinder{r, h});
  expectEntries(p.volume, kPi * r * r * h, 1e-16, "volume");
  const double x = (3 * r * r + h * h) / 12;
  expectEntries(p.unit_inertia, diagonal(x, x, r * r / 2), 1e-16, "inertia");
}

TEST(MassProperties, Cone) {
  const double r = 0.3, h = 0.8;
  const SolidProperties p = propertiesOf(Cone{r, h});
  expectEntries(p.volume, kPi * r * r * h / 3, 1e-16, "volume");
  expectEntries(p.center, Vec3(0, 0, h / 4 - h / 2), 1e-16, "a quarter of the height above the base");
  const double x = 3. / 80 * (4 * r * r + h * h);
  expectEntries(p.unit_inertia, diagonal(x, x, 0.3 * r * r), 1e-16, "inertia");
}

// A cylinder and two half balls with their centres 3r/8 beyond its ends: 83/320 r^2 across their axis, 2/5 r^2 about
// it.
TEST(MassProperties, Capsule) {
  for (const auto& [r, h] : {std::pair{0.3, 1.1}, {2., 0.01}, {0.01, 5.}}) {
    const double tube = kPi * r * r * h, half = 2 * kPi * r * r * r / 3, V = tube + 2 * half;
    const double out = h / 2 + 3 * r / 8;
    const double z = (tube * r * r / 2 + 2 * half * 0.4 * r * r) / V;
    const double x = (tube * (r * r / 4 + h * h / 12) + 2 * half * (83. / 320 * r * r + out * out)) / V;
    const SolidProperties p = propertiesOf(Capsule{r, h});
    expectEntries(p.volume, V, 1e-15, "volume", V);
    EXPECT_EQ(p.center, Vec3::Zero());
    EXPECT_EQ(p.unit_inertia(0, 0), p.unit_inertia(1, 1));
    expectEntries(p.unit_inertia, diagonal(x, x, z), 1e-15, "inertia", x);
  }
}

// Round shapes are what fine meshes of them converge to; a scaled mesh is the mesh of scaled vertices.
TEST(MassProperties, ScaleOfHullAndMesh) {
  Triangles t = tetrahedron({0.1, 0, 0}, {1, 0.1, 0}, {0, 1.2, -0.1}, {0.2, 0.1, 0.9});
  const double scale = 1.7;
  const SolidProperties mesh = propertiesOf(meshOf(t, scale)), hull = propertiesOf(hullOf(t, scale));
  for (Vec3& v : t.vertices) v *= scale;
  const SolidProperties expected = propertiesOf(meshOf(t));
  for (const SolidProperties& p : {mesh, hull}) {
    expectEntries(p.volume, expected.volume, 1e-15, "volume");
    expectEntries(p.center, expected.center, 1e-15, "center");
    expectEntries(p.unit_inertia, expected.unit_inertia, 1e-15, "inertia");
  }
}

// (4 D(h) - D(2h))/3 and so on: central differences at h, 2h, 3h, 4h weighted so that the error is of order h^8.
TEST(MassProperties, RatesAgainstDifferences) {
  for (const auto& [name, shape, dimensions] : solids()) {
    const ShapeKind& kind = kindOf(shape);
    const SolidProperties p = kind.properties(shape);
    const Eigen::VectorXd at = kind.dimensions(shape);
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      const double step = 0.02 * at[k];
      SolidRate rate;
      const double weights[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
      for (int i = 1; i <= 4; ++i)
        for (int sign : {-1, 1}) {
          Shape moved = shape;
          Eigen::VectorXd values = at;
          values[k] += sign * i * step;
          kind.setDimensions(moved, values);
          const SolidProperties there = kind.properties(moved);
          const double w = sign * weights[i - 1] / step;
          rate.volume += w * there.volume;
          rate.center += w * there.center;
          rate.unit_inertia += w * there.unit_inertia;
        }
      const std::string what = std::string(name) + " by " + dimensions[d];
      expectEntries(p.rates[d].volume, rate.volume, 1e-11, what + ", volume");
      expectEntries(p.rates[d].center, rate.center, 1e-11, what + ", center");
      expectEntries(p.rates[d].unit_inertia, rate.unit_inertia, 1e-11, what + ", inertia");
      EXPECT_EQ(p.rates[d].unit_inertia, p.rates[d].unit_inertia.transpose().eval()) << what << ", symmetric";
    }
  }
}

// One part at the compound's origin is the compound, to the last bit.
TEST(MassProperties, CompoundOfOnePart) {
  for (const auto& [name, shape, dimensions] : solids()) {
    SCOPED_TRACE(name);
    const SolidProperties alone = propertiesOf(shape), p = propertiesOf(Compound{{part(shape)}});
    EXPECT_EQ(p.volume, alone.volume);
    EXPECT_EQ(p.center, alone.center);
    EXPECT_EQ(p.unit_inertia, alone.unit_inertia);
    ASSERT_EQ(p.rates.size(), alone.rates.size());
    for (std::size_t d = 0; d < p.rates.size(); ++d) {
      EXPECT_EQ(p.rates[d].volume, alone.rates[d].volume);
      EXPECT_EQ(p.rates[d].center, alone.rates[d].center);
      EXPECT_EQ(p.rates[d].unit_inertia, alone.rates[d].unit_inertia);
    }
  }
}

TEST(MassProperties, RoundCompoundsStayRound) {
  const Quat quarter(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  const SolidProperties p =
      propertiesOf(Compound{{part(Cylinder{0.16, 0.01}), part(Cylinder{0.09, 0.12}, {0, 0, 0.06}),
                             part(Capsule{0.03, 0.17}, {0, 0, 0.21}, quarter),
                             part(Sphere{0.05}, {0, 0, -0.37}, Quat(0.1, 0.7, -0.5, 0.5).normalized())}});
  EXPECT_EQ(p.unit_inertia(0, 0), p.unit_inertia(1, 1));
  EXPECT_EQ(Mat3(p.unit_inertia.diagonal().asDiagonal()), p.unit_inertia);
  for (const SolidRate& rate : p.rates) {
    EXPECT_EQ(rate.unit_inertia(0, 0), rate.unit_inertia(1, 1));
    EXPECT_EQ(Mat3(rate.unit_inertia.diagonal().asDiagonal()), rate.unit_inertia);
  }
}

// Four bricks, each turned its own way about its own centre, that make up one box.
TEST(MassProperties, BricksMakeABox) {
  const Quat z(Eigen::AngleAxisd(kPi / 2, Vec3::UnitZ())), x(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX())),
      y(Eigen::AngleAxisd(kPi, Vec3::UnitY()));
  const Compound bricks{{part(Box{{1, 2, 3}}, {-0.5, 0, 0}), part(Box{{2, 1, 3}}, {0.5, 0, 0}, z),
                         part(Box{{1, 3, 2}}, {-0.5, 0, 3}, x), part(Box{{1, 2, 3}}, {0.5, 0, 3}, y)}};
  const SolidProperties p = propertiesOf(bricks), box = propertiesOf(Box{{2, 2, 6}});
  expectEntries(p.volume, box.volume, 1e-15, "volume");
  expectEntries(p.center, Vec3(0, 0, 1.5), 1e-15, "center");
  expectEntries(p.unit_inertia, box.unit_inertia, 1e-14, "inertia");
}

// Turned and moved meshes as parts, against one mesh of all their triangles.
TEST(MassProperties, CompoundOfMeshesIsTheirMesh) {
  Random random(23);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE("seed 23, round " + std::to_string(round));
    Triangles all;
    Compound compound;
    for (int i = 0; i < 3; ++i) {
      const Triangles t = i == 0   ? boxTriangles({0.5, 0.7, 1.2})
                          : i == 1 ? torusTriangles(0.6, 0.2, 9, 6)
                                   : tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1});
      const Quat q = random.rotation();
      const Vec3 x = random.vec(4);
      all = all.with(t.placed(q, x));
      compound.parts.push_back(part(meshOf(t), x, q));
    }
    const SolidProperties found = propertiesOf(compound), expected = propertiesOf(meshOf(all));
    expectEntries(found.volume, expected.volume, 1e-13, "volume");
    expectEntries(found.center, expected.center, 1e-13, "center");
    expectEntries(found.unit_inertia, expected.unit_inertia, 1e-13, "inertia");
    const Quat q = random.rotation();
    const Vec3 x = random.vec(4);
    const SolidProperties moved = propertiesOf(Compound{{part(compound, x, q)}});
    expectEntries(moved.center, x + q * expected.center, 1e-13, "moved, center");
    expectEntries(moved.unit_inertia, turned(q, expected.unit_inertia), 1e-13, "moved, inertia");
  }
}

// Parts that overlap count twice where they do.
TEST(MassProperties, OverlapIsSummed) {
  const SolidProperties p = propertiesOf(Compound{{part(Sphere{1}), part(Sphere{1})}}), one = propertiesOf(Sphere{1});
  EXPECT_EQ(p.volume, 2 * one.volume);
  EXPECT_EQ(p.unit_inertia, one.unit_inertia);
}

TEST(MassProperties, BoundingRadius) {
  const auto radius = [](const Shape& s) { return kindOf(s).boundingRadius(s); };
  EXPECT_EQ(radius(Sphere{0.7}), 0.7);
  EXPECT_EQ(radius(Box{{2, 4, 4}}), 3);
  EXPECT_EQ(radius(Capsule{0.5, 3}), 2);
  EXPECT_EQ(radius(Cylinder{3, 8}), 5);
  EXPECT_EQ(radius(Cone{3, 8}), 5);
  EXPECT_EQ(radius(Plane{}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(radius(meshOf(boxTriangles({2, 4, 4}), 0.5)), 1.5);
  EXPECT_EQ(radius(hullOf(boxTriangles({2, 4, 4}), 2)), 6);
  EXPECT_EQ(radius(Compound{{part(Sphere{1}, {0, 3, 4}), part(Sphere{2})}}), 6);
}

TEST(MassProperties, InnerRadius) {
  const auto radius = [](const Shape& s) { return kindOf(s).innerRadius(s); };
  EXPECT_EQ(radius(Sphere{0.7}), 0.7);
  EXPECT_EQ(radius(Box{{2, 4, 3}}), 1);
  EXPECT_EQ(radius(Capsule{0.5, 3}), 0.5);
  EXPECT_EQ(radius(Cylinder{3, 4}), 2);
  EXPECT_EQ(radius(Cone{3, 4}), 2 * 0.6);  // the distance of the middle from the side
  EXPECT_NEAR(radius(hullOf(boxTriangles({2, 4, 3}), 2)), 2, 1e-8);
  EXPECT_EQ(radius(Plane{}), 0);
  EXPECT_EQ(radius(Hull{}), 0);
  EXPECT_EQ(radius(Compound{{part(Sphere{1})}}), 0);
}

TEST(MassProperties, WhatHasNoVolume) {
  Triangles cup = boxTriangles({1, 1, 1});
  cup.triangles.pop_back();
  const Shape open = meshOf(cup);
  for (const Shape& s : {Shape(Plane{}), open, Shape(Mesh{}), Shape(Hull{}), Shape(Compound{}),
                         Shape(Compound{{part(Sphere{1}), part(open)}})}) {
    SCOPED_TRACE(kindOf(s).name);
    EXPECT_FALSE(kindOf(s).solid(s));
  }
  EXPECT_EQ(kindOf(Shape(Plane{})).dimensions(Plane{}).size(), 0);
  EXPECT_EQ(kindOf(open).dimensions(open).size(), 1) << "an open mesh has a scale all the same";
  EXPECT_THROW(propertiesOf(Plane{}), InputError);
  EXPECT_THROW(propertiesOf(open), InputError);
  EXPECT_THROW(propertiesOf(Mesh{}), InputError);
}

}  // namespace
}  // namespace carom
