// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <sstream>

#include "adjoint/base/errors.h"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/pairs/compare_impact.h"
#include "tests/pairs/separation.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

// Bodies that come down flat, or nearly, on whatever stands flat below them: the common part of two outlines says where
// they touch and whether they turn. CAROM_TEST_SCALE multiplies the number of drops.

namespace carom::pairs {
namespace {

using test::Random;
using Outline = std::vector<Vec2>;  // convex: a polygon, a segment or a point

constexpr int kCorners = 360;  // of a disc's outline
constexpr double kHeight = 0.2, kGravity = 10;

/// A shape that stands flat, with what it touches a horizontal plane with.
struct Standing {
  const char* name = "";
  Shape shape;
  double below = 0, above = 0;           ///< from the origin down and up to what touches
  std::vector<Outline> bottom, top;      ///< about the origin
  double disc = 0;                       ///< largest radius of a disc among them
  bool symmetric = true;                 ///< a half turn about the vertical through the origin changes nothing
  Quat stands = Quat::Identity();        ///< turns the shape's axes so that it stands
  Vec2 center = Vec2::Zero();            ///< the centre of mass, from above
};

Outline rectangle(double x, double y, const Vec2& at = Vec2::Zero()) {
  return {at + Vec2(x, y), at + Vec2(-x, y), at + Vec2(-x, -y), at + Vec2(x, -y)};
}
Outline polygon(int corners, double radius) {
  Outline out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return out;
}

/// Half of the sizes are round, so that borders of two bodies often coincide.
double size(Random& random) {
  const double any = random.in(0.1, 0.6);
  return random.below(2) ? std::round(any / 0.1) * 0.1 : any;
}

Standing box(Random& random) {
  const Vec3 s(size(random), size(random), size(random));
  const Outline side = rectangle(s.x() / 2, s.y() / 2);
  return {"box", Box{s}, s.z() / 2, s.z() / 2, {side}, {side}};
}
Standing cylinder(Random& random) {
  const double r = size(random), h = size(random);
  return {"cylinder", Cylinder{r, h}, h / 2, h / 2, {polygon(kCorners, r)}, {polygon(kCorners, r)}, r};
}
Standing cone(Random& random) {
  const double r = size(random), h = size(random);
  return {"cone", Cone{r, h}, h / 2, h / 2, {polygon(kCorners, r)}, {{Vec2::Zero()}}, r};
}
Standing coneOnItsApex(Random& random) {
  const double r = size(random), h = size(random);
  return {"cone on its apex",     Cone{r, h}, h / 2, h / 2,           {{Vec2::Zero()}},
          {polygon(kCorners, r)}, r,          true,  Quat(0, 1, 0, 0)};
}
/// On its side, which leans by b from the axis: the apex along -x, the rim's highest point above.
Standing lyingCone(Random& random) {
  const double r = size(random), h = size(random), b = std::atan2(r, h), cosine = std::cos(b), sine = std::sin(b);
  const double apex = -h / 2 * cosine, end = apex + std::hypot(r, h);
  const Outline line{{apex, 0}, {end, 0}}, point{{-apex - r * sine, 0}};
  const Quat down(Eigen::AngleAxisd(-std::numbers::pi / 2 - b, Vec3::UnitY()));
  return {"lying cone", Cone{r, h}, h / 2 * sine,           h / 2 * sine + r * cosine, {line}, {point}, 0,
          false,        down,       Vec2(h / 4 * cosine, 0)};
}
Quat lyingDown() { return Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX())); }  // z comes to lie along -y
Standing lyingCylinder(Random& random) {
  const double r = size(random), h = size(random);
  const Outline line{{0, h / 2}, {0, -h / 2}};
  return {"lying cylinder", Cylinder{r, h}, r, r, {line}, {line}, 0, true, lyingDown()};
}
Standing lyingCapsule(Random& random) {
  const double r = size(random) / 2, h = size(random);
  const Outline line{{0, h / 2}, {0, -h / 2}};
  return {"lying capsule", Capsule{r, h}, r, r, {line}, {line}, 0, true, lyingDown()};
}
Standing capsule(Random& random) {
  const double r = size(random) / 2, h = size(random);
  return {"capsule", Capsule{r, h}, r + h / 2, r + h / 2, {{Vec2::Zero()}}, {{Vec2::Zero()}}};
}
Standing sphere(Random& random) {
  const double r = size(random) / 2;
  return {"sphere", Sphere{r}, r, r, {{Vec2::Zero()}}, {{Vec2::Zero()}}};
}
Standing prism(Random& random) {
  const int corners = 3 + random.below(6);
  const double r = size(random), h = size(random);
  const Outline side = polygon(corners, r);
  std::vector<Vec3> points;
  for (const Vec2& p : side)
    for (const double z : {-h / 2, h / 2}) points.emplace_back(p.x(), p.y(), z);
  return {"prism", Hull{convexHull(points), 1, ""}, h / 2, h / 2, {side}, {side}, 0, corners % 2 == 0};
}
Standing mesh(Random& random) {
  const Vec3 s(size(random), size(random), size(random));
  const Outline side = rectangle(s.x() / 2, s.y() / 2);
  return {"mesh", Mesh{test::boxTriangles(s).surface(), 1, ""}, s.z() / 2, s.z() / 2, {side}, {side}};
}
Standing cross(Random& random) {
  const double l = size(random) + 0.2, w = size(random) / 3, h = size(random);
  Compound c;
  c.parts = {{Box{{l, w, h}}, Vec3::Zero(), Quat::Identity()}, {Box{{w, l, h}}, Vec3::Zero(), Quat::Identity()}};
  const std::vector<Outline> sides{rectangle(l / 2, w / 2), rectangle(w / 2, l / 2)};
  return {"cross", c, h / 2, h / 2, sides, sides};
}
/// A plate on four round legs.
Standing table(Random& random) {
  const double l = size(random) + 0.2, leg = 0.15 * l, h = size(random), plate = 0.1;
  Compound c;
  Standing out{"table", {}, h / 2 + plate / 2, h / 2 + plate / 2, {}, {rectangle(l / 2, l / 2)}, leg};
  c.parts.push_back({Box{{l, l, plate}}, {0, 0, h / 2}, Quat::Identity()});
  for (const Vec2& p : rectangle(l / 2 - leg, l / 2 - leg)) {
    c.parts.push_back({Cylinder{leg, h}, {p.x(), p.y(), -plate / 2}, Quat::Identity()});
    Outline foot = polygon(kCorners, leg);
    for (Vec2& q : foot) q += p;
    out.bottom.push_back(std::move(foot));
  }
  out.shape = c;
  return out;
}
Standing plane(Random&) {
  return {"plane", Plane{Vec3::UnitZ(), 0}, 0, 0, {}, {rectangle(100, 100)}};
}

