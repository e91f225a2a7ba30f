// SPDX-License-Identifier: MIT
// A ground that is cut at random into flush pieces, boxes, hulls and meshes mixed, carries bodies of every kind as the whole
// one does: all that stands still is one ground for contact. CAROM_TEST_SCALE=50 plays 2000 motions.

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr double kSize = 3, kDepth = 0.6;  // of the ground, m
constexpr double kDuration = 1.2;          // s

// How far states may differ: so much, or so much of the largest entry of the motion's tangent.
constexpr std::uint64_t kFirst = 1;  // seed
constexpr double kSame = 1e-11, kShare = 1e-13, kGradient = 1e-9, kGradientSticking = 1e-8;

using Polygon = std::vector<Vec2>;

double areaOf(const Polygon& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// The part of a convex polygon with n.p <= c; what is cut is shared to the last bit.
Polygon below(const Polygon& p, const Vec2& n, double c) {
  Polygon out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % p.size()];
    const double da = n.dot(a) - c, db = n.dot(b) - c;
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const bool swap = da > 0;  // the same corner from both sides
      const Vec2 &from = swap ? b : a, &to = swap ? a : b;
      const double df = swap ? db : da, dt = swap ? da : db;
      Vec2 at = from + df / (df - dt) * (to - from);
      for (int axis : {0, 1})
        if (std::abs(n[axis]) == 1) at[axis] = c * n[axis];
      out.push_back(at);
    }
  }
  return out;
}

bool isBox(const Polygon& p) {
  if (p.size() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 along = p[(i + 1) % 4] - p[i];
    if (along.x() != 0 && along.y() != 0) return false;
  }
  return true;
}

// A prism below the polygon: 0 a box if it is one, 1 a hull, 2 a mesh.
Body pieceOf(const std::string& name, const Polygon& p, double depth, int kind) {
  Body piece = fixedBody(makeBox(name, Vec3::Ones(), Vec3::Zero()));
  if (kind == 0 && isBox(p)) {
    Vec2 low = p[0], high = p[0];
    for (const Vec2& corner : p) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    piece.shape = Box{{high.x() - low.x(), high.y() - low.y(), depth}};
    piece.position << 0.5 * (low + high), -0.5 * depth;
    return piece;
  }
  std::vector<Vec3> points;
  for (const double z : {0.0, -depth})
    for (const Vec2& corner : p) points.push_back({corner.x(), corner.y(), z});
  if (kind != 2) {
    piece.shape = Hull{convexHull(points), 1, ""};
    return piece;
  }
  const int n = static_cast<int>(p.size());
  std::vector<std::array<int, 3>> triangles;
  for (int i = 1; i + 1 < n; ++i) triangles.push_back({0, i, i + 1}), triangles.push_back({n, n + i + 1, n + i});
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    triangles.push_back({i, n + i, n + j}), triangles.push_back({i, n + j, j});
  }
  piece.shape = Mesh{meshSurface(points, triangles), 1, ""};
  return piece;
}

// Cuts of `pieces` - 1 lines, most along the axes and on round numbers.
std::vector<Body> cutGround(Random& random, int pieces) {
  std::vector<Polygon> parts{{{-kSize, -kSize}, {kSize, -kSize}, {kSize, kSize}, {-kSize, kSize}}};
  for (int tries = 0; static_cast<int>(parts.size()) < pieces && tries < 400; ++tries) {
    const auto which = static_cast<std::size_t>(random.below(static_cast<int>(parts.size())));
    const Polygon part = parts[which];
    Vec2 middle = Vec2::Zero();
    for (const Vec2& corner : part) middle += corner / static_cast<double>(part.size());
    middle += Vec2(random.in(-0.4, 0.4), random.in(-0.4, 0.4));
    Vec2 n = random.below(2) ? Vec2(1, 0) : Vec2(0, 1);
    if (random.below(4) == 0) n = Vec2(random.in(-1, 1), random.in(-1, 1)).normalized();
    double c = n.dot(middle);
    if (random.below(2)) c = std::round(4 * c) / 4;
    const Polygon low = below(part, n, c), high = below(part, -n, -c);
    if (low.size() < 3 || high.size() < 3 || areaOf(low) < 0.02 || areaOf(high) < 0.02) continue;
    parts[which] = low;
    parts.push_back(high);
  }
  std::vector<Body> out;
  for (std::size_t i = 0; i < parts.size(); ++i)
    out.push_back(pieceOf("g" + std::to_string(i), parts[i], random.below(2) ? kDepth : random.in(0.1, kDepth), random.below(3)));
  return out;
}

struct Play {
  const char* what;
  Scene whole, cut;
};

