// SPDX-License-Identifier: MIT
// Bodies of convex kinds dropped into V-grooves, against a wall or two on a floor, and into corners of three planes.
// Whatever is complete must keep to Coulomb's law, have no more energy than before and lie in no plane; prints how the
// others end. CAROM_TEST_SCALE=20 drops 1800.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <map>
#include <numbers>

#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/random/coulomb_check.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::grooves {
namespace {

using namespace test;

constexpr double kAskedOfGrooves = 2;  // s
constexpr std::size_t kWorkOfGrooves = 3'000'000;

struct KindInGroove {
  const char* name;
  Shape (*make)(Random&);
};

double side(Random& r) { return r.in(0.06, 0.5); }
Shape prism(Random& r) {
  const int corners = 3 + r.below(10);
  const double radius = r.in(0.05, 0.25), half = r.in(0.03, 0.2);
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i)
    for (const double z : {-half, half}) {
      const double a = 2 * std::numbers::pi * i / corners;
      points.push_back({radius * std::cos(a), radius * std::sin(a), z});
    }
  return Hull{convexHull(points), 1, ""};
}

const std::array<KindInGroove, 7> kKindsInGrooves = {{
    {"box", [](Random& r) -> Shape { return Box{{side(r), side(r), side(r)}}; }},
    {"cube", [](Random& r) -> Shape { return Box{Vec3::Constant(side(r))}; }},
    {"capsule", [](Random& r) -> Shape { return Capsule{r.in(0.03, 0.15), r.in(0.08, 0.4)}; }},
    {"cylinder", [](Random& r) -> Shape { return Cylinder{r.in(0.04, 0.2), r.in(0.05, 0.4)}; }},
    {"prism", prism},
    {"cone", [](Random& r) -> Shape { return Cone{r.in(0.04, 0.2), r.in(0.05, 0.4)}; }},
    {"ball", [](Random& r) -> Shape { return Sphere{r.in(0.03, 0.2)}; }},
}};

// A V, a floor with two walls, or three slopes that meet; all through the origin, and turned about the vertical.
std::vector<Vec3> normalsOf(Random& r, int ground) {
  const double degree = std::numbers::pi / 180, heading = r.below(2) ? 0 : r.in(0, 6.28);
  std::vector<Vec3> normals;
  if (ground == 0) {
    const double half = r.in(15, 75) * degree, lean = r.below(2) ? 0 : r.in(-0.3, 0.3) * half, fall = r.below(2) ? 0 : r.in(-0.3, 0.3);
    for (const double s : {1.0, -1.0}) {
      const double a = s * (std::numbers::pi / 2 - half) + lean;
      normals.push_back(Eigen::AngleAxisd(fall, Vec3::UnitX()) * Vec3(std::sin(a), 0, std::cos(a)));
    }
  } else if (ground == 1) {
    normals = {Vec3::UnitZ(), -Vec3::UnitX(), -Vec3::UnitY()};
  } else {
    for (int i = 0; i < 3; ++i) {
      const double a = (120 * i + r.in(-20, 20)) * degree, tilt = r.in(20, 75) * degree;
      normals.push_back({std::sin(tilt) * std::cos(a), std::sin(tilt) * std::sin(a), std::cos(tilt)});
    }
  }
  for (Vec3& n : normals) n = Eigen::AngleAxisd(heading, Vec3::UnitZ()) * n;
  return normals;
}

Scene intoGroove(const KindInGroove& kind, int ground, std::uint64_t seed) {
  Random r(seed);
  Body body = makeBall("body", 1, Vec3::Zero());
  body.shape = kind.make(r);
  const double reach = kindOf(body.shape).boundingRadius(body.shape);
  const std::vector<Vec3> normals = normalsOf(r, ground);
  const int pose = r.below(5);  // upright, along and across, or any
  if (pose > 2) body.orientation = r.rotation();
  if (pose == 1) body.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());
  if (pose == 2) body.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  body.velocity = r.vec(1);
  if (r.below(2)) body.angular_velocity = r.vec(5);
  double lowest = 0;
  body.position = ground == 1 ? Vec3(r.in(-0.4, 0), r.in(-0.4, 0), 0) : Vec3(r.in(-0.1, 0.1), r.in(-0.1, 0.1), 0);
  std::vector<Body> bodies;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    bodies.push_back(makePlane("p" + std::to_string(k), normals[k], ground == 1 && k > 0 ? -1 : 0));
    if (normals[k].z() > 1e-9)
      lowest = std::max(lowest, (reach - normals[k].dot(body.position)) / normals[k].z());
  }
  body.position.z() = lowest + r.in(0.01, 0.3);
  if (ground == 1) body.velocity += Vec3(r.in(0, 3), r.in(0, 3), 0);
  bodies.insert(bodies.begin(), body);
  constexpr std::array<double, 3> kBounces = {0, 0.3, 0.9}, kRubs = {0, 0.2, 1};
  const double e = kBounces[static_cast<std::size_t>(r.below(3))], mu = kRubs[static_cast<std::size_t>(r.below(3))];
  return makeScene({0, 0, -9.81}, e, mu, bodies);
}