using Maker = Standing (*)(Random&);
constexpr Maker kUpper[] = {box,  cylinder, lyingCylinder, lyingCapsule, capsule,       sphere,   prism,
                            mesh, cross,    table,         cone,         coneOnItsApex, lyingCone};
constexpr Maker kLower[] = {box,  cylinder, lyingCylinder, lyingCapsule, capsule,       sphere,    prism,
                            mesh, cross,    table,         cone,         coneOnItsApex, lyingCone, plane};

Outline placed(const Outline& outline, double angle, const Vec2& at) {
  Outline out;
  const Eigen::Rotation2Dd turn(angle);
  for (const Vec2& p : outline) out.push_back(at + turn * p);
  return out;
}

/// The part of a convex outline within another one of at least three corners. Sutherland and Hodgman.
Outline clipped(Outline part, const Outline& by) {
  for (std::size_t i = 0; i < by.size() && !part.empty(); ++i) {
    const Vec2 from = by[i], along = by[(i + 1) % by.size()] - from, in(-along.y(), along.x());
    Outline next;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vec2 &p = part[k], &q = part[(k + 1) % part.size()];
      const double at_p = in.dot(p - from), at_q = in.dot(q - from);
      if (at_p >= 0) next.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) next.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    part = std::move(next);
  }
  return part;
}

/// At least one of the two has three corners or more.
Outline common(const Outline& a, const Outline& b) { return b.size() >= 3 ? clipped(a, b) : clipped(b, a); }

/// How far inside the convex hull of points the origin is, m; negative: how far outside.
double depthOf(const std::vector<Vec2>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 720; ++i) {
    const Vec2 u = Eigen::Rotation2Dd(std::numbers::pi / 360 * i) * Vec2::UnitX();
    double furthest = -std::numeric_limits<double>::infinity();
    for (const Vec2& p : points) furthest = std::max(furthest, u.dot(p));
    least = std::min(least, furthest);
  }
  return least;
}