Shape shapeOf(Random& random, int kind) {
  const double r = random.in(0.05, 0.2), h = random.in(0.05, 0.4);
  switch (kind) {
    case 0: return Sphere{r};
    case 1: return Box{{random.in(0.1, 0.4), random.in(0.1, 0.4), h}};
    case 2: return Capsule{r, h};
    case 3: return Cylinder{r, h};
    case 4: return Cone{r, h};
    default: {
      std::vector<Vec3> points;
      for (int i = 0; i < 9; ++i) points.push_back(random.in(0.08, 0.2) * random.unit());
      return Hull{convexHull(points), 1, ""};
    }
  }
}

constexpr std::array kNames = {"sphere", "box", "capsule", "cylinder", "cone", "hull"};

Play playOf(std::uint64_t seed) {
  Random random(seed);
  const int kind = random.below(6);
  Body body = makeBall("body", 1, Vec3::Zero());
  body.shape = shapeOf(random, kind);
  body.mass = random.in(0.2, 2);
  const bool placed = random.below(2) && kind != 5;
  body.velocity = Vec3(random.in(-2, 2), random.in(-2, 2), 0);
  if (random.below(4) == 0) body.velocity = {random.in(0.2, 2), 0, 0};
  const auto flat = [&](double height) {
    body.position = {random.in(-0.5, 0.5), random.in(-0.5, 0.5), height};
    if (random.below(3) == 0) body.position.head<2>() = Vec2(0.25 * random.below(4), 0.25 * random.below(4));
  };
  if (placed) {
    const double turn = random.below(2) ? random.in(-3, 3) : 0;
    body.orientation = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
    body.angular_velocity = {0, 0, random.below(2) ? random.in(-5, 5) : 0};
    if (const auto* ball = std::get_if<Sphere>(&body.shape)) {
      flat(ball->radius);
      body.angular_velocity = random.vec(8);
    } else if (const auto* box = std::get_if<Box>(&body.shape)) {
      flat(box->size.z() / 2);
    } else if (const auto* capsule = std::get_if<Capsule>(&body.shape)) {
      flat(capsule->radius);
      body.orientation = body.orientation * Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
      flat(cylinder->height / 2);
    } else if (const auto* cone = std::get_if<Cone>(&body.shape)) {
      flat(cone->height / 2);
    }
  } else {
    flat(kindOf(body.shape).boundingRadius(body.shape) + random.in(0.01, 0.2));
    body.orientation = random.rotation();
    body.angular_velocity = random.vec(6);
    body.velocity.z() = random.in(-2, 0);
  }
  const double slope = random.below(2) ? random.in(-0.3, 0.3) : 0;
  const Vec3 gravity{9.81 * std::sin(slope), 0, -9.81 * std::cos(slope)};
  const double e = std::array{0.0, 0.3, 0.6}[static_cast<std::size_t>(random.below(3))];
  const double mu = std::array{0.0, 0.1, 0.3, 1.0}[static_cast<std::size_t>(random.below(4))];
  const Body ground = fixedBody(makeBox("ground", {2 * kSize, 2 * kSize, kDepth}, {0, 0, -kDepth / 2}));
  const int pieces = 2 + random.below(random.below(3) ? 8 : 49);
  std::vector<Body> whole{body, ground}, cut = cutGround(random, pieces);
  const bool last = random.below(2);
  cut.insert(last ? cut.end() : cut.begin(), body);
  if (last) whole = {ground, body};
  return {kNames[static_cast<std::size_t>(kind)], makeScene(gravity, e, mu, whole), makeScene(gravity, e, mu, cut)};
}

Motion played(const Scene& scene) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 20000;
  options.step_limit = 150'000;
  options.lowest_bounce = 5e-12;  // the same for both: by itself it is that of the largest body
  return simulate(scene, contacts, kDuration, options);
}

// The largest derivative of a motion's states up to a time with respect to any scene parameter: at its events, as short
// bounces amplify what lies between them, and between.
double largestTangent(const Motion& motion, int body, double time) {
  std::vector<double> times;
  for (int k = 1; k <= 8; ++k) times.push_back(time * k / 8);
  for (const Event& e : motion.events)
    if (e.time < time && times.size() < 80) times.push_back(e.time);
  double largest = 0;
  for (const double t : times)
    for (int i = 0; i < 12; ++i) largest = std::max(largest, flatten(gradientOf(motion, body, t, i)).cwiseAbs().maxCoeff());
  return largest;
}

