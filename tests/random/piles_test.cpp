// SPDX-License-Identifier: MIT
// Random stacks and walls of blocks, level and on slopes, put together here and judged here: pyramids inside and around the cones of
// friction, of which the one shows that forces hold them, the other that none do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/random/nonnegative.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::piles {
namespace {

using namespace test;
using Eigen::Index;

constexpr double kHeld = 1e-9;

struct Pile {
  Scene scene;
  std::vector<Vec3> middle, size;  // in the axes of the slope; the ground is none of them
  double friction = 0, slope = 0;
};

// Layers of equal height, each block of which lies on some of the layer below.
Pile randomPile(std::uint64_t seed) {
  Random random(seed);
  Pile pile;
  pile.friction = random.below(8) == 0 ? 0 : random.in(0.1, 1.2);
  pile.slope = random.below(2) ? 0 : random.in(0, 0.8);
  std::vector<Body> bodies = {fixedBody(makeBox("ground", {60, 60, 1}, {0, 0, -0.5}))};
  const int layers = 1 + random.below(4);
  double height = 0;
  std::vector<std::pair<double, double>> below = {{-3, 3}};  // along x
  for (int layer = 0; layer < layers; ++layer) {
    const double thick = random.in(0.2, 1);
    std::vector<std::pair<double, double>> here;
    const int count = layer == 0 ? 1 + random.below(3) : 1 + random.below(static_cast<int>(below.size()));
    double from = below.front().first - (layer == 0 ? 0 : random.in(0, 0.6));
    for (int i = 0; i < count; ++i) {
      const double left = from + random.in(0.02, 0.5), wide = random.in(0.3, 1.6), right = left + wide;
      from = right;
      const bool lies = std::ranges::any_of(below, [&](const auto& b) { return std::min(b.second, right) - std::max(b.first, left) > 0.02; });
      if (!lies) continue;
      here.emplace_back(left, right);
      pile.size.push_back({wide, random.in(0.3, 0.8), thick});
      pile.middle.push_back({(left + right) / 2, random.in(-0.1, 0.1), height + thick / 2});
      bodies.push_back(makeBox("b" + std::to_string(bodies.size()), pile.size.back(), pile.middle.back()));
      bodies.back().mass = std::exp(random.in(-2, 2));
    }
    if (here.empty()) break;
    below = here;
    height += thick;
  }
  const Quat turn(Eigen::AngleAxisd(pile.slope, Vec3::UnitY()));
  for (Body& b : bodies) b.position = turn * b.position, b.orientation = turn;
  pile.scene = makeScene({0, 0, -9.81}, random.in(0, 0.8), pile.friction, bodies);
  return pile;
}

struct Corner {
  Index a, b;  // of the blocks; -1: the ground
  Vec3 point;
};

std::vector<Corner> cornersOf(const Pile& pile) {
  std::vector<Corner> corners;
  const auto n = static_cast<Index>(pile.size.size());
  const auto addFace = [&](Index a, Index b, const Vec3& low, const Vec3& high) {
    if (!(high.x() - low.x() > 1e-9 && high.y() - low.y() > 1e-9)) return;
    for (const double x : {low.x(), high.x()})
      for (const double y : {low.y(), high.y()}) corners.push_back({a, b, {x, y, low.z()}});
  };
  for (Index i = 0; i < n; ++i) {
    const Vec3 m = pile.middle[static_cast<std::size_t>(i)], h = pile.size[static_cast<std::size_t>(i)] / 2;
    if (m.z() - h.z() < 1e-9) addFace(i, -1, m - h, m + Vec3(h.x(), h.y(), -h.z()));
    for (Index j = 0; j < n; ++j) {
      const Vec3 u = pile.middle[static_cast<std::size_t>(j)], k = pile.size[static_cast<std::size_t>(j)] / 2;
      if (i == j || std::abs(m.z() - h.z() - (u.z() + k.z())) > 1e-9) continue;
      Vec3 low = (m - h).cwiseMax(u - k), high = (m + h).cwiseMin(u + k);
      low.z() = high.z() = m.z() - h.z();
      addFace(i, j, low, high);
    }
  }
  return corners;
}

// What forces in pyramids leave of the loads of the pile; `scale`: of their friction.
double unheld(const Pile& pile, const std::vector<Corner>& corners, double scale) {
  constexpr int kEdges = 16;
  const auto n = static_cast<Index>(pile.size.size());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(6 * n);
  for (Index i = 0; i < n; ++i)
    b.segment<3>(6 * i) = *pile.scene.bodies[static_cast<std::size_t>(i) + 1].mass * 9.81 * Vec3(-std::sin(pile.slope), 0, std::cos(pile.slope));
  const int edges = pile.friction > 0 ? kEdges : 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * n, static_cast<Index>(corners.size()) * edges);
  Index column = 0;
  for (const Corner& c : corners)
    for (int e = 0; e < edges; ++e, ++column) {
      const double angle = 2 * std::numbers::pi * (e + 0.5) / kEdges;
      const Vec3 f = Vec3(0, 0, 1) + (pile.friction > 0 ? scale * pile.friction : 0) * Vec3(std::cos(angle), std::sin(angle), 0);
      for (const auto& [body, sign] : {std::pair(c.a, 1.0), std::pair(c.b, -1.0)}) {
        if (body < 0) continue;
        A.block<3, 1>(6 * body, column) = sign * f;
        A.block<3, 1>(6 * body + 3, column) = sign * (c.point - pile.middle[static_cast<std::size_t>(body)]).cross(f);
      }
    }
  return leastLeft(A, b);
}