struct Drop {
  Standing upper, lower;
  double angle = 0, other_angle = 0;
  Vec2 at = Vec2::Zero();
  double tilt = 0, elasticity = 0;
  Vec3 axis = Vec3::UnitX();
  Scene scene;

  Drop(Maker above, Maker below, std::uint64_t seed) {
    Random random(seed);
    upper = above(random), lower = below(random);
    const auto turned = [&] { return random.below(2) ? random.below(8) * std::numbers::pi / 4 : random.in(0, 6.3); };
    angle = turned(), other_angle = turned();
    const int where = random.below(3);
    if (where > 0) at = Vec2(random.in(-0.5, 0.5), random.in(-0.5, 0.5));
    if (where == 2) at = (at / 0.05).array().round() * 0.05;
    if (random.below(2)) tilt = std::pow(10, random.in(-12, -3));
    const double direction = random.in(0, 6.3);
    axis = {std::cos(direction), std::sin(direction), 0};
    elasticity = random.below(3) ? random.in(0.1, 1) : 0.5;
    Body low = test::fixedBody(test::makeBall("low", 1, {0, 0, -lower.above}));
    low.shape = lower.shape;
    low.orientation = about(other_angle) * lower.stands;
    Body up = test::makeBall("up", 1, {at.x(), at.y(), kHeight + upper.below});
    up.shape = upper.shape;
    up.orientation = Quat(Eigen::AngleAxisd(tilt, axis)) * about(angle) * upper.stands;
    scene = test::makeScene({0, 0, -kGravity}, elasticity, random.below(2) ? 0.4 : 0, {low, up});
  }
  static Quat about(double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }

  /// Corners of what both outlines have in common, seen from the upper body's centre of mass.
  std::vector<Vec2> support() const {
    const Vec2 center = at + Eigen::Rotation2Dd(angle) * upper.center;
    std::vector<Vec2> points;
    for (const Outline& a : upper.bottom)
      for (const Outline& b : lower.top)
        for (const Vec2& p : common(placed(a, angle, at), placed(b, other_angle, Vec2::Zero())))
          points.push_back(p - center);
    return points;
  }
  bool symmetric() const { return at.isZero(0) && upper.symmetric && lower.symmetric; }
};

/// Of a point from a solid in its place; 0 or less inside.
double distanceFrom(const Shape& shape, const Pose& pose, const Vec3& point) {
  if (const auto* compound = std::get_if<Compound>(&shape)) {
    double least = std::numeric_limits<double>::infinity();
    for (const CompoundPart& part : compound->parts)
      least = std::min(least, distanceFrom(part.shape, {pose * Vector(part.position), pose.R}, point));
    return least;
  }
  const Solid solid(shape), dot(Sphere{1e-12});
  Placed there(solid), here(dot);
  there.moveTo(pose);
  here.moveTo(Pose{Vector(point), Matrix::identity()});
  return static_cast<double>(distanceOf(here, there).proven);  // what is nearest is not well found from inside
}

struct DropTally {
  int drops = 0, touched = 0, supported = 0, impacts = 0, stopped = 0;
  std::size_t most_contacts = 0;
  double worst_distance = 0, worst_turn = 0, worst_time = 0;
};