// Sentences that differ by their numbers and names alone are one.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (!(c >= '0' && c <= '9') && c != '.' && c != '-') out += c;
  return out.substr(out.find("; ") == std::string::npos ? 0 : out.find("; "));
}

class GroovesOf : public testing::TestWithParam<KindInGroove> {};

TEST_P(GroovesOf, DropsKeepToCoulombsLawOrSayWhyTheyEnd) {
  struct Count {
    int times = 0;
    std::uint64_t seed = 0;
  };
  std::map<std::string, Count> ends;
  int dropped = 0, complete = 0;
  CoulombFindings worst;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(6)); ++seed)
    for (int ground = 0; ground < 3; ++ground) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", ground " + std::to_string(ground));
      const Scene scene = intoGroove(GetParam(), ground, 3 * seed + static_cast<std::uint64_t>(ground));
      OdeContacts contacts(scene);
      SimulateOptions options;
      options.step_limit = kWorkOfGrooves;
      const Motion m = simulate(scene, contacts, kAskedOfGrooves, options);
      ++dropped;
      const CoulombFindings found = checkAmongPlanes(m);
      EXPECT_TRUE(found.first.empty()) << found.first << "; " << nameOf(m.status) << " " << m.message;
      worst.add(found);
      if (m.status == MotionStatus::complete) {
        ++complete;
        continue;
      }
      EXPECT_FALSE(m.message.empty());
      Count& count = ends[std::string(nameOf(m.status)) + " on ground " + std::to_string(ground) + ": " + plain(m.message)];
      if (count.times++ == 0) count.seed = seed;
    }
  std::printf("%s: %d dropped, %d complete, %d looks; worst depth %.2g m, energy %.2g, force %.2g, impulse %.2g\n", GetParam().name,
              dropped, complete, worst.looks, worst.worst_depth, worst.worst_growth, worst.worst_force, worst.worst_impulse);
  for (const auto& [what, count] : ends)
    std::printf("  %4d %s (first seed %d)\n", count.times, what.c_str(), static_cast<int>(count.seed));
}

// Motions that others found to end: two contacts at one corner were held apart by rounding of the line between them, or
// the friction of their impacts was not found.
Scene handedOver(Body body, const Vec3& left, const Vec3& right, double friction) {
  return makeScene({0, 0, -9.81}, 0, friction,
                   {std::move(body), makePlane("left", left.normalized(), 0), makePlane("right", right.normalized(), 0)});
}

TEST(Grooves, ThatWereHandedOver) {
  Body capsule = makeBall("capsule", 0.1, {0.05, 0, 0.6}, {0, 0.5, 0});
  capsule.shape = Capsule{0.1, 0.3};
  capsule.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());
  const Scene scenes[] = {
      handedOver(makeBox("box", {0.9, 0.6, 0.7}, {0.1, 0, 1}, {1, -0.06, 0}), {0.5, 0.1, 0.8}, {-0.5, 0.1, 0.9}, 0.5),
      handedOver(makeBox("box", {0.28326064773688925, 0.7244089496798811, 0.7063807239032265}, {0.1, 0, 1.2},
                         {0.08353188491904695, 0.14391120626192544, 0}),
                 {0.7305790080907293, 0.1, 0.6828281723370574}, {-0.5611993786089599, 0.1, 0.8276806494348635}, 0.2),
      handedOver(makeBox("box", {0.723, 0.416, 0.462}, {0.1, 0, 1.2}, {-0.737, 2.14e-05, 0}), {0.832, 0.1, 0.555},
                 {-0.724, 0.1, 0.689}, 0.1),
      handedOver(capsule, {1, 0, 1}, {-1, 0, 1}, 0.3)};
  for (const Scene& scene : scenes) {
    SCOPED_TRACE("friction " + std::to_string(scene.materials[0].friction));
    const Motion m = play(scene, 3);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    const CoulombFindings found = checkAmongPlanes(m);
    EXPECT_TRUE(found.first.empty()) << found.first;
  }
}

// A cylinder whose friction of 1 presses it into a corner all the more the more it is pressed.
TEST(Grooves, AJamIsSaidToBeOne) {
  const Motion m = play(intoGroove(kKindsInGrooves[3], 2, 17), kAskedOfGrooves);
  EXPECT_EQ(m.status, MotionStatus::not_computable);
  EXPECT_NE(m.message.find("it jams there"), std::string::npos) << m.message;
}

INSTANTIATE_TEST_SUITE_P(Kinds, GroovesOf, testing::ValuesIn(kKindsInGrooves),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace carom::grooves