// With respect to the parameters of the body, the material and gravity, and to the pose of all of the ground together, about the origin.
Eigen::VectorXd byWhole(const Scene& scene, const SceneGradient& g) {
  Eigen::VectorXd out(25);
  Vec3 moves = Vec3::Zero(), turns = Vec3::Zero();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyDerivative& by = g.bodies[b];
    if (!scene.bodies[b].fixed) {
      out.head<12>() << by.position, by.orientation, by.velocity, by.angular_velocity;
      out.segment<2>(12) << by.mass, by.size[0];
      continue;
    }
    moves += by.position;
    turns += by.orientation + scene.bodies[b].position.cross(by.position);
  }
  out.segment<9>(14) << moves, turns, g.gravity;
  out.tail<2>() << g.materials[0].elasticity, g.materials[0].friction;
  return out;
}

// What begins to slip at the start has one-sided ones.
bool hasDerivatives(const Motion& motion, int body, double time) {
  const StateSeed seed = seedOf(body, Instant::at(time), 0);
  Reliability reliability;
  adjoint(motion, std::span(&seed, 1), &reliability);
  return reliability.beginning.empty();
}

// Where several contacts of an integrated path come to stick at once the last directions of their slips are known to less.
double mostDifferent(const Motion& motion) {
  const bool sticks = std::ranges::any_of(motion.events, [](const Event& e) { return e.cause == TransitionCause::sticks; });
  return sticks ? kGradientSticking : kGradient;
}

// A pose has two quaternions.
double differenceOf(const BodyState& a, const BodyState& b) {
  Eigen::Matrix<double, 13, 1> x = flatten(a), y = flatten(b);
  if (x.segment<4>(3).dot(y.segment<4>(3)) < 0) y.segment<4>(3) *= -1;
  return (x - y).cwiseAbs().maxCoeff();
}

TEST(CutGround, CarriesBodiesAsTheWholeOneDoes) {
  std::map<std::string, std::array<int, 4>> count;
  double worst = 0, worst_share = 0, worst_gradient = 0;
  int gradients = 0;
  for (std::uint64_t seed = kFirst; seed < kFirst + static_cast<std::uint64_t>(scaled(12)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Play play = playOf(seed);
    const Motion whole = played(play.whole);
    auto& [all, incomplete, other_end, apart] = count[play.what];
    ++all;
    if (whole.status != MotionStatus::complete) {  // what it comes to on any ground is held elsewhere
      ++incomplete;
      continue;
    }
    const Motion cut = played(play.cut);
    const double end = whole.end;
    if (cut.status != MotionStatus::complete) {
      ++other_end;
      ADD_FAILURE() << play.what << ": the cut ground ends at " << cut.end << " s: " << cut.message;
      continue;
    }
    bool off = false;
    for (const double t : {0.25 * end, 0.5 * end, 0.75 * end, end}) {
      const int i = bodyIndex(play.whole, "body");
      const double difference = differenceOf(whole.stateAt("body", t), cut.stateAt("body", t));
      worst = std::max(worst, difference);
      if (difference <= kSame) continue;
      const double share = difference / largestTangent(whole, i, t);
      worst_share = std::max(worst_share, share);
      if (share <= kShare) continue;
      ADD_FAILURE() << play.what << " at " << t << " s of " << end << ": " << difference << ", " << share << " of the largest tangent; events " << whole.event_count << " and " << cut.event_count;
      off = true;
      break;
    }
    apart += off;
    if (off || !hasDerivatives(whole, bodyIndex(play.whole, "body"), end)) continue;
    const int of_whole = bodyIndex(play.whole, "body"), of_cut = bodyIndex(play.cut, "body");
    Eigen::VectorXd one, other;
    double size = 0, most = 0;
    for (int i = 0; i < 12; ++i) {
      one = byWhole(play.whole, gradientOf(whole, of_whole, end, i)), other = byWhole(play.cut, gradientOf(cut, of_cut, end, i));
      size = std::max(size, one.cwiseAbs().maxCoeff()), most = std::max(most, (one - other).cwiseAbs().maxCoeff());
    }
    const double largest = std::max(size, largestTangent(whole, of_whole, end));
    worst_gradient = std::max(worst_gradient, most / largest);
    if (!(most <= mostDifferent(whole) * largest)) {
      ++gradients;
      ADD_FAILURE() << play.what << ": derivatives differ by " << most << ", " << most / largest << " of the largest tangent";
    }
  }
  for (const auto& [what, n] : count)
    std::printf("%s: %d motions, %d of them not complete; the cut ground ends otherwise in %d, is off in %d\n", what.c_str(), n[0], n[1], n[2], n[3]);
  std::printf("derivatives differ in %d, by %.2g of the largest tangent at most\n", gradients, worst_gradient);
  std::printf("largest difference %.2g, largest share of a tangent where it is above 1e-11: %.2g\n", worst, worst_share);
}

}  // namespace
}  // namespace carom
