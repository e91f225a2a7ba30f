// SPDX-License-Identifier: MIT
// Cards that lean on each other with parallel edges, put together here and judged here: they stand where forces within the cones of
// all normals of such edges hold them. In the plane those cones have two sides, so that weights of these decide exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/derivative/tangent.h"
#include "tests/random/nonnegative.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::card_houses {
namespace {

using namespace test;
using Eigen::Index;

const Vec3 kDown(0, 0, -9.81);

// A contact in the plane: its outermost normals towards `a` as angles from x towards z.
struct Touch {
  int a, b;  // indices of bodies, 0: the floor
  Vec2 point;
  double low, high;
};

struct House {
  std::vector<Body> bodies = {fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5}))};
  std::vector<Touch> touches;

  // A card that stands on its lower edge at (x, z) and leans by `angle` towards +x, with its number.
  int lean(double x, double z, double angle, double wide, double high, double thick, double mass = 1) {
    const double side = angle > 0 ? 1 : -1;
    const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
    Body& card = bodies.emplace_back(makeBox("card " + std::to_string(bodies.size()), {thick, wide, high},
                                             Vec3(x, 0, z) - turn * Vec3(side * thick / 2, 0, -high / 2)));
    card.orientation = turn, card.mass = mass;
    return static_cast<int>(bodies.size()) - 1;
  }
  void stand(int card, int on, const Vec2& at) { touches.push_back({card, on, at, std::numbers::pi / 2, std::numbers::pi / 2}); }
  // Of two cards that lean by these angles, the right one pushed to the right: from the face of one to the face of the other.
  void meet(int left, int right, const Vec2& at, double left_angle, double right_angle) {
    touches.push_back({right, left, at, -left_angle, right_angle});
  }
};

// What forces leave of the weights.
double unheld(const House& house, double friction, double between) {
  const auto n = static_cast<Index>(house.bodies.size()) - 1;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * n);
  for (Index i = 0; i < n; ++i) load[3 * i + 1] = *house.bodies[static_cast<std::size_t>(i) + 1].mass;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n, 4 * static_cast<Index>(house.touches.size()));
  Index column = 0;
  for (const Touch& t : house.touches)
    for (const auto& [normal, side] : {std::pair(t.low, -1.0), std::pair(t.low, 0.0), std::pair(t.high, 0.0), std::pair(t.high, 1.0)}) {
      const double angle = normal + side * std::atan(t.b == 0 ? friction : between);
      const Vec2 f(std::cos(angle), std::sin(angle));
      for (const auto& [body, sign] : {std::pair(t.a, 1.0), std::pair(t.b, -1.0)}) {
        if (body == 0) continue;
        const Vec3& x = house.bodies[static_cast<std::size_t>(body)].position;
        const Vec2 r = t.point - Vec2(x.x(), x.z());
        A.block<3, 1>(3 * (body - 1), column) += sign * Vec3(f.x(), f.y(), r.x() * f.y() - r.y() * f.x());
      }
      ++column;
    }
  return leastLeft(A, load);
}

