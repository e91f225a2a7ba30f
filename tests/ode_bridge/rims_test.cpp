// SPDX-License-Identifier: MIT
// Rims before edges and rims: the places of nearest approach against a search in extended precision, and the ends of
// what is defined.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "ode_bridge/gaps.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using namespace test;
using Real = long double;
using RealVec = Eigen::Matrix<Real, 3, 1>;

WorldFeature rim(const Vec3& center, const Vec3& axis, double rho) { return {center, axis.normalized(), 0, rho}; }
WorldFeature edge(const Vec3& point, const Vec3& along, double r = 0) { return {point, along.normalized(), r, 0}; }

/// The directions of doubles are unit to 1e-16 only.
RealVec unit(const Vec3& d) { return d.cast<Real>().normalized(); }

RealVec nearestOnEdge(const WorldFeature& f, const RealVec& p) {
  const RealVec d = unit(f.direction), q = f.point.cast<Real>();
  return q + (p - q).dot(d) * d;
}
RealVec nearestOnRim(const WorldFeature& f, const RealVec& p) {
  const RealVec d = unit(f.direction), c = f.point.cast<Real>();
  const RealVec across = (p - c) - (p - c).dot(d) * d;
  return c + f.rim * across.normalized();
}

struct Place {
  RealVec on_rim, on_other;
  Real bend;  ///< second derivative of half the squared distance, by the angle on the rim
};

/// All places where the distance is least, found along the first rim.
std::vector<Place> search(const WorldFeature& f, const WorldFeature& g) {
  const RealVec d = unit(f.direction);
  RealVec e = d.cross(RealVec::Unit(std::abs(d.x()) < 0.5L ? 0 : 1)).normalized();
  const RealVec e2 = d.cross(e);
  const auto at = [&](Real angle) {
    return RealVec(f.point.cast<Real>() + f.rim * (std::cos(angle) * e + std::sin(angle) * e2));
  };
  const auto nearest = [&](const RealVec& p) { return g.rim > 0 ? nearestOnRim(g, p) : nearestOnEdge(g, p); };
  const auto slope = [&](Real angle) {
    const RealVec p = at(angle), t = f.rim * (-std::sin(angle) * e + std::cos(angle) * e2);
    return (p - nearest(p)).dot(t);
  };
  const int n = 2000;
  const Real step = 2 * std::numbers::pi_v<Real> / n;
  std::vector<Place> found;
  for (int i = 0; i < n; ++i) {
    Real low = i * step, high = (i + 1) * step;
    if (!(slope(low) < 0 && slope(high) >= 0)) continue;
    const Real bend = (slope(high) - slope(low)) / step;
    for (int k = 0; k < 70; ++k) {
      const Real middle = (low + high) / 2;
      (slope(middle) < 0 ? low : high) = middle;
    }
    found.push_back({at(low), nearest(at(low)), bend});
  }
  return found;
}

/// Holds both branches of a gap against the search, in their order along a direction. False where two places have
/// nearly become one.
bool expectPlaces(GapKind kind, const WorldFeature& f, const WorldFeature& g, const Vec3& along) {
  std::vector<Place> places = search(f, g);
  const auto height = [&](const Place& p) { return (p.on_rim + p.on_other).dot(along.cast<Real>()); };
  std::ranges::sort(places, {}, height);
  EXPECT_TRUE(places.size() == 1 || places.size() == 2) << places.size();
  for (const Place& p : places)
    if (p.bend < 0.03L * f.rim * f.rim) return false;
  for (int branch : {1, 2}) {
    const Place& p = branch == 1 ? places.front() : places.back();
    const Real distance = (p.on_rim - p.on_other).norm();
    const ContactPoint c = contactOf(kind, f, g, branch), opposite = contactOf(kind, f, g, -branch);
    expectEntries(c.point, p.on_rim.cast<double>(), 2e-13, "point");
    if (g.radius > 0) {
      expectEntries(c.gap, static_cast<double>(distance - g.radius), 1e-14, "gap");
      expectEntries(opposite.gap, c.gap, 0, "gap of the other sign");
    } else {
      expectEntries(std::abs(c.gap), static_cast<double>(distance), 1e-14, "gap");
      expectEntries(opposite.gap, -c.gap, 0, "gap of the other side");
    }
    const RealVec w = p.on_rim - p.on_other;
    expectEntries(c.gap + g.radius, static_cast<double>(w.dot(c.normal.cast<Real>())), 1e-14, "n.w");
  }
  return true;
}