std::string judge(const Drop& drop, DropTally& tally) {
  OdeContacts contacts(drop.scene);
  SimulateOptions options;
  options.impact_limit = 12;
  const Motion motion = simulate(drop.scene, contacts, 0.6, options);
  ++tally.drops;
  // this is about how they meet, not about how they go on once they have stayed in contact
  const bool has_met = !motion.events.empty();
  const bool stopped = motion.status == MotionStatus::unresolved_impact || motion.status == MotionStatus::not_computable;
  tally.stopped += stopped && has_met;
  if (stopped && !has_met) return motion.message;
  tally.impacts += static_cast<int>(motion.events.size());
  const auto lasting = std::ranges::find_if(motion.events, [](const Event& event) {
    return std::ranges::any_of(event.contacts, [](const Contact& c) { return c.lasts; });
  });
  for (const Event& event : std::span(motion.events.begin(), lasting))
    for (const Contact& c : event.contacts) {
      if (!c.at.point.allFinite()) return "a contact is no point";
      for (int body : {0, 1}) {
        const BodyState s = motion.stateAt(body, event.time);
        const Mat3 R = s.orientation.toRotationMatrix();
        const double distance = distanceFrom(drop.scene.bodies[static_cast<std::size_t>(body)].shape,
                                             Pose{Vector(s.position), {{Vector(R.col(0)), Vector(R.col(1)), Vector(R.col(2))}}},
                                             c.at.point);
        tally.worst_distance = std::max(tally.worst_distance, distance);
        if (!(distance <= 1e-9)) {
          std::ostringstream text;
          text << motion.geometry->describe(c.a, c.b, c.features) << " of " << event.contacts.size() << " at t = "
               << event.time << ", impact " << &event - motion.events.data() + 1 << ", touches at "
               << c.at.point.transpose() << ", " << distance << " m from body " << body;
          return text.str();
        }
      }
    }
  const auto thin = [](const std::vector<Outline>& outlines) { return outlines[0].size() < 3; };
  // a line or a point meets another one within rounding, or not
  if (drop.tilt > 0 || (thin(drop.upper.bottom) && thin(drop.lower.top))) return "";
  const std::vector<Vec2> support = drop.support();
  const bool touches = !motion.events.empty() && std::abs(motion.events[0].time - std::sqrt(2 * kHeight / kGravity)) <= 1e-9;
  if (touches != !support.empty()) {
    // outlines that only share a border may or may not meet
    std::vector<Vec2> all;
    for (const Outline& a : drop.upper.bottom)
      for (const Outline& b : drop.lower.top)
        for (const double grow : {1 - 1e-3, 1 + 1e-3}) {
          Outline grown = placed(a, drop.angle, drop.at);
          for (Vec2& p : grown) p = drop.at + grow * (p - drop.at);
          for (const Vec2& p : common(grown, placed(b, drop.other_angle, Vec2::Zero()))) all.push_back(p);
        }
    const bool border = touches ? !all.empty() : true;
    if (!touches && depthOf(support) > 0.01) return "it is not touched";
    return border ? "" : "it is touched where there is nothing";
  }
  if (!touches) return "";
  ++tally.touched;
  const Event& first = motion.events[0];
  tally.most_contacts = std::max(tally.most_contacts, first.contacts.size());
  const double late = std::abs(first.time - std::sqrt(2 * kHeight / kGravity));
  tally.worst_time = std::max(tally.worst_time, late);
  if (!(late <= 1e-12)) return "it touches at " + std::to_string(first.time) + " s";
  const double margin = 0.3 * std::max(drop.upper.disc, drop.lower.disc) + 1e-6;
  if (!drop.symmetric() && !(depthOf(support) > margin)) return "";
  ++tally.supported;
  const double turn = motion.stateAt(1, first.time).angular_velocity.norm();
  tally.worst_turn = std::max(tally.worst_turn, turn);
  if (!(turn <= 1e-10)) return "it turns at " + std::to_string(turn) + " rad/s though it is supported";
  return "";
}

TEST(FlatDrops, OfEveryKindOnEveryOther) {
  const int each = scaled(40);
  DropTally all;
  int failures = 0;
  for (const Maker above : kUpper)
    for (const Maker below : kLower) {
      for (int i = 1; i <= each && failures < kMostFailures; ++i) {
        const auto seed = static_cast<std::uint64_t>(i);
        const Drop drop(above, below, seed);
        std::string what;
        try {
          what = judge(drop, all);
        } catch (const std::exception& error) {
          what = error.what();
        }
        const bool point_on_point = above == coneOnItsApex && below == cone;  // no direction is normal to both
        if (point_on_point && what.ends_with("defines a contact normal")) continue;
        EXPECT_EQ(what, "") << drop.upper.name << " on " << drop.lower.name << ", seed " << seed << ", tilt "
                            << drop.tilt;
        failures += !what.empty();
      }
    }
  std::printf("%d motions ended in lasting contact\n", all.stopped);
  std::printf("%d drops, %d impacts; of those that came down flat %d touched, %d were supported; at most %zu contacts\n"
              "worst: %.1e m from a body, %.1e rad/s, %.1e s\n",
              all.drops, all.impacts, all.touched, all.supported, all.most_contacts, all.worst_distance, all.worst_turn,
              all.worst_time);
  EXPECT_GT(all.supported, all.drops / 10);
}

}  // namespace
}  // namespace carom::pairs