// The least friction, of the floor alone or of all, that holds it; infinite where none below 4 does.
double leastFriction(const House& house, double between = -1) {
  const auto holds = [&](double mu) { return unheld(house, mu, between < 0 ? mu : between) <= 1e-9; };
  double low = 0, high = 4;
  if (!holds(high)) return std::numeric_limits<double>::infinity();
  if (holds(0)) return 0;
  while (high - low > 1e-9 * high) {
    const double middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

// Friction with the floor, and between cards.
Scene sceneOf(const House& house, double friction, double between) {
  Scene scene = makeScene(kDown, 0.3, between, house.bodies);
  scene.materials.push_back(makeMaterial("floor", 0.3, friction));
  scene.bodies[0].material = "floor";
  for (Material& m : scene.materials) m.combine_friction = friction < between ? Combine::minimum : Combine::maximum;
  return scene;
}

Scene turned(Scene scene, double angle) {
  const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  for (Body& b : scene.bodies) b.position = turn * b.position, b.orientation = turn * b.orientation;
  return scene;
}

// In the plane x = 0.
Scene mirrored(Scene scene) {
  for (Body& b : scene.bodies) {
    b.position.x() *= -1;
    b.orientation.y() *= -1, b.orientation.z() *= -1;
  }
  return scene;
}

void expectRests(const Scene& written, bool rests, double yaw, const std::string& what) {
  for (const bool reverse : {false, true})
    for (const bool mirror : {false, true}) {
      Scene scene = turned(mirror ? mirrored(written) : written, yaw);
      if (reverse) std::ranges::reverse(scene.bodies);
      const Motion m = playLasting(scene, 5);
      EXPECT_EQ(m.status, rests ? MotionStatus::complete : MotionStatus::unresolved_contact) << what << ": " << m.message;
      ASSERT_EQ(m.events.size(), 1u) << what;
      for (std::size_t b = 0; rests && b < scene.bodies.size(); ++b) {
        const BodyState end = m.stateAt(static_cast<int>(b), 5);
        EXPECT_LE((end.position - scene.bodies[b].position).norm(), 1e-13) << what;
        EXPECT_EQ(end.position, m.stateAt(static_cast<int>(b), 0).position) << what;
      }
      if (!rests) {
        EXPECT_NE(m.message.find("stay in contact"), std::string::npos) << m.message;
      }
    }
}

// Feet at (-half, 0) and (half, 0).
House twoCards(double angle, double thick, double wide_left, double wide_right) {
  House house;
  const double half = std::sin(angle), top = std::cos(angle);
  const int left = house.lean(-half, 0, angle, wide_left, 1, thick), right = house.lean(half, 0, -angle, wide_right, 1, thick);
  house.stand(left, 0, {-half, 0}), house.stand(right, 0, {half, 0});
  house.meet(left, right, {0, top}, angle, angle);
  return house;
}

// The floor gives half the tangent of the lean, less what the thickness leans back: moments about the top. At the top they push
// along the horizontal, which is one of the normals, and need no friction.
TEST(CardHouses, TwoCardsStandUpToHalfTheTangentOfTheirLean) {
  for (const double angle : {0.1, 0.3, 0.6})
    for (const double thick : {0.001, 0.02})
      for (const double wide : {0.6, 0.5}) {
        const House house = twoCards(angle, thick, 0.6, wide);
        const double limit = std::tan(angle) / 2 - thick / 2;
        for (const double between : {0.0, 0.4}) {
          EXPECT_NEAR(leastFriction(house, between), limit, 1e-8);
          for (const double share : {1 - 1e-6, 1.0, 1 + 1e-6})
            expectRests(sceneOf(house, limit * share, between), !(share < 1), 0.7 * angle, std::to_string(angle) + ", " + std::to_string(share));
        }
      }
}

// Leans, lengths and masses that differ: the edges still lie along each other.
TEST(CardHouses, UnlikeCardsStandExactlyWhereForcesHoldThem) {
  int never = 0, always = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(40)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double left_angle = random.in(0.05, 0.8), right_angle = random.in(0.05, 0.8), top = random.in(0.5, 1.5);
    House house;
    const double foot_left = -top * std::tan(left_angle), foot_right = top * std::tan(right_angle);
    const int left = house.lean(foot_left, 0, left_angle, random.in(0.2, 0.8), top / std::cos(left_angle), random.in(0.01, 0.05), std::exp(random.in(-1, 1)));
    const int right = house.lean(foot_right, 0, -right_angle, random.in(0.2, 0.8), top / std::cos(right_angle), random.in(0.01, 0.05), std::exp(random.in(-1, 1)));
    house.stand(left, 0, {foot_left, 0}), house.stand(right, 0, {foot_right, 0});
    house.meet(left, right, {0, top}, left_angle, right_angle);
    const double between = random.below(2) ? random.in(0, 0.5) : -1, limit = leastFriction(house, between);
    const double yaw = random.in(-3, 3);
    if (!std::isfinite(limit)) {
      ++never;
      expectRests(sceneOf(house, 4, between < 0 ? 4 : between), false, yaw, "whatever the friction");
      continue;
    }
    if (limit == 0) {
      ++always;
      expectRests(sceneOf(house, 0, std::max(between, 0.0)), true, yaw, "without friction");
      continue;
    }
    for (const double share : {1 - 1e-6, 1 + 1e-6}) {
      const double mu = limit * share;
      expectRests(sceneOf(house, mu, between < 0 ? mu : between), share > 1, yaw, std::to_string(mu));
    }
  }
  EXPECT_LE(never + always, scaled(20));
}

// Leaning pairs side by side, plates across their tops, and the next storey on these.
House houseOf(int storeys, double angle, double thick) {
  House house;
  const double half = std::sin(angle), top = std::cos(angle), gap = 4 * thick, step = 2 * half + gap;
  const double over = thick * std::sin(angle), aside = thick * std::cos(angle), storey = top + over + thick;
  std::vector<int> plates;  // below; none: the floor
  for (int k = 0; k < storeys; ++k) {
    const int count = storeys - k;
    std::vector<int> next, lefts, rights;
    const auto middle = [&](int i) { return (i - (count - 1) / 2.0) * step; };
    for (int i = 0; i < count; ++i) {
      const double x = middle(i), z = k * storey;
      const int on = plates.empty() ? 0 : plates[static_cast<std::size_t>(i)];
      const int left = house.lean(x - half, z, angle, 0.6, 1, thick), right = house.lean(x + half, z, -angle, 0.6, 1, thick);
      house.stand(left, on, {x - half, z}), house.stand(right, on, {x + half, z});
      house.meet(left, right, {x, z + top}, angle, angle);
      lefts.push_back(left), rights.push_back(right);
    }
    for (int i = 0; i + 1 < count; ++i) {
      const double z = k * storey + top + over;
      house.bodies.push_back(makeBox("plate " + std::to_string(house.bodies.size()), {step - thick, 0.6, thick}, {middle(i) + step / 2, 0, z + thick / 2}));
      next.push_back(static_cast<int>(house.bodies.size()) - 1);
      house.stand(next.back(), rights[static_cast<std::size_t>(i)], {middle(i) + aside, z});
      house.stand(next.back(), lefts[static_cast<std::size_t>(i) + 1], {middle(i + 1) - aside, z});
    }
    plates = next;
  }
  for (Body& b : house.bodies) b.mass = 1;
  return house;
}

TEST(CardHouses, HousesOfSeveralStoreysStandExactlyWhereForcesHoldThem) {
  for (const int storeys : {2, 3})
    for (const double angle : {0.2, 0.4}) {
      const House house = houseOf(storeys, angle, 0.02);
      const double limit = leastFriction(house);
      ASSERT_TRUE(limit > 0.05 && limit < 2) << limit;
      for (const double share : {1 - 1e-6, 1 + 1e-6})
        expectRests(sceneOf(house, limit * share, limit * share), share > 1, angle, std::to_string(storeys) + " storeys, friction " + std::to_string(limit));
    }
}

// A card that leans on the edge of a fixed box rests where the normal of its own face, which pushes up the most, holds it: moments about
// the foot give that force. Where it would move there is no normal to go by.
TEST(CardHouses, ACardLeansOnAFixedEdge) {
  const double angle = 0.4, half = std::sin(angle), top = std::cos(angle), thick = 0.02;
  House house;
  const int card = house.lean(-half, 0, angle, 0.6, 1, thick);
  house.stand(card, 0, {-half, 0});
  const double push = (half - thick * top) / 2, limit = push * top / (1 - push * half);
  for (const double size : {0.5, 1.0})
    for (const double share : {0.5, 1 - 1e-6, 1 + 1e-6}) {
      Scene scene = sceneOf(house, limit * share, 0);
      scene.bodies.push_back(fixedBody(makeBox("box", {1, size, top}, {0.5, 0, top / 2})));
      for (const bool reverse : {false, true}) {
        Scene ordered = scene;
        if (reverse) std::ranges::reverse(ordered.bodies);
        const Motion m = playLasting(ordered, 1);
        EXPECT_EQ(m.status, share > 1 ? MotionStatus::complete : MotionStatus::unresolved_contact) << m.message;
        if (share > 1) {
          EXPECT_EQ(m.world_lines[1].arcs.back().kind(), ArcKind::rest);
        } else {
          EXPECT_NE(m.message.find("edges that lie along each other"), std::string::npos) << m.message;
        }
      }
    }
}

// Two boxes, mirror images of each other, that meet edge on edge, each of which turns by its own arm of the common impulse.
TEST(CardHouses, EdgesThatStrikeEachOtherLeaveAsMirrorImages) {
  for (const double tilt : {0.3, 0.5, std::numbers::pi / 4, 1.1})
    for (const double wide : {1.0, 0.7})
      for (const double friction : {0.0, 0.3})
        for (const bool reverse : {false, true}) {
          std::vector<Body> bodies = {makeBox("left", {1, 1, 1}, {-1.5, 0, 0}, {1, 0, 0}), makeBox("right", {1, wide, 1}, {1.5, 0, 0}, {-1, 0, 0})};
          bodies[0].orientation = Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY())), bodies[1].orientation = bodies[0].orientation.inverse();
          Scene scene = makeScene(Vec3::Zero(), 0.5, friction, bodies);
          if (reverse) std::ranges::reverse(scene.bodies);
          const Motion m = playLasting(scene, 1.5);
          ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
          const double arm = 0.5 * (std::cos(tilt) - std::sin(tilt)), impulse = 1.5 / (1 + 6 * arm * arm);
          for (const bool left : {true, false}) {
            const BodyState after = m.stateAt(left == reverse ? 1 : 0, m.events[0].time + 1e-6);
            const double side = left ? 1 : -1;
            expectEntries(after.velocity, Vec3(side * (1 - impulse), 0, 0), 1e-12, "velocity");
            expectEntries(after.angular_velocity, Vec3(0, -side * 6 * arm * impulse, 0), 1e-12, "angular velocity");
          }
        }
}