class NearestPlaces : public ::testing::TestWithParam<GapKind> {};

TEST_P(NearestPlaces, AreThoseOfASearch) {
  const int throws = 1000;
  int held = 0;
  for (std::uint64_t seed = 1; seed <= throws; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const WorldFeature f = rim(random.vec(1), random.unit(), std::pow(10, random.in(-1.5, 0.3)));
    const WorldFeature g = GetParam() == kRimRim ? rim(random.vec(1), random.unit(), std::pow(10, random.in(-1.5, 0.3)))
                                                 : edge(random.vec(1), random.unit(), seed % 2 ? 0 : 0.05);
    held += expectPlaces(GetParam(), f, g, g.rim > 0 ? f.direction.cross(g.direction) : g.direction);
  }
  EXPECT_GT(held, throws * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(Kinds, NearestPlaces, ::testing::Values(kRimEdge, kRimRim),
                         [](const auto& kind) { return kind.param == kRimEdge ? "rim_edge" : "rim_rim"; });

// Two discs that lie on one another, or nearly: their planes have no line in common to tell the places by.
TEST(Rims, InNearlyParallelPlanesAreThoseOfASearch) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 axis = random.unit();
    const WorldFeature f = rim(random.vec(1), axis, random.in(0.3, 1));
    const double tilt = seed % 4 ? std::pow(10, random.in(-15, -2.1)) : 0;
    const Vec3 across = axis.cross(random.unit()).normalized();
    const double other = random.in(0.3, 1), apart = random.in(std::abs(f.rim - other), f.rim + other);
    const WorldFeature g = rim(f.point + apart * across + random.in(-1e-3, 1e-3) * axis,
                               (seed % 2 ? 1 : -1) * (axis + tilt * random.vec(1)), other);
    const bool first_moves = f.rim < g.rim;
    const WorldFeature &still = first_moves ? g : f, &moving = first_moves ? f : g;
    held += expectPlaces(kRimRim, f, g, still.direction.cross(moving.point - still.point));
  }
  EXPECT_GT(held, 800);
}

TEST(Rims, EdgeThroughTheAxisMeetsBothSides) {
  const WorldFeature f = rim({1, 2, 3}, Vec3::UnitZ(), 0.5), g = edge({1, 2, 3}, Vec3::UnitX());
  const ContactPoint first = contactOf(kRimEdge, f, g, 1), second = contactOf(kRimEdge, f, g, 2);
  expectEntries(first.point, Vec3(0.5, 2, 3), 1e-15, "first");
  expectEntries(second.point, Vec3(1.5, 2, 3), 1e-15, "second");
  expectEntries(first.gap, 0, 1e-15, "gap");
  // t = z x (-x) = -y and d = x: t x d = z
  expectEntries(first.normal, Vec3::UnitZ(), 1e-15, "normal");
  expectEntries(second.normal, -Vec3::UnitZ(), 1e-15, "normal");
}

// The gap of a rim that passes an edge goes through 0 in a straight line.
TEST(Rims, GapOfSharpFeaturesIsSmoothThroughZero) {
  for (int kind : {kRimEdge, kRimRim}) {
    const WorldFeature g =
        kind == kRimRim ? rim({0.9, 0.1, 0}, {0.2, -1, 0.3}, 0.4) : edge({0.45, 0, 0}, {0.2, 0.3, 1});
    WorldFeature f = rim({0, 0, 0}, {0.1, 0.2, 1}, 0.5);
    ContactPoint at = contactOf(static_cast<GapKind>(kind), f, g, 1);
    f.point -= at.gap * at.normal;
    for (double shift : {-1e-3, -1e-9, -1e-15, 0., 1e-15, 1e-9, 1e-3}) {
      WorldFeature moved = f;
      moved.point += shift * at.normal;
      const ContactPoint c = contactOf(static_cast<GapKind>(kind), moved, g, 1);
      expectEntries(c.gap, shift, 1e-15, "gap");
      expectEntries(c.normal, at.normal, 1e-13, "normal");
    }
  }
}

