// SPDX-License-Identifier: MIT
// Neighbour lists never miss a pair whose swept bounds meet: against brute force, over random flights, impacts and
// sizes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ode_bridge/neighbours.hpp"
#include "tests/support/scenes.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using test::Random;

struct Crowd {
  std::vector<BodyExtent> extents;
  std::vector<FlightPath> paths;
  std::vector<double> since;  // of the path in force
  Vec3 gravity;
  std::vector<Vec3> pull;           // acceleration of each
  std::vector<Acceleration> known;  // what the lists are told of it

  Vec3 positionAt(int i, double t) const {
    return paths[static_cast<std::size_t>(i)].positionAt(t, pull[static_cast<std::size_t>(i)]);
  }
  Vec3 velocityAt(int i, double t) const {
    return paths[static_cast<std::size_t>(i)].velocityAt(t, pull[static_cast<std::size_t>(i)]);
  }
};

// Balls of mixed sizes, some fixed boxes and half spaces, in a box of this size; a few are far out or very fast.
Crowd randomCrowd(Random& random, int count, double size) {
  Crowd crowd;
  crowd.gravity = random.below(3) ? Vec3(0, 0, -9.81) : Vec3(0, 0, 0);
  for (int i = 0; i < count; ++i) {
    BodyExtent e;
    FlightPath path;
    const int kind = random.below(20);
    if (kind == 0) {
      const Vec3 middle = random.vec(size), half = random.vec(0.1 * size).cwiseAbs();
      e.box = {middle - half, middle + half};
    } else if (kind == 1 && i < 8) {
      e.half_space = true;
      e.normal = random.unit();
      e.offset = -0.7 * size;
    } else {
      e.moving = true;
      e.radius = (random.below(30) ? 0.05 : 0.5) * random.in(0.3, 1);
      path = {random.vec(random.below(40) ? size : 30 * size), random.vec(random.below(25) ? 2 : 200), 0, e.radius};
    }
    crowd.extents.push_back(e);
    crowd.paths.push_back(path);
  }
  crowd.since.assign(crowd.paths.size(), 0);
  crowd.pull.assign(crowd.paths.size(), crowd.gravity);
  crowd.known.assign(crowd.paths.size(), {crowd.gravity, 0});
  return crowd;
}

// Body i goes on at rest, or rolling, or under an acceleration that is known to so much.
void changePath(Crowd& crowd, int i, Random& random) {
  const auto at = static_cast<std::size_t>(i);
  crowd.pull[at] = crowd.gravity;
  if (random.below(2)) crowd.pull[at] = random.vec(3);
  if (random.below(4) == 0) crowd.pull[at].setZero(), crowd.paths[at].v.setZero();
  const Vec3 off = random.below(2) ? Vec3::Zero() : random.vec(2);
  crowd.known[at] = {crowd.pull[at] + off, off.norm() * (1 + 1e-15)};
}

Bounds sweptBall(const Crowd& crowd, int i, double from, double until) {
  const BodyExtent& e = crowd.extents[static_cast<std::size_t>(i)];
  if (!e.moving) return e.box;
  return grown(sweptCentre(crowd.paths[static_cast<std::size_t>(i)], {crowd.pull[static_cast<std::size_t>(i)], 0}, from, until), e.radius);
}

bool sweptMeet(const Crowd& crowd, int i, int j, double from, double until) {
  const BodyExtent& e = crowd.extents[static_cast<std::size_t>(j)];
  const Bounds a = sweptBall(crowd, i, from, until);
  if (!e.half_space) return meet(a, sweptBall(crowd, j, from, until));
  return e.normal.cwiseMax(0).dot(a.low) + e.normal.cwiseMin(0).dot(a.high) <= e.offset;
}

// The pairs of moving body i that meet up to the end of both windows stand in its list.
void expectComplete(const Crowd& crowd, Neighbours& lists, double t, double end, int i) {
  std::vector<int> list;
  const double until_i = std::min(lists.window(i, t), end);
  lists.list(i, list);
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
  EXPECT_TRUE(std::adjacent_find(list.begin(), list.end()) == list.end());
  EXPECT_FALSE(std::binary_search(list.begin(), list.end(), i));
  for (int j = 0; j < static_cast<int>(crowd.extents.size()); ++j) {
    if (j == i || std::binary_search(list.begin(), list.end(), j)) continue;
    // the other asks for itself when its own window ends
    const bool moves = crowd.extents[static_cast<std::size_t>(j)].moving;
    const double until = moves ? std::min(until_i, std::min(lists.window(j, t), end)) : until_i;
    if (sweptMeet(crowd, i, j, t, until)) ADD_FAILURE() << i << " and " << j << " up to " << until << " from " << t;
  }
}