// A rest has the derivative of the projection, which keeps the edges along each other and what moves with all else. With a velocity
// it would go to one of the normals alone: that derivative is marked.
TEST(CardHouses, TheirDerivativesAreTransposedAndMarked) {
  for (const House& house : {twoCards(0.3, 0.02, 0.6, 0.5), houseOf(2, 0.3, 0.02)})
    for (const bool reverse : {false, true}) {
      Scene scene = turned(sceneOf(house, 0.7, 0.7), 0.4);
      if (reverse) std::ranges::reverse(scene.bodies);
      const Motion m = playLasting(scene, 1);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      expectTransposed(m, 3);
      const int at = reverse ? static_cast<int>(scene.bodies.size()) - 2 : 1;
      const SceneGradient up = gradientOf(m, at, 1, 2), along = gradientOf(m, at, 1, 0);
      double all = 0, sideways = 0;
      for (std::size_t b = 0; b < scene.bodies.size(); ++b) all += up.bodies[b].position.z(), sideways += along.bodies[b].position.x();
      EXPECT_NEAR(all, 1, 1e-12);
      EXPECT_NEAR(sideways, 1, 1e-12);
      DerivativeTape tape(m);
      StateSeed seed;
      seed.body = at, seed.at = Instant::at(1), seed.position = Vec3::UnitX();
      Reliability reliability;
      adjoint(tape, std::span(&seed, 1), &reliability);
      EXPECT_TRUE(reliability.reliable) << reliability.message;
      reliability.askVelocity(at);
      EXPECT_FALSE(reliability.reliable);
    }
}

}  // namespace
}  // namespace carom::card_houses