// All of it on a lift, up, down and to the side.
Scene onALift(Scene scene, const Vec3& V) {
  for (Body& body : scene.bodies) {
    if (body.fixed) body.fixed = false, body.kinematic = true, body.mass.reset();
    body.velocity = V;
  }
  return scene;
}

TEST(Piles, RestOnALiftWhereTheyRestOnTheGround) {
  int rests = 0, falls = 0;
  for (std::uint64_t seed = 1001; seed <= 1000 + static_cast<std::uint64_t>(scaled(100)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pile pile = randomPile(seed);
    const Vec3 V = Random(seed).vec(2);
    const Motion still = playLasting(pile.scene, 1), carried = playLasting(onALift(pile.scene, V), 1);
    const auto goesAt = [&](const Motion& m, const Vec3& velocity) {  // all of it, without another event
      for (std::size_t b = 0; b < pile.scene.bodies.size(); ++b) {
        if (m.status != MotionStatus::complete || m.world_lines[b].arcs.size() > 2) return false;
        const auto body = static_cast<int>(b);
        if ((m.stateAt(body, 1).position - m.stateAt(body, 0).position - velocity).norm() > 1e-13) return false;
      }
      return true;
    };
    const bool rest = goesAt(still, Vec3::Zero());
    EXPECT_EQ(goesAt(carried, V), rest) << still.message << "; " << carried.message;
    ++(rest ? rests : falls);
  }
  std::printf("%d rest, %d do not\n", rests, falls);
  EXPECT_GT(rests, scaled(20));
  EXPECT_GT(falls, scaled(10));
}

TEST(Piles, RestExactlyWhereForcesHoldThem) {
  int rests = 0, falls = 0, undecided = 0, largest = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(300)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pile pile = randomPile(seed);
    const std::vector<Corner> corners = cornersOf(pile);
    largest = std::max(largest, static_cast<int>(pile.size.size()));
    const double left = unheld(pile, corners, 1), at_least = unheld(pile, corners, 1 / std::cos(std::numbers::pi / 16));
    const bool inside = left <= kHeld, around = inside || at_least <= kHeld;
    if (inside != around) {
      ++undecided;
      continue;
    }
    for (const bool reverse : {false, true}) {
      Scene scene = pile.scene;
      if (reverse) std::ranges::reverse(scene.bodies);
      const Motion m = playLasting(scene, 1);
      const bool rest = m.status == MotionStatus::complete && std::ranges::all_of(m.world_lines, [](const WorldLine& line) {
                          return line.arcs.size() == 1 || (line.arcs.size() == 2 && line.arcs.back().kind() == ArcKind::rest);
                        });
      EXPECT_EQ(rest, inside) << "forces leave " << left << " and " << at_least << " of the loads; " << m.message;
      for (std::size_t b = 0; rest && b < scene.bodies.size(); ++b)
        EXPECT_LE((m.stateAt(static_cast<int>(b), 1).position - scene.bodies[b].position).norm(), 1e-12);
    }
    ++(inside ? rests : falls);
  }
  std::printf("%d rest, %d do not, %d undecided; up to %d blocks\n", rests, falls, undecided, largest);
  EXPECT_GT(rests, scaled(60));
  EXPECT_GT(falls, scaled(30));
}

}  // namespace
}  // namespace carom::piles