void playCrowd(std::uint64_t seed, int count, std::size_t few, bool paths = false) {
  SCOPED_TRACE("seed " + std::to_string(seed) + ", bodies " + std::to_string(count));
  Random random(seed);
  Crowd crowd = randomCrowd(random, count, 0.5 * std::cbrt(count) * random.in(0.1, 0.5));
  Neighbours lists;
  lists.begin(crowd.extents, crowd.gravity, few);
  const double end = 2;
  std::vector<int> moving;
  for (int i = 0; i < count; ++i)
    if (crowd.extents[static_cast<std::size_t>(i)].moving) moving.push_back(i);
  if (moving.empty()) return;
  const auto setPath = [&](int i, double t) {
    if (paths) changePath(crowd, i, random);
    const auto at = static_cast<std::size_t>(i);
    lists.setPath(i, crowd.paths[at], crowd.known[at], t, end);
  };
  // the source knows where bodies are whose acceleration varies
  const auto window = [&](int i, double t) {
    for (int j : moving)
      if (crowd.known[static_cast<std::size_t>(j)].variation > 0 && (j == i || lists.renewsAll(t)))
        lists.renewPath(j, crowd.positionAt(j, t), crowd.velocityAt(j, t), t);
    return lists.window(i, t);
  };
  for (int i : moving) setPath(i, 0);
  // as the simulator does: windows are renewed when they end; in between some bodies are struck
  double t = 0;
  for (int step = 0; step < 150 && t < end; ++step) {
    double next = std::min(end, t + random.in(0, 0.02));
    for (int i : moving) next = std::min(next, window(i, t));
    EXPECT_GT(next, t);
    t = next;
    for (int i : moving) window(i, t);
    for (int k = random.below(4); k > 0; --k) {
      const int i = moving[static_cast<std::size_t>(random.below(static_cast<int>(moving.size())))];
      FlightPath& path = crowd.paths[static_cast<std::size_t>(i)];
      path = {crowd.positionAt(i, t), random.vec(3), t, path.radius};
      setPath(i, t);
      window(i, t);
    }
    for (int k = 0; k < 3; ++k)
      expectComplete(crowd, lists, t, end,
                     moving[static_cast<std::size_t>(random.below(static_cast<int>(moving.size())))]);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Neighbours, NeverMissAPairWithWindows) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) playCrowd(seed, 10 + static_cast<int>(seed) * 8, 0);
}

TEST(Neighbours, NeverMissAPairWithoutWindows) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) playCrowd(seed, 3 + static_cast<int>(seed), Neighbours::kFew);
}

TEST(Neighbours, NeverMissWhatRestsRollsOrSlidesRoundABend) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    playCrowd(seed, 10 + static_cast<int>(seed) * 8, 0, true);
    playCrowd(seed, 3 + static_cast<int>(seed), Neighbours::kFew, true);
  }
}

// The lists hold little more than the boxes ask for: the mean length stays moderate in a crowd.
TEST(Neighbours, ListsOfACrowdAreShort) {
  Random random(7);
  const int side = 10, count = side * side * side;
  std::vector<BodyExtent> extents;
  std::vector<FlightPath> paths;
  for (int i = 0; i < count; ++i) {
    BodyExtent e;
    e.moving = true;
    e.radius = 0.05;
    extents.push_back(e);
    paths.push_back({0.15 * Vec3(i % side, i / side % side, i / (side * side)), random.vec(1), 0, 0.05});
  }
  Neighbours lists;
  lists.begin(extents, Vec3::Zero());
  for (int i = 0; i < count; ++i) lists.setPath(i, paths[static_cast<std::size_t>(i)], 0, 10);
  std::size_t total = 0;
  std::vector<int> list;
  for (int i = 0; i < count; ++i) {
    lists.window(i, 0);
    lists.list(i, list);
    total += list.size();
  }
  EXPECT_LT(total, 40u * static_cast<std::size_t>(count));
  EXPECT_GT(total, 2u * static_cast<std::size_t>(count));
}

TEST(Neighbours, GridFindsWhatBruteForceFinds) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int count = 20 + random.below(300);
    std::vector<Bounds> boxes;
    const auto box = [&] {
      const Vec3 middle = random.vec(random.below(30) ? 3 : 100),
                 half = random.vec(random.below(20) ? 0.2 : 4).cwiseAbs();
      return Bounds{middle - half, middle + half};
    };
    for (int i = 0; i < count; ++i) boxes.push_back(box());
    BoxGrid grid;
    grid.rebuild(boxes, 0.3);
    for (int step = 0; step < 300; ++step) {
      const int i = random.below(count);
      boxes[static_cast<std::size_t>(i)] = box();
      grid.move(i, boxes);
      std::vector<int> found, expected, near;
      grid.find(i, boxes, found);
      std::sort(found.begin(), found.end());
      const Bounds& mine = boxes[static_cast<std::size_t>(i)];
      for (int j = 0; j < count; ++j) {
        if (j != i && meet(mine, boxes[static_cast<std::size_t>(j)])) expected.push_back(j);
        if (j != i && meet(grown(mine, 1e-4), boxes[static_cast<std::size_t>(j)])) near.push_back(j);
      }
      EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      EXPECT_TRUE(std::includes(near.begin(), near.end(), found.begin(), found.end()));
    }
  }
}

}  // namespace
}  // namespace carom