TEST(Rims, LeastHeightOfARimIsThatOfItsLowestPoint) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const WorldFeature f = rim(random.vec(1), random.unit(), random.in(0.1, 2));
    const WorldFeature plane{random.vec(1), random.unit(), 0, 0};
    for (int side : {1, -1}) {
      const RealVec d = unit(f.direction), N = Real(side) * plane.direction.cast<Real>();
      const RealVec lowest = f.point.cast<Real>() - f.rim * (N - N.dot(d) * d).normalized();
      const ContactPoint c = contactOf(kRimPlane, f, plane, side);
      expectEntries(c.point, lowest.cast<double>(), 1e-13, "point");
      expectEntries(c.gap, static_cast<double>(N.dot(lowest - plane.point.cast<Real>())), 3e-15, "gap");
      expectEntries(c.normal, side * plane.direction, 0, "normal");
    }
  }
}

// A tilt of 1e-9 still moves the rim down by rho times it: no digits are lost to 1 - cos^2.
TEST(Rims, TiltOfANearlyFlatRimIsSeen) {
  const double tilt = 1e-9, rho = 0.5;
  const WorldFeature f{{0, 0, 1}, {std::sin(tilt), 0, std::cos(tilt)}, 0, rho};
  const WorldFeature floor{Vec3::Zero(), Vec3::UnitZ(), 0, 0};
  const ContactPoint c = contactOf(kRimPlane, f, floor, 1);
  expectEntries(1 - c.gap, rho * tilt, 1e-7, "drop", rho * tilt);
  expectEntries(c.point, Vec3(rho, 0, c.gap), 1e-15, "point");
}

TEST(Rims, WhatIsNotDefinedIsNaN) {
  const WorldFeature f = rim({1, 2, 3}, Vec3::UnitZ(), 0.5);
  const auto gap = [&](GapKind kind, const WorldFeature& g) { return contactOf(kind, f, g, 1).gap; };
  EXPECT_TRUE(std::isnan(gap(kRimEdge, edge(f.point, f.direction)))) << "axis";
  EXPECT_TRUE(std::isnan(gap(kRimRim, rim({1, 2, 4}, Vec3::UnitZ(), 0.5)))) << "rims in parallel planes";
  EXPECT_TRUE(std::isnan(gap(kRimRim, rim(f.point, -Vec3::UnitZ(), 0.5)))) << "the same rim";
  EXPECT_TRUE(std::isnan(gap(kRimPoint, {f.point, Vec3::Zero(), 0.1, 0}))) << "on the axis";
  EXPECT_TRUE(std::isnan(gap(kRimPoint, {f.point + 0.5 * Vec3::UnitX(), Vec3::Zero(), 0, 0}))) << "on the rim";
  const WorldFeature point{Vec3::Zero(), Vec3::Zero(), 0.5, 0};
  EXPECT_TRUE(std::isnan(contactOf(kPointPoint, point, point, 1).gap));
  EXPECT_TRUE(std::isnan(contactOf(kPointEdge, point, edge(Vec3::Zero(), Vec3::UnitX(), 0.1), 1).gap));
  EXPECT_TRUE(std::isnan(contactOf(kEdgeEdge, edge({0, 0, 1}, Vec3::UnitX()), edge({0, 1, 0}, Vec3::UnitX()), 1).gap));
  // Flat: all of the rim touches first.
  const ContactPoint flat = contactOf(kRimPlane, f, {Vec3::Zero(), Vec3::UnitZ(), 0, 0}, 1);
  EXPECT_EQ(flat.gap, 3);
  EXPECT_TRUE(flat.point.hasNaN());
}

}  // namespace
}  // namespace carom
